# A lamp behind a dense block: flights have to be kept from colliding.
NAME := lamp-behind
SCENE := pipelines/scenes/lamp-behind.xml
PHOTONS ?= 4000000

include $(dir $(lastword $(MAKEFILE_LIST)))media.mk
