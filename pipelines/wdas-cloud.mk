# A cloud of Walt Disney Animation Studios' data set, from a folder of scenes made elsewhere:
#   make -f pipelines/wdas-cloud.mk WAYLIGHT_SCENES=/folder/of/scenes
WAYLIGHT_SCENES ?= ../shared/scenes
NAME := wdas-cloud
SCENE := pipelines/scenes/wdas-cloud.xml
SCENE_INPUTS = $(WAYLIGHT_SCENES)/volumes/wdas_cloud_sixteenth.vdb
PIPELINE_FLAGS = -D cloud=$(abspath $(SCENE_INPUTS))
$(if $(wildcard $(SCENE_INPUTS))$(filter clean,$(MAKECMDGOALS)),,$(error no $(SCENE_INPUTS): \
  WAYLIGHT_SCENES is to be the folder of scenes made elsewhere, see docs/scenes.md))
PHOTONS ?= 1000000

include $(dir $(lastword $(MAKEFILE_LIST)))media.mk
