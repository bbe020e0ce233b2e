# Rings and stones: metal, glass, caustics.
NAME := jewelry
OUT ?= out/jewelry
SCENE := pipelines/scenes/jewelry.xml
PIPELINE_FLAGS = -D meshes=$(abspath $(OUT))
SCENE_INPUTS = $(OUT)/ring.obj
PHOTONS ?= 2000000

include $(dir $(lastword $(MAKEFILE_LIST)))rules.mk

$(OUT)/ring.obj: $(ROOT)/scenes/torus.awk
	@mkdir -p $(@D)
	awk -f $< -v major=1 -v minor=0.09 -v height=2.6 -v rings=192 -v sides=48 > $@.tmp && mv $@.tmp $@
