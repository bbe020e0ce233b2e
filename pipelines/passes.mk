# Rules of the training: photons, and the cache trained on them, $(OUT)/scene.cache. Included by
# rules.mk, which lists the variables. `training` is the stages whose time is that of the training.

include $(dir $(lastword $(MAKEFILE_LIST)))guard.mk

traced_lights = --count $(PHOTONS)
traced_camera = --count 0 --paths $(PATHS)
traced_both = --count $(PHOTONS) --paths $(PATHS)
traced := $(or $(traced_$(TRAIN_FROM)),$(error TRAIN_FROM is $(TRAIN_FROM): give lights, camera or both))

ifeq ($(PHOTONS),auto)
$(if $(filter-out 0,$(PASSES)),$(error PHOTONS=auto decides on the passes itself: leave PASSES at 0))
$(eval $(call stamp,train-until,$(strip $(TRAIN_FOR) $(SIZE) $(FIRST_PHOTONS) $(MOST_PHOTONS))))
$(OUT)/scene.cache $(OUT)/photon-trace.json $(OUT)/cache-train.json &: $(SCENE) $(SCENE_INPUTS) \
    $(foreach s,photon-trace cache-train passes train-until,$(OUT)/.options/$(s)) \
    $(foreach t,photon-trace cache-train render image-compare,$(BIN)/$(t))
	BIN='$(BIN)' LAUNCH='$(LAUNCH)' SIZE='$(SIZE)' SEED='$(SEED)' QUIET='$(QUIET)' \
	  FIRST_PHOTONS='$(FIRST_PHOTONS)' MOST_PHOTONS='$(MOST_PHOTONS)' TRAIN_FROM='$(TRAIN_FROM)' \
	  PHOTON_TRACE_FLAGS='$(PHOTON_TRACE_FLAGS)' CACHE_TRAIN_FLAGS='$(CACHE_TRAIN_FLAGS)' \
	  $(ROOT)/train-until.sh $(OUT) $(TRAIN_FOR) $(SCENE) $(scene_flags)

training := photon-trace cache-train
else ifeq ($(PASSES),0)
$(OUT)/scene.photons $(OUT)/photon-trace.json &: $(SCENE) $(SCENE_INPUTS) \
    $(OUT)/.options/photon-trace $(BIN)/photon-trace
	$(LAUNCH) $(BIN)/photon-trace $(SCENE) $(scene_flags) -o $(OUT)/scene.photons \
	  $(traced) --seed $(SEED) --stats $(OUT)/photon-trace.json \
	  $(PHOTON_TRACE_FLAGS) $(QUIET)

$(OUT)/scene.cache $(OUT)/cache-train.json &: $(OUT)/scene.photons $(OUT)/.options/cache-train \
    $(OUT)/.options/passes $(BIN)/cache-train
	$(LAUNCH) $(BIN)/cache-train --photons $(OUT)/scene.photons -o $(OUT)/scene.cache \
	  --stats $(OUT)/cache-train.json $(CACHE_TRAIN_FLAGS) $(QUIET)

training := photon-trace cache-train
else
pass_numbers := $(shell seq $(PASSES))
before = $(shell expr $(1) - 1)
# $(call go_on,pass,suffix): the cache of the pass before, none for the first.
go_on = $(if $(filter 1,$(1)),,$(OUT)/pass-$(call before,$(1)).$(2))

# What guides the photons and the camera paths of a pass.
importance_of = $(if $(filter camera,$(TRAIN_FROM)),,$(OUT)/pass-$(1).importance.cache)
guides_paths = $(if $(filter lights,$(TRAIN_FROM)),,$(call go_on,$(1),cache))

# $(call pass_rules,pass): importons, the importance cache that goes on with them, photons guided by
# it, the radiance cache that goes on with them. Each is a file, so training stops and goes on.
define pass_rules
$(OUT)/pass-$(1).importons $(OUT)/importon-trace-$(1).json &: $(SCENE) $(SCENE_INPUTS) \
    $(OUT)/.options/importons $(BIN)/photon-trace
	$$(LAUNCH) $(BIN)/photon-trace $(SCENE) $(scene_flags) -o $(OUT)/pass-$(1).importons \
	  --from camera --count $(IMPORTONS) --seed $(SEED) --pass $(1) \
	  --stats $(OUT)/importon-trace-$(1).json $(QUIET)

