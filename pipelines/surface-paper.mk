# The tables and charts of the product-sampling paper, on shipped scenes and scenes made elsewhere:
#
#   make -f pipelines/surface-paper.mk                      everything
#   make -f pipelines/surface-paper.mk SCENES=gap-room SECONDS=30 SEEDS=1     a part of it
#   make -f pipelines/surface-paper.mk equal-time           error at equal time
#   make -f pipelines/surface-paper.mk preprocessing        times, numbers and sizes of the caches
#   make -f pipelines/surface-paper.mk studies              reduction, overhead and z-scores
#   make -f pipelines/surface-paper.mk clean
#
# An interrupted run goes on where it stopped; results are in out/surface-paper, one folder a scene.
# All of it takes SCENES x METHODS x SEEDS x SECONDS, 6 hours by default, and the references.
#
# SCENES           pipelines of this folder; those of scenes made elsewhere need WAYLIGHT_SCENES
# SECONDS          of each render
# SIZE             of the images, in place of each scene's own
$(if $(wildcard pipelines/rules.mk),,$(error run make in the root of the repository))

OUT ?= out/surface-paper
SCENES ?= gap-room jewelry veach-ajar kitchenette living-room
SECONDS ?= 300
SEEDS ?= 1 2 3
SIZE ?=
METHODS ?= bsdf illumination ris product product-split
BIN ?= build/bin
WAYLIGHT_SCENES ?= ../shared/scenes

ROOT := $(patsubst %/,%,$(dir $(lastword $(MAKEFILE_LIST))))

# All at 640 pixels; at its own size kitchenette is compared with the reference that its origin made,
# whose paths end after 21 edges.
options_gap-room := SIZE=$(or $(SIZE),640x360) PHOTONS=4000000
options_jewelry := SIZE=$(or $(SIZE),640x360) PHOTONS=4000000
options_veach-ajar := PHOTONS=8000000
options_kitchenette := $(if $(SIZE),,REFERENCE=$(WAYLIGHT_SCENES)/kitchenette/kitchenette_ref.exr \
  COMPARE_FLAGS='$(COMPARE_FLAGS) --resize-reference' \
  RENDER_FLAGS='$(if $(findstring --max-depth,$(RENDER_FLAGS)),,--max-depth 21) $(RENDER_FLAGS)')
reference_of = $(if $(findstring REFERENCE=,$(options_$(1))),,'REFERENCE=$$(OUT)/reference.exr')
scene_make = $(MAKE) --no-print-directory -f $(ROOT)/$(1).mk OUT=$(OUT)/$(1) BIN=$(BIN) \
  WAYLIGHT_SCENES=$(WAYLIGHT_SCENES) TIMES='$(SECONDS)' SEEDS='$(SEEDS)' METHODS='$(METHODS)' \
  mode_product-split=product flags_product-split='--split 8' \
  $(call reference_of,$(1)) $(options_$(1))

.DELETE_ON_ERROR:
.PHONY: all clean equal-time preprocessing studies $(SCENES) $(SCENES:%=studies-%)
all: equal-time preprocessing studies
equal-time: $(OUT)/equal-time.md
preprocessing: $(OUT)/preprocessing.md

$(SCENES):
	+$(call scene_make,$@)

$(OUT)/equal-time.md: $(SCENES)
	@awk -f $(ROOT)/tables/figures.awk -f $(ROOT)/tables/equal-time.awk \
	  $(foreach s,$(SCENES),$(OUT)/$(s)/$(s).csv) > $@.tmp
	@mv $@.tmp $@ && cat $@

$(OUT)/preprocessing.md: $(SCENES)
	@$(ROOT)/tables/preprocessing.sh $(SCENES:%=$(OUT)/%) > $@.tmp && mv $@.tmp $@ && cat $@

$(SCENES:%=studies-%): studies-%: %
	+$(call scene_make,$*) reduction overhead unbiased
studies: $(SCENES:%=studies-%)
	@for table in overhead unbiased; do \
	  awk 'FNR > 2 || NR < 3' $(foreach s,$(SCENES),$(OUT)/$(s)/$$table.md) > $(OUT)/$$table.tmp && \
	    mv $(OUT)/$$table.tmp $(OUT)/$$table.md && cat $(OUT)/$$table.md || exit 1; done

clean:
	rm -rf $(OUT)
