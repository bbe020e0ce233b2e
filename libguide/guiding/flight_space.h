#pragma once
// What the samplers of flights through media have in common.

#include "libguide/guiding/medium_guides.h"
#include "libguide/medium/medium_tracker.h"

namespace waylight {

struct FlightOptions {
  // Of flights that ignore the guide, in (0, 1]. A quarter is a tenth better where cells are right,
  // and twice as noisy where some are not: its weights of four multiply along a path.
  float standard_share = 0.5f;
  float bias = 0.5f;         // of exponential biasing: factor of the extinction, positive
  bool guides_grids = true;  // whether flights through media that vary are guided too
};

// What a flight is through. with_direct: whether light straight from emitters counts at the end of
// the ray; it does not where next-event estimation at the ray's origin samples it.
struct FlightSpace {
  const MediumTracker& medium;
  const MediumGuides& guides;
  int index;  // of the medium
  Ray ray;
  float t_max;
  Color channels;  // probabilities of the colour channels, which sum to 1
  bool with_direct;
};

}  // namespace waylight
