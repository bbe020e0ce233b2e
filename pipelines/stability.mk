# Where methods fail: a table of cases and methods with the verdicts of docs/stability.md.
#
#   make -f pipelines/stability.mk -j2         all of it: table.txt, table.csv, stability.html
#   make -f pipelines/stability.mk fast -j2    small images, few seeds, no judgement of time: always
#                                              the same table
#   make -f pipelines/stability.mk CASES='few-photons closed-door'
#   make -f pipelines/stability.mk auto        what mode auto costs over bsdf and over the best method
#
# It fails when a verdict does that pipelines/stability/known does not list. Each case is a folder of
# results; it runs again when its line in pipelines/stability/cases, its scene, a tool or what judges
# it changes.
#
# OUT BIN          folder of results, folder of the executables
# CASES            which, by name
# SIZE SPP SEEDS   of the renders that are judged
# REFERENCE_SPP PHOTONS ENTRIES    of references, caches, and fits
# CACHE_TRAIN_FLAGS of all cases
# LIMIT            seconds that one run of a tool may take
# TIMED            1: judge times too
.DELETE_ON_ERROR:
.SUFFIXES:
.DEFAULT_GOAL := all

$(if $(wildcard pipelines/rules.mk),,$(error run make in the root of the repository))

ROOT := $(patsubst %/,%,$(dir $(lastword $(MAKEFILE_LIST))))
STABILITY := $(ROOT)/stability
BIN ?= build/bin
LIMIT ?= 120
table := $(STABILITY)/cases
all_cases := $(shell awk -F'|' '!/^#/ && NF > 1 { print $$1 }' $(table))
ifneq ($(filter fast,$(MAKECMDGOALS)),)
OUT ?= out/stability-fast
SIZE ?= 32x18
SPP ?= 8
SEEDS ?= 2
REFERENCE_SPP ?= 256
PHOTONS ?= 20000
ENTRIES ?= 8
TIMED ?= 0
# Not the tests that take seconds, which ctest runs itself, nor the lamp that few samples find.
CASES ?= $(filter-out pixel-estimate-off small-lamp-in-bulb,$(all_cases))
endif
OUT ?= out/stability
SIZE ?= 64x36
SPP ?= 8
SEEDS ?= 16
REFERENCE_SPP ?= 512
PHOTONS ?= 100000
ENTRIES ?= 512
TIMED ?= 1

CASES ?= $(all_cases)
$(if $(filter-out $(all_cases),$(CASES)),$(error no case \
  $(filter-out $(all_cases),$(CASES)): known are $(strip $(all_cases))))

include $(ROOT)/media-methods.mk

# Sets of methods, each a mode of `render` or a name with mode_NAME and flags_NAME; the first is what
# the others must do no harm to.
surface_methods := bsdf illumination mixture ris product product-split auto
splitting_methods := bsdf product product-split split-20 split-preview
medium_methods := bsdf illumination product $(guided_methods) all auto
mode_product-split := product
flags_product-split := --split $(SPLIT)
mode_split-20 := product
flags_split-20 := --split 20
mode_split-preview := product
flags_split-preview := --split 20 --pixel-estimate preview
caches_bsdf := -
caches_illumination := cache
caches_ris := cache
caches_product := cache+brdf
caches_mixture := cache+brdf
caches_auto := cache+brdf
mode_of = $(or $(mode_$(1)),$(1))
caches_of = $(caches_$(or $(needs_$(1)),$(call mode_of,$(1))))
rows_of = $(foreach m,$($(2)),'$(1) $(m) $(call caches_of,$(m)) --mode $(call mode_of,$(m)) $(flags_$(m))')
methods := $(call rows_of,surfaces,surface_methods) $(call rows_of,splitting,splitting_methods) \
  $(call rows_of,media,medium_methods) 'tests tests -' \
  $(foreach f,em ceres best,'fits $(f) - --fit $(f)')

.PHONY: all fast auto clean FORCE
all fast: $(OUT)/table.txt $(OUT)/table.csv $(OUT)/stability.html
	@cat $(OUT)/table.txt
	@jq -e 'all(.status != "fail")' $(OUT)/table.json > /dev/null

# $(call stamp,name,lines): a file that changes only when its content does.
define stamp
$(OUT)/.options/$(1): FORCE
	@mkdir -p $$(@D)
	@printf '%s\n' $(2) > $$@.new
	@if cmp -s $$@.new $$@; then rm $$@.new; else mv $$@.new $$@; fi
endef
$(eval $(call stamp,methods,$(methods)))
$(eval $(call stamp,sizes,$(SIZE) $(SPP) $(SEEDS) $(REFERENCE_SPP) $(PHOTONS) $(ENTRIES) $(LIMIT) \
  $(TIMED) $(CACHE_TRAIN_FLAGS)))
$(eval $(call stamp,cases,$(CASES)))
$(foreach c,$(CASES),$(eval $(call stamp,$(c),'$(shell grep -E "^$(c) +\|" $(table))')))

tools := $(foreach t,brdf-fit photon-trace cache-train cache-reduce cache-info render image-compare,\
  $(BIN)/$(t)) $(wildcard $(BIN)/../tests/test_stability)
judges := $(STABILITY)/run.sh $(STABILITY)/failed.jq \
  $(foreach s,fits renders tests,$(STABILITY)/$(s).sh $(STABILITY)/$(s).jq)
scenes := $(addprefix $(STABILITY)/scenes/,$(sort \
  $(shell awk -F'|' '$$4 ~ /\.xml/ { print $$4 }' $(table))))
$(OUT)/inputs/done: $(STABILITY)/inputs.sh $(wildcard $(STABILITY)/*.awk) $(BIN)/make-cloud
	$(STABILITY)/inputs.sh $(@D) $(BIN)
	@touch $@

export INPUTS = $(abspath $(OUT))/inputs
export TABLE = $(table)
export METHODS = $(OUT)/.options/methods
export BIN SIZE SPP SEEDS REFERENCE_SPP PHOTONS ENTRIES LIMIT TIMED CACHE_TRAIN_FLAGS
$(OUT)/%/verdicts.json: $(OUT)/.options/% $(OUT)/.options/methods $(OUT)/.options/sizes \
    $(OUT)/inputs/done $(scenes) $(tools) $(judges)
	@echo "stability: $*"
	@$(STABILITY)/run.sh $* $(OUT)/$*

$(OUT)/table.json: $(CASES:%=$(OUT)/%/verdicts.json) $(STABILITY)/known $(OUT)/.options/cases \
    $(STABILITY)/table.jq
	@jq -s --rawfile known $(STABILITY)/known -f $(STABILITY)/table.jq \
	  $(CASES:%=$(OUT)/%/verdicts.json) > $@.tmp && mv $@.tmp $@
$(OUT)/table.csv: $(OUT)/table.json $(STABILITY)/csv.jq
	@jq -rf $(STABILITY)/csv.jq $< > $@.tmp && mv $@.tmp $@
$(OUT)/table.txt: $(OUT)/table.json $(STABILITY)/text.jq
	@jq -rf $(STABILITY)/text.jq $< > $@.tmp && mv $@.tmp $@
$(OUT)/stability.html: $(OUT)/table.json $(STABILITY)/page.jq
	@jq -rf $(STABILITY)/page.jq $< > $@.tmp && mv $@.tmp $@

auto: $(OUT)/auto.md
	@cat $<
$(OUT)/auto.md: $(OUT)/table.json $(STABILITY)/auto.jq
	@jq -rf $(STABILITY)/auto.jq $< > $@.tmp && mv $@.tmp $@

clean:
	rm -rf $(OUT)
