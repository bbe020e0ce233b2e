# What a stage leaves to choose, as a chart of error over time with a point for each value:
#
#   make -f pipelines/gap-room.mk trade-off-photons PHOTONS_TRIED='100000 1000000'
#   make -f pipelines/gap-room.mk trade-offs        all of them: trade-off-medium-cells in scenes
#                                                   with media only (media.mk)
#
# A trade-off is a list of values and the variable that takes each in the place of %. The scene's
# pipeline runs once per value in $(OUT)/trade-off-NAME/VALUE, which begins with links to what there
# is: so only the stage that has the option runs again, and what follows it. Results are
# trade-off-NAME.csv and .svg. Included by studies.mk, which says STUDY_SPP.
#
# STUDY_METHOD     method of the renders                         the last of METHODS
# NAME_TRIED       the values, by default as below
# SEEDS            each value is rendered with all of them
include $(dir $(lastword $(MAKEFILE_LIST)))guard.mk

STUDY_METHOD ?= $(lastword $(METHODS))
PHOTONS_TRIED ?= 62500 125000 250000 500000 1000000 2000000 4000000 8000000
CELLS_TRIED ?= 75 150 300 600 1200 2400 4800
MEDIUM_CELLS_TRIED ?= $(CELLS_TRIED)
LOBES_TRIED ?= 1 2 4 8
REDUCTIONS_TRIED ?= 0 1 5 10 20 50 90
SPLITS_TRIED ?= 1 2 4 8 16
WINDOWS_TRIED ?= 1 2 5 10 20 100
TOLERANCES_TRIED ?= 0 0.01 0.02 0.05 0.1 0.2 0.5
FITS_TRIED ?= 1 2 4 8 16
FIT_SAMPLES_TRIED ?= 64 128 256 512 1024 2048
split_setting ?= RENDER_FLAGS='$(RENDER_FLAGS) --split %'

# $(call trade_off,name,values,VARIABLE=value with %,axes of the chart,default)
define trade_off
trade_offs += trade-off-$(1)
trade-off-$(1): $(OUT)/trade-off-$(1).svg
$(eval $(call stamp,trade-off-$(1),$(2)))
$(OUT)/trade-off-$(1)/%/point.csv: $$(caches_$$(study_needs)) $$(preprocess_$$(study_needs)) \
    $(REFERENCE) FORCE
	@mkdir -p $$(@D)
	@find $(OUT) -maxdepth 1 -regex '.*/\(\(scene\|reduced\)\..*\|pass-.*\|.*\.json\|\.options\)' \
	  -exec cp -alfu -t $$(@D) {} +
	+@$(MAKE) --no-print-directory -f $(firstword $(MAKEFILE_LIST)) OUT=$$(@D) $(study_scene) \
	  $(subst %,$$*,$(3)) $$@

$(OUT)/trade-off-$(1).csv: $(2:%=$(OUT)/trade-off-$(1)/%/point.csv) \
    $(OUT)/.options/trade-off-$(1)
	@awk -f $(ROOT)/tables/labelled.awk column=$(1) \
	  $(foreach v,$(2),value=$(v) $(OUT)/trade-off-$(1)/$(v)/point.csv) > $$@.tmp && mv $$@.tmp $$@

$(OUT)/trade-off-$(1).svg: $(OUT)/trade-off-$(1).csv $(BIN)/chart
	$$(LAUNCH) $(BIN)/chart $$< -o $$@ --labels $(1) $(4) --y relmse_trimmed \
	  $(if $(filter $(5),$(2)),--default $(5)) --title "$(NAME): $(1)" $(QUIET)
endef
study_needs := $(call needs_of,$(STUDY_METHOD))
study_scene = SCENE='$(SCENE)' PIPELINE_FLAGS='$(PIPELINE_FLAGS)' SCENE_FLAGS='$(SCENE_FLAGS)' \
  SCENE_INPUTS='$(SCENE_INPUTS)' REFERENCE='$(REFERENCE)'
$(eval $(call trade_off,photons,$(PHOTONS_TRIED),PHOTONS=%,--preprocess,$(PHOTONS)))
$(eval $(call trade_off,cells,$(CELLS_TRIED),\
  CACHE_TRAIN_FLAGS='$(CACHE_TRAIN_FLAGS) --photons-per-cell %',--preprocess,300))
