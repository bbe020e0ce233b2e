#pragma once
// Mixtures of lobes that point to places: a mixture of directions for each point that asks.

#include <span>

#include "libguide/directional/vmf_mixture.h"
#include "libguide/records/focused_lobe.h"

namespace waylight {

class FocusedMixture {
 public:
  static constexpr int kMaxLobes = kLanes;

  // lobes: at most kMaxLobes, valid (is_focused_lobe).
  explicit FocusedMixture(std::span<const FocusedLobe> lobes);

  // The mixture as a point of the world sees it; a lobe is uniform at its focus.
  VmfMixture seen_from(const Vec3& x) const;

 private:
  int count_;
  Lanes weight_{}, focus_x_{}, focus_y_{}, focus_z_{};
  Lanes inverse_size2_{};
};

// Whether from any point within 1e17 of the origin it is a lobe: weight and size positive, both
// and the focus within 1e-17 .. 1e17 and finite.
bool is_focused_lobe(const FocusedLobe& lobe);

}  // namespace waylight
