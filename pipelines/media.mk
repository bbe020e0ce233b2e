# Pipelines through media: the methods of media-methods.mk, each of which takes part that METHODS
# names. A pipeline sets a scene and options and includes this file, which includes rules.mk. The
# reference is made by `all` without splitting.
include $(dir $(lastword $(MAKEFILE_LIST)))guard.mk

METHODS ?= none distance direction both all
REFERENCE_MODE ?= illumination
REFERENCE_FLAGS ?= --distance guided --direction product

split_setting := SPLIT=%

include $(dir $(lastword $(MAKEFILE_LIST)))media-methods.mk
include $(dir $(lastword $(MAKEFILE_LIST)))rules.mk