$(OUT)/pass-$(1).importance.cache $(OUT)/importance-train-$(1).json &: \
    $(OUT)/pass-$(1).importons $(call go_on,$(1),importance.cache) $(OUT)/.options/cache-train \
    $(BIN)/cache-train
	$$(LAUNCH) $(BIN)/cache-train --photons $(OUT)/pass-$(1).importons \
	  $(addprefix --in ,$(call go_on,$(1),importance.cache)) \
	  -o $(OUT)/pass-$(1).importance.cache --stats $(OUT)/importance-train-$(1).json \
	  $(CACHE_TRAIN_FLAGS) $(QUIET)

$(OUT)/pass-$(1).photons $(OUT)/photon-trace-$(1).json &: $(SCENE) $(SCENE_INPUTS) \
    $(call importance_of,$(1)) $(call guides_paths,$(1)) $(OUT)/.options/photon-trace \
    $(BIN)/photon-trace
	$$(LAUNCH) $(BIN)/photon-trace $(SCENE) $(scene_flags) -o $(OUT)/pass-$(1).photons \
	  $(addprefix --importance ,$(call importance_of,$(1))) \
	  $(addprefix --cache ,$(call guides_paths,$(1))) $(traced) --seed $(SEED) --pass $(1) --stats $(OUT)/photon-trace-$(1).json $(PHOTON_TRACE_FLAGS) $(QUIET)

$(OUT)/pass-$(1).cache $(OUT)/cache-train-$(1).json &: $(OUT)/pass-$(1).photons \
    $(call go_on,$(1),cache) $(OUT)/.options/cache-train $(BIN)/cache-train
	$$(LAUNCH) $(BIN)/cache-train --photons $(OUT)/pass-$(1).photons \
	  $(addprefix --in ,$(call go_on,$(1),cache)) -o $(OUT)/pass-$(1).cache \
	  --stats $(OUT)/cache-train-$(1).json $(CACHE_TRAIN_FLAGS) $(QUIET)

$(OUT)/pass-$(1).reduced.cache: $(OUT)/pass-$(1).cache $(OUT)/.options/cache-reduce \
    $(BIN)/cache-reduce
	$$(LAUNCH) $(BIN)/cache-reduce $$< -o $$@ $(CACHE_REDUCE_FLAGS) $(QUIET)

$(OUT)/pass-$(1).exr $(OUT)/pass-$(1).json &: $(SCENE) $(SCENE_INPUTS) \
    $(OUT)/pass-$(1).reduced.cache $(OUT)/reduced.brdf $(OUT)/.options/render \
    $(OUT)/.options/passes-chart $(BIN)/render
	$$(LAUNCH) $(BIN)/render $(SCENE) $(scene_flags) -o $(OUT)/pass-$(1).exr --mode product \
	  --cache $(OUT)/pass-$(1).reduced.cache --brdf $(OUT)/reduced.brdf --spp $(PASSES_SPP) \
	  --size $(SIZE) --seed $(SEED) --aov variance --stats $(OUT)/pass-$(1).json \
	  $(RENDER_FLAGS) $(QUIET)

$(OUT)/pass-$(1).csv: $(OUT)/pass-$(1).exr $(OUT)/pass-$(1).json $(REFERENCE) \
    $(OUT)/.options/measure $(BIN)/image-compare
	$$(call measure,$(OUT)/pass-$(1),product)
endef
$(foreach i,$(pass_numbers),$(eval $(call pass_rules,$(i))))

$(OUT)/scene.cache: $(OUT)/pass-$(PASSES).cache $(OUT)/.options/passes
	cp $< $@.tmp && mv $@.tmp $@

$(OUT)/passes.csv: $(pass_numbers:%=$(OUT)/pass-%.csv) $(OUT)/.options/passes
	@awk -f $(ROOT)/tables/labelled.awk column=pass \
	  $(foreach i,$(pass_numbers),value=$(i) $(OUT)/pass-$(i).csv) > $@.tmp && mv $@.tmp $@

$(OUT)/passes.svg: $(OUT)/passes.csv $(BIN)/chart
	$(LAUNCH) $(BIN)/chart $< -o $@ --x pass --linear x \
	  --title "$(NAME): product guiding, $(PASSES_SPP) samples per pixel" $(QUIET)

training := $(foreach i,$(pass_numbers),$(if $(call importance_of,$(i)),\
  importon-trace-$(i) importance-train-$(i)) photon-trace-$(i) cache-train-$(i))
endif

# Without passes there is nothing to draw, though a chart of other options may be there.
ifeq ($(filter-out 0,$(PASSES)),)
$(OUT)/passes.svg: FORCE
	@echo "passes-chart needs PASSES=N, at least 1" >&2; exit 2
endif
