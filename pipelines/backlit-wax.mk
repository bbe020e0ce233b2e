# Subsurface scattering behind refracting boundaries: paths have to stay near and leave rightly.
NAME := backlit-wax
OUT ?= out/backlit-wax
SCENE := pipelines/scenes/backlit-wax.xml
PIPELINE_FLAGS = -D meshes=$(abspath $(OUT))
SCENE_INPUTS = $(OUT)/ring.obj
PHOTONS ?= 4000000

include $(dir $(lastword $(MAKEFILE_LIST)))media.mk

$(OUT)/ring.obj: $(ROOT)/scenes/torus.awk
	@mkdir -p $(@D)
	awk -f $< -v major=1 -v minor=0.3 -v rings=128 -v sides=48 -v height=1 > $@.tmp && mv $@.tmp $@
