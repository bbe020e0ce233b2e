# One rule per stage. A pipeline is a file that sets a scene and options and includes this one:
#
#   make -f pipelines/gap-room.mk            everything: caches, images, figures, chart
#   make -f pipelines/gap-room.mk cache      the caches only
#   make -f pipelines/gap-room.mk clean
#
# Every stage keeps its options in a stamp, so changing one reruns only what depends on it. Outputs
# appear complete or not at all, so an interrupted make goes on where it stopped: a stage whose
# statistics are missing is run again, because it was stopped between the two files.
#
# Renders are limited by time: with `make -j` they share the processors and the chart says little,
# unless LAUNCH sends them to machines of their own.
#
# NAME             name of the pipeline and of its folder of results          (required)
# SCENE            scene file                                                 (required)
# OUT              folder of the results                                      out/NAME
# BIN              folder of the executables                                  build/bin
# LAUNCH           put before each command, for example `srun -n1`
# SCENE_FLAGS      -D name=value for every tool that reads the scene
# SIZE             image size
# SEED             of everything random
# PHOTONS          particles to emit in one pass
# TIMES            seconds of the renders in the chart
# METHODS          render modes to compare
# BRDF_FIT_FLAGS PHOTON_TRACE_FLAGS CACHE_TRAIN_FLAGS CACHE_REDUCE_FLAGS RENDER_FLAGS
# REFERENCE        image to compare with; made from REFERENCE_SPP product-guided samples when it is
#                  not set

.DELETE_ON_ERROR:
.SUFFIXES:
.DEFAULT_GOAL := all

ROOT := $(patsubst %/,%,$(dir $(lastword $(MAKEFILE_LIST))))
OUT ?= out/$(NAME)
BIN ?= build/bin
LAUNCH ?=
SIZE ?= 320x180
SEED ?= 1
PHOTONS ?= 1000000
TIMES ?= 2 4 8 16
METHODS ?= bsdf illumination product
REFERENCE_SPP ?= 4096
REFERENCE ?= $(OUT)/reference.exr
SCENE_INPUTS ?=
QUIET ?=

.PHONY: all cache images chart reference clean FORCE
all: chart
chart: $(OUT)/$(NAME).svg
reference: $(OUT)/reference.exr

# $(call stamp,stage,options): a file that changes only when the options do.
define stamp
$(OUT)/.options/$(1): FORCE
	@mkdir -p $$(@D)
	@printf '%s\n' '$(subst ','\'',$(2))' > $$@.new
	@if cmp -s $$@.new $$@; then rm $$@.new; else mv $$@.new $$@; fi
endef
$(eval $(call stamp,brdf-fit,$(SCENE_FLAGS) $(SEED) $(BRDF_FIT_FLAGS)))
$(eval $(call stamp,photon-trace,$(SCENE_FLAGS) $(SEED) $(PHOTONS) $(PHOTON_TRACE_FLAGS)))
$(eval $(call stamp,cache-train,$(CACHE_TRAIN_FLAGS)))
$(eval $(call stamp,cache-reduce,$(CACHE_REDUCE_FLAGS)))
$(eval $(call stamp,render,$(SCENE_FLAGS) $(SEED) $(SIZE) $(RENDER_FLAGS)))
$(eval $(call stamp,reference,$(SCENE_FLAGS) $(SIZE) $(REFERENCE_SPP)))
$(eval $(call stamp,chart,$(METHODS) $(TIMES)))

$(OUT)/scene.brdf $(OUT)/brdf-fit.json &: $(SCENE) $(SCENE_INPUTS) $(OUT)/.options/brdf-fit \
    $(BIN)/brdf-fit
	$(LAUNCH) $(BIN)/brdf-fit $(SCENE) $(SCENE_FLAGS) -o $(OUT)/scene.brdf --seed $(SEED) \
	  --stats $(OUT)/brdf-fit.json $(BRDF_FIT_FLAGS) $(QUIET)

$(OUT)/scene.photons $(OUT)/photon-trace.json &: $(SCENE) $(SCENE_INPUTS) \
    $(OUT)/.options/photon-trace $(BIN)/photon-trace
	$(LAUNCH) $(BIN)/photon-trace $(SCENE) $(SCENE_FLAGS) -o $(OUT)/scene.photons \
	  --count $(PHOTONS) --seed $(SEED) --stats $(OUT)/photon-trace.json \
	  $(PHOTON_TRACE_FLAGS) $(QUIET)

