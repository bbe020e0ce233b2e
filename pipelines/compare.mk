# Methods on scenes, each run to a series of times, as one page and its tables and charts:
#
#   make -f pipelines/compare.mk                            everything
#   make -f pipelines/compare.mk SCENES=gap-room TIMES='1 2' SEEDS='1 2'      a part of it
#   make -f pipelines/compare.mk clean
#
# An interrupted run goes on where it stopped; results are in out/compare: report.html, compare.csv,
# reach.csv (the time to reach the error that the first method has at its end), auto.md (mode auto
# against the first method and the best), and one folder a scene with its images, charts and
# reference. All of it takes SCENES x METHODS x SEEDS x the longest
# of TIMES, 3 hours by default, and the references.
#
# SCENES           pipelines of this folder, by default those whose files are there: of scenes made
#                  elsewhere they are in WAYLIGHT_SCENES
# METHODS          of scenes without media, of pipelines/rules.mk
# MEDIA_METHODS    of scenes with media, of pipelines/media-methods.mk
# TIMES SEEDS      as in pipelines/rules.mk
# SIZE             of the images, in place of each scene's own
# options_SCENE    what else the scene's pipeline gets
# REPORT_FLAGS     what else `report` gets
$(if $(wildcard pipelines/rules.mk),,$(error run make in the root of the repository))

OUT ?= out/compare
WAYLIGHT_SCENES ?= ../shared/scenes
there = $(if $(wildcard $(WAYLIGHT_SCENES)/$(1)),$(2))
media_scenes := light-shafts haze lantern lamp-behind backlit-wax smoky-room cloud \
  $(call there,volumes/wdas_cloud_sixteenth.vdb,wdas-cloud)
default_scenes := $(if $(filter undefined,$(origin SCENES)),all)
SCENES ?= gap-room jewelry $(foreach s,veach-ajar kitchenette living-room,$(call there,$(s),$(s))) \
  $(media_scenes)
made_elsewhere := veach-ajar kitchenette living-room wdas-cloud
left_out := $(if $(default_scenes),$(filter-out $(SCENES),$(made_elsewhere)))
$(if $(left_out),$(info compare.mk leaves out $(left_out): their files are not in \
  WAYLIGHT_SCENES=$(WAYLIGHT_SCENES), see docs/scenes.md))
METHODS ?= bsdf illumination product auto
MEDIA_METHODS ?= none distance direction both all auto
TIMES ?= 1 2 5 10 20 50 100
SEEDS ?= 1 2 3
SIZE ?=
REPORT_FLAGS ?=
BIN ?= build/bin
LAUNCH ?=
QUIET ?=

ROOT := $(patsubst %/,%,$(dir $(lastword $(MAKEFILE_LIST))))

# At its own size kitchenette is compared with the reference that its origin made, whose paths end
# after 21 edges.
options_kitchenette := $(if $(SIZE),,REFERENCE=$(WAYLIGHT_SCENES)/kitchenette/kitchenette_ref.exr \
  COMPARE_FLAGS='$(COMPARE_FLAGS) --resize-reference' \
  RENDER_FLAGS='$(if $(findstring --max-depth,$(RENDER_FLAGS)),,--max-depth 21) $(RENDER_FLAGS)')
methods_of = $(if $(filter $(1),$(media_scenes)),$(MEDIA_METHODS),$(METHODS))
# A shipped reference has one size.
size_of = $(if $(SIZE),SIZE=$(SIZE) 'REFERENCE=$$(OUT)/reference.exr')
scene_make = $(MAKE) --no-print-directory -f $(ROOT)/$(1).mk OUT=$(OUT)/$(1) BIN=$(BIN) \
  WAYLIGHT_SCENES=$(WAYLIGHT_SCENES) TIMES='$(TIMES)' SEEDS='$(SEEDS)' \
  METHODS='$(call methods_of,$(1))' $(size_of) $(options_$(1))

.DELETE_ON_ERROR:
.NOTPARALLEL:
.PHONY: all clean $(SCENES)
all: $(OUT)/compare.csv $(OUT)/report.html $(OUT)/auto.md

$(SCENES):
	+$(call scene_make,$@) charts

tables := $(foreach s,$(SCENES),$(OUT)/$(s)/$(s).csv)
$(tables): $(SCENES)

$(OUT)/compare.csv: $(tables)
	@awk 'FNR > 1 || NR == 1' $^ > $@.tmp && mv $@.tmp $@

$(OUT)/auto.md: $(tables)
	@awk -f $(ROOT)/tables/figures.awk -f $(ROOT)/tables/auto.awk $^ > $@.tmp && mv $@.tmp $@ && cat $@

$(OUT)/report.html $(OUT)/reach.csv &: $(tables) $(BIN)/report
	$(LAUNCH) $(BIN)/report $(tables) -o $(OUT)/report.html --csv $(OUT)/reach.csv $(REPORT_FLAGS) \
	  $(QUIET)

clean:
	rm -rf $(OUT)
