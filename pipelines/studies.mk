# What one stage's choice costs and buys, for the scene of any pipeline:
#
#   make -f pipelines/gap-room.mk reduction    error and time per path edge over the threshold of
#                                              cache-reduce: reduction.csv, reduction.svg
#   make -f pipelines/gap-room.mk trade-offs   error over time of what each stage leaves to choose;
#                                              trade-off-photons and so on one by one
#   make -f pipelines/gap-room.mk overhead     time per path edge of product over illumination
#                                              guiding, before and after reduction: overhead.md
#   make -f pipelines/gap-room.mk unbiased     z-scores of every method against the first one, or
#                                              against UNBIASED_AGAINST: unbiased.md
#
# THRESHOLDS       percent of the cost of collapsing to one component
# STUDY_SPP        samples per pixel of the renders
# UNBIASED_SPP     of the renders whose means are compared
# UNBIASED_AGAINST image with variance that all methods are compared with, as the reference
include $(dir $(lastword $(MAKEFILE_LIST)))guard.mk

THRESHOLDS ?= 0 1 2 5 10 20 30 50 70 90
STUDY_SPP ?= 32
UNBIASED_SPP ?= 256
UNBIASED_AGAINST ?=

.PHONY: reduction overhead unbiased
reduction: $(OUT)/reduction.svg
overhead: $(OUT)/overhead.md
unbiased: $(OUT)/unbiased.md

include $(ROOT)/trade-offs.mk

$(eval $(call stamp,study,$(scene_flags) $(SEED) $(SIZE) $(RENDER_FLAGS) $(STUDY_SPP)))
$(eval $(call stamp,reduction,$(THRESHOLDS)))
$(eval $(call stamp,unbiased,$(scene_flags) $(SIZE) $(RENDER_FLAGS) $(UNBIASED_SPP) \
  $(UNBIASED_AGAINST) $(METHODS)))
study_render = $(LAUNCH) $(BIN)/render $(SCENE) $(scene_flags) --spp $(STUDY_SPP) --size $(SIZE) \
  --seed $(or $(1),$(SEED)) $(RENDER_FLAGS) $(QUIET)
$(OUT)/reduction/%.brdf $(OUT)/reduction/%.brdf.json: $(OUT)/scene.brdf $(BIN)/cache-reduce
	@mkdir -p $(@D)
	$(LAUNCH) $(BIN)/cache-reduce $< -o $(OUT)/reduction/$*.brdf --max-cost $* \
	  --stats $(OUT)/reduction/$*.brdf.json $(QUIET)

$(OUT)/reduction/%.cache $(OUT)/reduction/%.cache.json: $(OUT)/scene.cache $(BIN)/cache-reduce
	@mkdir -p $(@D)
	$(LAUNCH) $(BIN)/cache-reduce $< -o $(OUT)/reduction/$*.cache --max-cost $* \
	  --stats $(OUT)/reduction/$*.cache.json $(QUIET)

$(OUT)/reduction/%.exr $(OUT)/reduction/%.json: $(OUT)/reduction/%.brdf $(OUT)/reduction/%.cache \
    $(OUT)/.options/study $(BIN)/render
	$(study_render) -o $(OUT)/reduction/$*.exr --stats $(OUT)/reduction/$*.json --mode product \
	  --brdf $(OUT)/reduction/$*.brdf --cache $(OUT)/reduction/$*.cache

$(OUT)/reduction/%.csv: $(OUT)/reduction/%.exr $(OUT)/reduction/%.json $(REFERENCE) \
    $(OUT)/.options/measure $(BIN)/image-compare
	$(LAUNCH) $(BIN)/image-compare $(OUT)/reduction/$*.exr $(REFERENCE) $(COMPARE_FLAGS) --json > $@.json
	jq -rs --arg threshold $* -f $(ROOT)/tables/reduction.jq $(OUT)/reduction/$*.brdf.json \
	  $(OUT)/reduction/$*.cache.json $(OUT)/reduction/$*.json $@.json > $@.tmp && mv $@.tmp $@

