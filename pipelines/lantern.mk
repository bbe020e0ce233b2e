# A lamp behind glass in thin fog: next-event estimation finds none of its light.
NAME := lantern
SCENE := pipelines/scenes/lantern.xml
PHOTONS ?= 4000000

include $(dir $(lastword $(MAKEFILE_LIST)))media.mk
