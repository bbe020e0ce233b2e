# Veach's room with the door ajar, from a folder of scenes made elsewhere:
#   make -f pipelines/veach-ajar.mk WAYLIGHT_SCENES=/folder/of/scenes
WAYLIGHT_SCENES ?= ../shared/scenes
NAME := veach-ajar
SCENE := $(WAYLIGHT_SCENES)/veach-ajar/scene_complete.xml
$(if $(wildcard $(SCENE))$(filter clean,$(MAKECMDGOALS)),,$(error no $(SCENE): \
  WAYLIGHT_SCENES is to be the folder of scenes made elsewhere, see docs/scenes.md))
SIZE ?= 640x360
PHOTONS ?= 4000000
TIMES ?= 15 30 60

include $(dir $(lastword $(MAKEFILE_LIST)))rules.mk
