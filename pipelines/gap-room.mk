# An interior lit only through a gap: path tracing against illumination and product guiding.
NAME := gap-room
SCENE := pipelines/scenes/gap-room.xml
# The reference that is shipped has one size, and is of the scene as it is.
shipped := pipelines/references/gap-room.exr
REFERENCE ?= $(if $(filter-out 320x180,$(SIZE))$(SCENE_FLAGS),$(OUT)/reference.exr,$(shipped))
PHOTONS ?= 1000000

include $(dir $(lastword $(MAKEFILE_LIST)))rules.mk
