# One rule per stage. A pipeline is a file that sets a scene and options and includes this one:
#
#   make -f pipelines/gap-room.mk            everything: caches, images, figures, chart
#   make -f pipelines/gap-room.mk cache      the caches only
#   make -f pipelines/gap-room.mk passes-chart PASSES=4    error after each pass of training
#   make -f pipelines/gap-room.mk report     the same as one page, with the images
#   make -f pipelines/gap-room.mk charts     error over time and samples, and what a sample costs
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
# SCENE_FLAGS      -D name=value for every tool that reads the scene; a pipeline that has some of its own
#                  sets PIPELINE_FLAGS
# SCENE_INPUTS     files that the scene reads beside SCENE: all begins again when they change
# QUIET            -q: tools say only what is wrong
# SIZE             image size
# SEED             of everything random
# SEEDS            seeds of the renders, for charts with a band                $(SEED)
# PHOTONS          particles to emit in one pass; auto: passes of more and more, until another would
#                  not pay for itself in a render of TRAIN_FOR seconds (train-until.sh); the first
#                  traces FIRST_PHOTONS, none more than MOST_PHOTONS
# TRAIN_FOR        the longest of TIMES
# TRAIN_FROM       lights: PHOTONS teach the cache; camera: PATHS do, paths from the camera that carry
#                  radiance back; both: both, in one cache
# PATHS            camera paths of one pass                                   a quarter of PHOTONS,
#                  and always so with PHOTONS=auto
# PASSES           passes in which importons train an importance cache and photons guided by it the
#                  radiance cache, each going on from the pass before; camera paths are guided by
#                  the radiance cache of the pass before; 0: unguided, once
# IMPORTONS        importons of one pass
# PASSES_SPP       samples per pixel of the renders of passes-chart
# TIMES            seconds after which a render writes its image and figures; one render of the
#                  longest serves them all
# METHODS          what to compare: render modes, or names of your own with a mode and flags, as in
#                  METHODS='product product-8' mode_product-8=product flags_product-8='--max-depth 8'
#                  A method gets the caches of its mode, or of the one that needs_NAME says.
# BRDF_FIT_FLAGS PHOTON_TRACE_FLAGS CACHE_TRAIN_FLAGS CACHE_REDUCE_FLAGS RENDER_FLAGS COMPARE_FLAGS
#                  The reference is not rendered with RENDER_FLAGS: what changes the image, as
#                  --max-depth, belongs into REFERENCE_FLAGS too.
# REFERENCE        image to compare with; made from REFERENCE_SPP samples of REFERENCE_MODE, with
#                  REFERENCE_FLAGS, when it is not set

.DELETE_ON_ERROR:
.SUFFIXES:
.DEFAULT_GOAL := all

include $(dir $(lastword $(MAKEFILE_LIST)))guard.mk

ROOT := $(patsubst %/,%,$(dir $(lastword $(MAKEFILE_LIST))))
OUT ?= out/$(NAME)
BIN ?= build/bin
LAUNCH ?=
SIZE ?= 320x180
SEED ?= 1
SEEDS ?= $(SEED)
PHOTONS ?= 1000000
TRAIN_FROM ?= lights
PATHS ?= $(if $(filter auto,$(PHOTONS)),auto,$(shell expr $(PHOTONS) / 4))
PASSES ?= 0
IMPORTONS ?= 250000
PASSES_SPP ?= 32
TIMES ?= 2 4 8 16
TRAIN_FOR ?= $(shell printf '%g\n' $(TIMES) | sort -g | tail -n 1)
METHODS ?= bsdf illumination product
REFERENCE_SPP ?= 4096
REFERENCE_MODE ?= product
REFERENCE_FLAGS ?=
REFERENCE ?= $(OUT)/reference.exr
SCENE_INPUTS ?=
QUIET ?=
scene_flags = $(strip $(PIPELINE_FLAGS) $(SCENE_FLAGS))

.PHONY: all cache images chart charts report summary passes-chart reference clean FORCE
all: chart summary
chart: $(OUT)/$(NAME).svg
report: $(OUT)/report.html
summary: $(OUT)/summary.txt
passes-chart: $(OUT)/passes.svg
reference: $(OUT)/reference.exr

# $(call stamp,stage,options): a file that changes only when the options do.
define stamp
$(OUT)/.options/$(1): FORCE
	@mkdir -p $$(@D)
	@printf '%s\n' '$(subst ','\'',$(2))' > $$@.new
	@if cmp -s $$@.new $$@; then rm $$@.new; else mv $$@.new $$@; fi
