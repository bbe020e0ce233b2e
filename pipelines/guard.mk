# Of every file that pipelines include: what would go wrong silently is refused.
$(if $(wildcard pipelines/rules.mk),,$(error run make in the root of the repository))
$(if $(and $(NAME),$(SCENE)),,$(error this file is included by pipelines: \
  run one that sets NAME and SCENE, for example make -f pipelines/gap-room.mk))
