# Methods in media, one to each way of making the four decisions of a path: whether to scatter and
# where (--distance), in what direction (--direction), and when to end or split (--rr, --split).
# Surfaces are sampled by their BSDF, but in `all` by the cache too.
#
#   none           standard decisions, roulette by throughput
#   distance       distances guided
#   direction      directions by the product of phase function and incident light
#   direction-mix  the mean of the two in place of their product
#   both           distances guided, and directions by the product
#   no-rr          both, without roulette
#   guided-rr      both, roulette by expected contribution
#   splitting      the same, and up to SPLIT copies
#   all            the same, and surfaces guided too
SPLIT ?= 8
guided_media := --distance guided --direction product
flags_none := --distance standard --direction standard --rr throughput
flags_distance := --distance guided --direction standard --rr throughput
flags_direction := --distance standard --direction product --rr throughput
flags_direction-mix := --distance standard --direction mixture --rr throughput
flags_both := $(guided_media) --rr throughput
flags_no-rr := $(guided_media) --rr none
flags_guided-rr := $(guided_media) --rr guided
flags_splitting := $(guided_media) --rr guided --split $(SPLIT)
flags_all := $(guided_media) --rr guided --split $(SPLIT)

mode_none := bsdf
mode_all := illumination
guided_methods := distance direction direction-mix both no-rr guided-rr splitting
$(foreach m,$(guided_methods),$(eval mode_$(m) := bsdf)$(eval needs_$(m) := illumination))