$(OUT)/scene.cache $(OUT)/cache-train.json &: $(OUT)/scene.photons $(OUT)/.options/cache-train \
    $(BIN)/cache-train
	$(LAUNCH) $(BIN)/cache-train --photons $(OUT)/scene.photons -o $(OUT)/scene.cache \
	  --stats $(OUT)/cache-train.json $(CACHE_TRAIN_FLAGS) $(QUIET)

$(OUT)/reduced.% $(OUT)/cache-reduce-%.json: $(OUT)/scene.% $(OUT)/.options/cache-reduce \
    $(BIN)/cache-reduce
	$(LAUNCH) $(BIN)/cache-reduce $(OUT)/scene.$* -o $(OUT)/reduced.$* \
	  --stats $(OUT)/cache-reduce-$*.json $(CACHE_REDUCE_FLAGS) $(QUIET)

# Caches that each mode needs.
caches_bsdf :=
caches_illumination := $(OUT)/reduced.cache
caches_product := $(OUT)/reduced.cache $(OUT)/reduced.brdf
cache_flags_bsdf :=
cache_flags_illumination := --cache $(OUT)/reduced.cache
cache_flags_product := --cache $(OUT)/reduced.cache --brdf $(OUT)/reduced.brdf
preprocess_bsdf :=
preprocess_illumination := $(foreach s,photon-trace cache-train cache-reduce-cache,$(OUT)/$(s).json)
preprocess_product := $(preprocess_illumination) \
  $(foreach s,brdf-fit cache-reduce-brdf,$(OUT)/$(s).json)
cache: $(caches_product) $(preprocess_product)

# $(call render_rule,mode): images at each time, MODE-SECONDSs.exr, and their figures.
define render_rule
$(OUT)/$(1)-%s.exr $(OUT)/$(1)-%s.json: $(SCENE) $(SCENE_INPUTS) $$(caches_$(1)) \
    $(OUT)/.options/render $(BIN)/render
	$$(LAUNCH) $(BIN)/render $(SCENE) $(SCENE_FLAGS) -o $(OUT)/$(1)-$$*s.exr --mode $(1) \
	  $$(cache_flags_$(1)) --time $$* --size $(SIZE) --seed $(SEED) --aov variance \
	  --png $(OUT)/$(1)-$$*s.png --stats $(OUT)/$(1)-$$*s.json $(RENDER_FLAGS) $(QUIET)

$(OUT)/$(1)-%s.csv: $(OUT)/$(1)-%s.exr $(OUT)/$(1)-%s.json $(REFERENCE) $$(preprocess_$(1)) \
    $(BIN)/image-compare
	@rm -f $$@.tmp
	$$(LAUNCH) $(BIN)/image-compare $(OUT)/$(1)-$$*s.exr $(REFERENCE) \
	  --render-stats $(OUT)/$(1)-$$*s.json $$(preprocess_$(1):%=--preprocess-stats %) \
	  --label scene=$(NAME) --label method=$(1) --error-image $(OUT)/$(1)-$$*s-error.png \
	  --csv $$@.tmp && mv $$@.tmp $$@
endef
$(foreach mode,$(METHODS),$(eval $(call render_rule,$(mode))))

renders := $(foreach m,$(METHODS),$(foreach t,$(TIMES),$(OUT)/$(m)-$(t)s))
figures := $(renders:=.csv)
images: $(renders:=.exr) $(renders:=.json)

$(OUT)/$(NAME).csv: $(figures) $(OUT)/.options/chart
	@awk 'FNR > 1 || NR == 1' $(figures) > $@.tmp && mv $@.tmp $@

$(OUT)/$(NAME).svg: $(OUT)/$(NAME).csv $(BIN)/chart
	$(LAUNCH) $(BIN)/chart $< -o $@ --title "$(NAME)" $(QUIET)

$(OUT)/reference.exr: $(SCENE) $(SCENE_INPUTS) $(caches_product) $(OUT)/.options/reference \
    $(BIN)/render
	$(LAUNCH) $(BIN)/render $(SCENE) $(SCENE_FLAGS) -o $@ --mode product $(cache_flags_product) \
	  --spp $(REFERENCE_SPP) --size $(SIZE) --seed 1000003 --aov variance \
	  --stats $(OUT)/reference.json $(QUIET)

clean:
	rm -rf $(OUT)
