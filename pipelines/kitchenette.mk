# The kitchen of the product-sampling paper, from a folder of scenes made elsewhere:
#   make -f pipelines/kitchenette.mk WAYLIGHT_SCENES=/folder/of/scenes
WAYLIGHT_SCENES ?= ../shared/scenes
NAME := kitchenette
SCENE := $(WAYLIGHT_SCENES)/kitchenette/simple.xml
$(if $(wildcard $(SCENE))$(filter clean,$(MAKECMDGOALS)),,$(error no $(SCENE): \
  WAYLIGHT_SCENES is to be the folder of scenes made elsewhere, see docs/scenes.md))
SIZE ?= 640x480
PHOTONS ?= 16000000
TIMES ?= 15 30 60

include $(dir $(lastword $(MAKEFILE_LIST)))rules.mk
