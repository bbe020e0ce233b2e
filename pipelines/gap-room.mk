# An interior lit only through a gap: path tracing against illumination and product guiding.
NAME := gap-room
SCENE := pipelines/scenes/gap-room.xml
REFERENCE ?= pipelines/references/gap-room.exr
PHOTONS ?= 1000000

include $(dir $(lastword $(MAKEFILE_LIST)))rules.mk
