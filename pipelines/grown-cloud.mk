# Pipelines through a cloud that make-cloud grows first. A pipeline sets NAME, OUT and SCENE and
# includes this file, which includes media.mk.
include $(dir $(lastword $(MAKEFILE_LIST)))guard.mk

PIPELINE_FLAGS = -D cloud=$(abspath $(OUT))/cloud.vdb
SCENE_INPUTS = $(OUT)/cloud.vdb
MAKE_CLOUD_FLAGS ?= --seed 5
PHOTONS ?= 1000000

include $(dir $(lastword $(MAKEFILE_LIST)))media.mk

$(eval $(call stamp,make-cloud,$(MAKE_CLOUD_FLAGS)))
$(OUT)/cloud.vdb: $(OUT)/.options/make-cloud $(BIN)/make-cloud
	$(LAUNCH) $(BIN)/make-cloud -o $@ --stats $(OUT)/make-cloud.json $(MAKE_CLOUD_FLAGS) $(QUIET)
