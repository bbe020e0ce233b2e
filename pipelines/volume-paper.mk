# The comparisons of the talk on zero-variance-based volume path guiding, on shipped scenes and one
# made elsewhere:
#
#   make -f pipelines/volume-paper.mk                       everything
#   make -f pipelines/volume-paper.mk SCENES=haze TIME=30 SEEDS=1     a part of it
#   make -f pipelines/volume-paper.mk comparisons           the four tables of SPP and relMSE
#   make -f pipelines/volume-paper.mk training              times, numbers and sizes of the caches
#   make -f pipelines/volume-paper.mk shafts                light shafts at 256 and 1024 samples; of `all`
#                                                           where SCENES has light-shafts
#   make -f pipelines/volume-paper.mk unbiased              z-scores of all methods
#   make -f pipelines/volume-paper.mk clean
#
# An interrupted run goes on where it stopped; results are in out/volume-paper, one folder a scene.
# All of it takes SCENES x METHODS x SEEDS x TIME, 11 hours by default, and the references. The time
# of training is that of all stages before the render.
#
# SCENES           pipelines of this folder; that of a scene made elsewhere needs WAYLIGHT_SCENES
# TIME             seconds of each render
# METHODS          of pipelines/media-methods.mk
# SIZE             of the images
# SHAFTS_SIZE SHAFTS_SPP    of the images of light shafts
$(if $(wildcard pipelines/rules.mk),,$(error run make in the root of the repository))

OUT ?= out/volume-paper
WAYLIGHT_SCENES ?= ../shared/scenes
made_elsewhere := $(if $(wildcard $(WAYLIGHT_SCENES)/volumes/wdas_cloud_sixteenth.vdb),wdas-cloud)
SCENES ?= light-shafts haze lantern lamp-behind backlit-wax smoky-room cloud $(made_elsewhere)
TIME ?= 180
SEEDS ?= 1 2 3
METHODS ?= none distance direction direction-mix both no-rr guided-rr splitting all
SIZE ?= 320x180
SHAFTS_SIZE ?= 640x360
SHAFTS_SPP ?= 256 1024
BIN ?= build/bin
LAUNCH ?=

ROOT := $(patsubst %/,%,$(dir $(lastword $(MAKEFILE_LIST))))

options_light-shafts := PHOTONS=8000000
options_haze := PHOTONS=8000000
options_cloud := REFERENCE_SPP=2048
options_wdas-cloud := REFERENCE_SPP=2048
# Not REFERENCE or METHODS of the environment: every scene has its own.
scene_make = $(MAKE) --no-print-directory -f $(ROOT)/$(1).mk OUT=$(OUT)/$(1) BIN=$(BIN) \
  WAYLIGHT_SCENES=$(WAYLIGHT_SCENES) TIMES='$(TIME)' SEEDS='$(SEEDS)' METHODS='$(METHODS)' \
  SIZE=$(SIZE) 'REFERENCE=$$(OUT)/reference.exr' \
  'UNBIASED_AGAINST=$$(OUT)/reference.exr' $(options_$(1))

.DELETE_ON_ERROR:
.PHONY: all clean comparisons training shafts unbiased FORCE $(SCENES) $(SCENES:%=unbiased-%)
all: comparisons training $(if $(filter light-shafts,$(SCENES)),shafts) unbiased
comparisons: $(OUT)/comparisons.md
training: $(OUT)/training.md

$(SCENES):
	+$(call scene_make,$@)

# $(call comparison,minutes,methods,figures of the talk)
comparison = awk -f $(ROOT)/tables/figures.awk -f $(ROOT)/tables/talk.awk -v minutes=$(1) \
  -v wanted='$(2)' -v talk='$(3)' $(foreach s,$(SCENES),$(OUT)/$(s)/$(s).csv)

$(OUT)/comparisons.md: $(SCENES)
	@($(call comparison,45,none distance,960:1.342 424:0.901) && \
	  $(call comparison,30,none direction direction-mix both,2212:0.376 1756:0.048 - 1228:0.034) && \
	  $(call comparison,45,no-rr guided-rr splitting,468:0.454 1500:0.174 1340:0.066) && \
	  $(call comparison,60,none distance both all,10644:11.58 4624:3.520 4448:0.468 3796:0.321)) \
	  > $@.tmp && mv $@.tmp $@ && cat $@

$(OUT)/training.md: $(SCENES)
	@$(ROOT)/tables/training.sh $(SCENES:%=$(OUT)/%) > $@.tmp && mv $@.tmp $@ && cat $@

# Light shafts at equal samples, for which the cache of the scene is enough: $(OUT)/shafts/METHOD-SPP.png.
shafts: $(foreach n,$(SHAFTS_SPP),$(foreach m,none distance,$(OUT)/shafts/$(m)-$(n).png))
shafts_cache := $(OUT)/light-shafts/reduced.cache
shafts_none := --distance standard
shafts_distance := --distance guided --cache $(shafts_cache)

# Where the scene's own pipeline runs too, after it: two must not write the folder at the same time.
runs_scenes := $(filter all comparisons training unbiased unbiased-% $(SCENES),$(or $(MAKECMDGOALS),all))
$(shafts_cache): $(if $(runs_scenes),$(filter light-shafts,$(SCENES))) FORCE
	+$(call scene_make,light-shafts) $@

# A file that changes only when the size does.
$(OUT)/.options/shafts: FORCE
	@mkdir -p $(@D)
	@echo '$(SHAFTS_SIZE)' > $@.new
	@if cmp -s $@.new $@; then rm $@.new; else mv $@.new $@; fi

define shafts_rule
$(OUT)/shafts/$(1)-%.png: $(shafts_cache) $(OUT)/.options/shafts $(BIN)/render
	@mkdir -p $$(@D)
	$(LAUNCH) $(BIN)/render $(ROOT)/scenes/light-shafts.xml -o $$(basename $$@).exr --png $$@ --mode bsdf \
	  --direction standard --rr throughput $(shafts_$(1)) --size $(SHAFTS_SIZE) --spp $$* \
	  --seed 1 --aov variance --stats $$(basename $$@).json $(QUIET)
endef
$(foreach m,none distance,$(eval $(call shafts_rule,$(m))))

$(SCENES:%=unbiased-%): unbiased-%: %
	+$(call scene_make,$*) unbiased
unbiased: $(SCENES:%=unbiased-%)
	@awk 'FNR > 2 || NR < 3' $(foreach s,$(SCENES),$(OUT)/$(s)/unbiased.md) > $(OUT)/unbiased.tmp
	@mv $(OUT)/unbiased.tmp $(OUT)/unbiased.md && cat $(OUT)/unbiased.md

clean:
	rm -rf $(OUT)
