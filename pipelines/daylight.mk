# A room with one window in a plain of a kilometre under sun and sky. Photons starve: camera paths
# teach the cache, each pass guided by the one before.
NAME := daylight
SCENE := pipelines/scenes/daylight.xml
TRAIN_FROM ?= camera
PHOTONS ?= 800000
PASSES ?= $(if $(filter auto,$(PHOTONS)),0,3)

include $(dir $(lastword $(MAKEFILE_LIST)))rules.mk
