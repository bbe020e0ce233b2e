# Shafts of sunlight in thin fog: distances have to end in them.
NAME := light-shafts
SCENE := pipelines/scenes/light-shafts.xml
PHOTONS ?= 4000000

include $(dir $(lastword $(MAKEFILE_LIST)))media.mk