# Kept, though nothing names them.
.PRECIOUS: $(foreach e,brdf brdf.json cache cache.json exr json csv,$(OUT)/reduction/%.$(e)) \
  $(OUT)/unbiased/%.exr $(OUT)/unbiased/%.json
$(OUT)/reduction.csv: $(THRESHOLDS:%=$(OUT)/reduction/%.csv) $(OUT)/.options/reduction
	@(echo threshold,brdf_components,cache_components,relmse,relmse_trimmed,edge_us,brdf_bytes,cache_bytes,method; \
	  cat $(THRESHOLDS:%=$(OUT)/reduction/%.csv)) > $@.tmp && mv $@.tmp $@

$(OUT)/reduction.svg: $(OUT)/reduction.csv $(BIN)/chart
	$(LAUNCH) $(BIN)/chart $< -o $@ --x cache_components --y relmse_trimmed --linear x --title "$(NAME): reduction" $(QUIET)

# One core, so that the times are those of the method and not of its threads.
$(OUT)/overhead/illumination.json: $(OUT)/reduced.cache $(OUT)/.options/study $(BIN)/render
	@mkdir -p $(@D)
	$(study_render) --threads 1 -o $(basename $@).exr --stats $@ --mode illumination \
	  --cache $(OUT)/reduced.cache
$(OUT)/overhead/naive.json: $(OUT)/scene.cache $(OUT)/scene.brdf $(OUT)/.options/study $(BIN)/render
	@mkdir -p $(@D)
	$(study_render) --threads 1 -o $(basename $@).exr --stats $@ --mode product \
	  --cache $(OUT)/scene.cache --brdf $(OUT)/scene.brdf
$(OUT)/overhead/reduced.json: $(OUT)/reduced.cache $(OUT)/reduced.brdf $(OUT)/.options/study \
    $(BIN)/render
	@mkdir -p $(@D)
	$(study_render) --threads 1 -o $(basename $@).exr --stats $@ --mode product \
	  --cache $(OUT)/reduced.cache --brdf $(OUT)/reduced.brdf

$(OUT)/overhead.md: $(foreach v,illumination naive reduced,$(OUT)/overhead/$(v).json)
	@jq -rs --arg scene $(NAME) -f $(ROOT)/tables/overhead.jq $^ > $@.tmp && mv $@.tmp $@ && cat $@

# Every method against one image, each with the variance of its own mean.
define unbiased_rule
$(OUT)/unbiased/$(1).exr: $(SCENE) $(SCENE_INPUTS) $$(caches_$(4)) $(OUT)/.options/unbiased \
    $(OUT)/.options/render-$(1) $(BIN)/render
	@mkdir -p $$(@D)
	$$(LAUNCH) $(BIN)/render $(SCENE) $(scene_flags) -o $$@ --mode $(2) \
	  $$(call cache_flags,$$(caches_$(4))) --spp $(UNBIASED_SPP) --size $(SIZE) --aov variance \
	  --seed $(3) $(flags_$(1)) $(RENDER_FLAGS) $(QUIET)
endef
base := $(if $(UNBIASED_AGAINST),,$(firstword $(METHODS)))
against := $(or $(UNBIASED_AGAINST),$(OUT)/unbiased/$(base).exr)
$(foreach m,$(METHODS),$(eval $(call unbiased_rule,$(m),$(call mode_of,$(m)),\
  $(if $(filter $(base),$(m)),77,78),$(call needs_of,$(m)))))
$(OUT)/unbiased/%.json: $(OUT)/unbiased/%.exr $(against) $(BIN)/image-compare
	$(LAUNCH) $(BIN)/image-compare $< $(against) --z self --tile 32 --json > $@.tmp
	@mv $@.tmp $@

others := $(filter-out $(base),$(METHODS))
$(OUT)/unbiased.md: $(others:%=$(OUT)/unbiased/%.json) $(OUT)/.options/unbiased
	@jq -rn --arg scene $(NAME) --arg base $(or $(base),$(basename $(notdir $(against)))) \
	  -f $(ROOT)/tables/unbiased.jq $(filter %.json,$^) > $@.tmp && mv $@.tmp $@ && cat $@
