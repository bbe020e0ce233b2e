# A lamp in thin haze before nothing: flights have to be kept from passing.
NAME := haze
SCENE := pipelines/scenes/haze.xml
PHOTONS ?= 4000000

include $(dir $(lastword $(MAKEFILE_LIST)))media.mk
