# A living room behind glass doors, from a folder of scenes made elsewhere:
#   make -f pipelines/living-room.mk WAYLIGHT_SCENES=/folder/of/scenes
WAYLIGHT_SCENES ?= ../shared/scenes
NAME := living-room
SCENE := $(WAYLIGHT_SCENES)/living-room/scene.xml
$(if $(wildcard $(SCENE))$(filter clean,$(MAKECMDGOALS)),,$(error no $(SCENE): \
  WAYLIGHT_SCENES is to be the folder of scenes made elsewhere, see docs/scenes.md))
SIZE ?= 640x360
PHOTONS ?= 8000000
TIMES ?= 15 30 60

include $(dir $(lastword $(MAKEFILE_LIST)))rules.mk