endef
$(eval $(call stamp,brdf-fit,$(scene_flags) $(SEED) $(BRDF_FIT_FLAGS)))
$(eval $(call stamp,photon-trace,$(scene_flags) $(SEED) $(PHOTONS) $(PHOTON_TRACE_FLAGS)$(if \
  $(filter-out lights,$(TRAIN_FROM)), $(TRAIN_FROM) $(PATHS))))
$(eval $(call stamp,importons,$(scene_flags) $(SEED) $(IMPORTONS)))
$(eval $(call stamp,passes,$(PASSES)))
$(eval $(call stamp,passes-chart,$(PASSES_SPP)))
$(eval $(call stamp,cache-train,$(CACHE_TRAIN_FLAGS)))
$(eval $(call stamp,cache-reduce,$(CACHE_REDUCE_FLAGS)))
$(eval $(call stamp,render,$(scene_flags) $(SEED) $(SIZE) $(RENDER_FLAGS)))
$(eval $(call stamp,reference,$(scene_flags) $(SIZE) $(REFERENCE_SPP) $(REFERENCE_MODE) \
  $(REFERENCE_FLAGS)))
$(eval $(call stamp,measure,$(REFERENCE) $(COMPARE_FLAGS)))
$(eval $(call stamp,chart,$(METHODS) $(TIMES) $(SEEDS)))

$(OUT)/scene.brdf $(OUT)/brdf-fit.json &: $(SCENE) $(SCENE_INPUTS) $(OUT)/.options/brdf-fit \
    $(BIN)/brdf-fit
	$(LAUNCH) $(BIN)/brdf-fit $(SCENE) $(scene_flags) -o $(OUT)/scene.brdf --seed $(SEED) \
	  --stats $(OUT)/brdf-fit.json $(BRDF_FIT_FLAGS) $(QUIET)

# $(call measure,stem,method,preprocessing,flags): the figures of an image as the table $@.
define measure
@rm -f $@.tmp
$(LAUNCH) $(BIN)/image-compare $(1).exr $(REFERENCE) --render-stats $(1).json \
  $(3:%=--preprocess-stats %) --label scene=$(NAME) --label method=$(2) --csv $@.tmp $(4) \
  $(COMPARE_FLAGS) $(QUIET)
@mv $@.tmp $@
endef

include $(ROOT)/passes.mk

$(OUT)/reduced.% $(OUT)/cache-reduce-%.json: $(OUT)/scene.% $(OUT)/.options/cache-reduce \
    $(BIN)/cache-reduce
	$(LAUNCH) $(BIN)/cache-reduce $(OUT)/scene.$* -o $(OUT)/reduced.$* \
	  --stats $(OUT)/cache-reduce-$*.json $(CACHE_REDUCE_FLAGS) $(QUIET)

# Caches that each mode needs.
caches_bsdf :=
caches_illumination := $(OUT)/reduced.cache
caches_ris := $(caches_illumination)
caches_product := $(OUT)/reduced.cache $(OUT)/reduced.brdf
caches_mixture := $(caches_product)
caches_auto := $(caches_product)
preprocess_bsdf :=
preprocess_illumination := $(foreach s,$(training) cache-reduce-cache,$(OUT)/$(s).json)
preprocess_product := $(preprocess_illumination) \
  $(foreach s,brdf-fit cache-reduce-brdf,$(OUT)/$(s).json)
preprocess_ris := $(preprocess_illumination)
preprocess_mixture := $(preprocess_product)
preprocess_auto := $(preprocess_product)
cache_flags = $(patsubst %.brdf,--brdf %.brdf,$(patsubst %.cache,--cache %.cache,$(1)))
mode_of = $(or $(mode_$(1)),$(1))
needs_of = $(or $(needs_$(1)),$(call mode_of,$(1)))
needs := $(sort $(foreach m,$(METHODS),$(call needs_of,$(m))))
cache: $(foreach m,$(needs),$(caches_$(m)) $(preprocess_$(m)))

# Stem of a render: METHOD, and its seed where that is not SEED; its images are STEM-SECONDSs.
seed_suffix = $(if $(filter-out $(SEED),$(1)),-seed$(1))
stem_of = $(OUT)/$(1)$(call seed_suffix,$(2))
times := $(shell printf '%g\n' $(TIMES) | sort -gu)
images_of = $(foreach t,$(times),$(call stem_of,$(1),$(2))-$(t)s)
empty :=
comma := ,
checkpoints := $(subst $(empty) $(empty),$(comma),$(strip $(times)))

