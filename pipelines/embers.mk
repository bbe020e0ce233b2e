# A cloud of make-cloud that glows: light from a medium, which next-event estimation does not find.
NAME := embers
OUT ?= out/embers
SCENE := pipelines/scenes/embers.xml

include $(dir $(lastword $(MAKEFILE_LIST)))grown-cloud.mk
