# A room full of smoke, lit through a door ajar: all four decisions, on surfaces and in the medium.
NAME := smoky-room
SCENE := pipelines/scenes/smoky-room.xml
PHOTONS ?= 2000000

include $(dir $(lastword $(MAKEFILE_LIST)))media.mk