# $(call render_rule,method,seed,mode,needs,stem,images): one render with an image at each time, and
# the figures of these.
define render_rule
$(6:=.exr) $(6:=.json) &: $(SCENE) $(SCENE_INPUTS) $$(caches_$(4)) $(OUT)/.options/render \
    $(OUT)/.options/render-$(1) $(BIN)/render
	$$(LAUNCH) $(BIN)/render $(SCENE) $(scene_flags) -o $(5).exr --mode $(3) \
	  $$(call cache_flags,$$(caches_$(4))) --checkpoints $(checkpoints) --size $(SIZE) \
	  --seed $(2) --aov variance --png $(5).png --stats $(5).json $(flags_$(1)) $(RENDER_FLAGS) \
	  $(QUIET)

$(6:=.csv): %.csv: %.exr $(6:=.json) $(REFERENCE) $$(preprocess_$(4)) $(OUT)/.options/measure \
    $(BIN)/image-compare
	$$(call measure,$$*,$(1),$$(preprocess_$(4)),--error-image $$*-error.png)
endef
render_rules_of = $(call render_rule,$(1),$(2),$(call mode_of,$(1)),$(call needs_of,$(1)),$(call \
  stem_of,$(1),$(2)),$(call images_of,$(1),$(2)))
$(foreach m,$(METHODS),$(eval $(call stamp,render-$(m),$(call mode_of,$(m)) $(flags_$(m)))) \
  $(foreach s,$(SEEDS),$(eval $(call render_rules_of,$(m),$(s)))))

# Seed by seed, so that what else the machine does falls on all methods alike.
renders := $(foreach s,$(SEEDS),$(foreach m,$(METHODS),$(call images_of,$(m),$(s))))
figures := $(renders:=.csv)
images: $(renders:=.exr) $(renders:=.json)

$(OUT)/$(NAME).csv: $(figures) $(OUT)/.options/chart
	@awk 'FNR > 1 || NR == 1' $(figures) > $@.tmp && mv $@.tmp $@

# What was modelled, what it cost, and what it bought. Other runs may have left statistics too.
stages = $(foreach s,brdf-fit $(training) cache-reduce-brdf cache-reduce-cache,$(if \
  $(filter $(OUT)/$(s).json,$(foreach m,$(needs),$(preprocess_$(m)))),$(s)))
$(OUT)/summary.txt: $(OUT)/$(NAME).csv $(ROOT)/tables/summary.sh
	@$(ROOT)/tables/summary.sh $(OUT) $< $(stages) > $@.tmp && mv $@.tmp $@ && cat $@

$(OUT)/$(NAME).svg: $(OUT)/$(NAME).csv $(BIN)/chart
	$(LAUNCH) $(BIN)/chart $< -o $@ --title "$(NAME)" $(QUIET)

chart_total := --preprocess
chart_spp := --x spp
chart_sample := --y sample_ms --bars
chart_path := --y path_length --bars
chart_memory := --y memory_bytes --bars
charts: chart $(foreach c,total spp sample path memory,$(OUT)/$(NAME)-$(c).svg)
$(OUT)/$(NAME)-%.svg: $(OUT)/$(NAME).csv $(BIN)/chart
	$(LAUNCH) $(BIN)/chart $< -o $@ --title "$(NAME)" $(chart_$*) $(QUIET)

$(OUT)/report.html: $(OUT)/$(NAME).csv $(BIN)/report
	$(LAUNCH) $(BIN)/report $< -o $@ --title "$(NAME)" $(QUIET)

# Its mean does not depend on the caches that guide it: it is not made again with them.
$(OUT)/reference.exr: $(SCENE) $(SCENE_INPUTS) $(OUT)/.options/reference $(BIN)/render \
    | $(caches_$(REFERENCE_MODE))
	$(LAUNCH) $(BIN)/render $(SCENE) $(scene_flags) -o $@ --mode $(REFERENCE_MODE) \
	  $(call cache_flags,$(caches_$(REFERENCE_MODE))) $(REFERENCE_FLAGS) \
	  --spp $(REFERENCE_SPP) --size $(SIZE) --seed 1000003 --aov variance \
	  --stats $(OUT)/reference.json $(QUIET)

clean:
	rm -rf $(OUT)

include $(ROOT)/studies.mk
