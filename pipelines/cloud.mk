# A cumulus cloud of make-cloud in sun and sky: a heterogeneous medium.
NAME := cloud
OUT ?= out/cloud
SCENE := pipelines/scenes/cloud.xml

include $(dir $(lastword $(MAKEFILE_LIST)))grown-cloud.mk