$(if $(guided_media),$(eval $(call trade_off,medium-cells,$(MEDIUM_CELLS_TRIED),\
  CACHE_TRAIN_FLAGS='$(CACHE_TRAIN_FLAGS) --medium-photons-per-cell %',--preprocess,2000)))
$(eval $(call trade_off,lobes,$(LOBES_TRIED),\
  CACHE_TRAIN_FLAGS='$(CACHE_TRAIN_FLAGS) --components %',--preprocess,8))
$(eval $(call trade_off,reduction,$(REDUCTIONS_TRIED),\
  CACHE_REDUCE_FLAGS='$(CACHE_REDUCE_FLAGS) --max-cost %',--preprocess,10))
$(eval $(call trade_off,tolerance,$(TOLERANCES_TRIED),\
  BRDF_FIT_FLAGS='$(BRDF_FIT_FLAGS) --tolerance %',--preprocess,0.02))
$(eval $(call trade_off,split,$(SPLITS_TRIED),$(split_setting),,1))
$(eval $(call trade_off,window,$(WINDOWS_TRIED),\
  RENDER_FLAGS='$(RENDER_FLAGS) --weight-window %',,5))

# One point: renders of equal samples.
$(OUT)/point-%.exr $(OUT)/point-%.json &: $(caches_$(study_needs)) $(OUT)/.options/study \
    $(OUT)/.options/render-$(STUDY_METHOD) $(BIN)/render
	$(call study_render,$*) -o $(OUT)/point-$*.exr --stats $(OUT)/point-$*.json \
	  --mode $(call mode_of,$(STUDY_METHOD)) $(call cache_flags,$(caches_$(study_needs))) \
	  $(flags_$(STUDY_METHOD))
$(OUT)/point-%.csv: $(OUT)/point-%.exr $(OUT)/point-%.json $(REFERENCE) \
    $(preprocess_$(study_needs)) $(OUT)/.options/measure $(BIN)/image-compare
	$(call measure,$(OUT)/point-$*,$(STUDY_METHOD),$(preprocess_$(study_needs)))
$(OUT)/point.csv: $(SEEDS:%=$(OUT)/point-%.csv)
	@awk 'FNR > 1 || NR == 1' $^ > $@.tmp && mv $@.tmp $@

# Fits are judged without a render: seconds of fitting, and error on samples they have not seen.
# $(call fit_study,name,values,flags with the value for $(*F),default)
define fit_study
trade_offs += trade-off-$(1)
trade-off-$(1): $(OUT)/trade-off-$(1).svg
$(OUT)/$(1)/%.json: $(SCENE) $(SCENE_INPUTS) $(OUT)/.options/brdf-fit $(BIN)/brdf-fit
	@mkdir -p $$(@D)
	$$(LAUNCH) $(BIN)/brdf-fit $(SCENE) $$(scene_flags) -o $(OUT)/$(1)/$$*.brdf --seed $(SEED) \
	  --stats $$@ --fit $$(*D) --fixed-components $(3) $$(BRDF_FIT_FLAGS) $$(QUIET)

$(eval $(call stamp,trade-off-$(1),$(2)))
$(OUT)/trade-off-$(1).csv: $(foreach f,em ceres,$(2:%=$(OUT)/$(1)/$(f)/%.json)) \
    $(OUT)/.options/trade-off-$(1)
	@(echo fit,$(1),fit_seconds,held_out_error; for f in em ceres; do for v in $(2); do \
	  jq -r --arg fit $$$$f --arg value $$$$v -f $(ROOT)/tables/fit.jq $(OUT)/$(1)/$$$$f/$$$$v.json \
	  || exit 1; done; done) > $$@.tmp && mv $$@.tmp $$@

$(OUT)/trade-off-$(1).svg: $(OUT)/trade-off-$(1).csv $(BIN)/chart
	$$(LAUNCH) $(BIN)/chart $$< -o $$@ --x fit_seconds --y held_out_error --lines fit --labels $(1) \
	  $(if $(filter $(4),$(2)),--default $(4)) --title "$(NAME): $(1)" $$(QUIET)
.PRECIOUS: $(OUT)/$(1)/%.json
endef
$(eval $(call fit_study,fit-components,$(FITS_TRIED),--components $$(*F),8))
$(eval $(call fit_study,fit-samples,$(FIT_SAMPLES_TRIED),--components 8 --samples $$(*F),512))

.PRECIOUS: $(foreach e,exr json csv,$(OUT)/point-%.$(e))
.PHONY: trade-offs $(trade_offs)
trade-offs: $(trade_offs)
