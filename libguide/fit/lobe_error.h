#pragma once
// How far mixtures are from the lobe that they are fitted to, at points that no fit has seen.

#include "libguide/directional/gaussian_mixture.h"
#include "libguide/fit/lobe_points.h"

namespace waylight {

// The density over the disk of up to kMaxEmComponents components.
class FitDensity {
 public:
  explicit FitDensity(std::span<const GaussianComponent> components);
  explicit FitDensity(const GaussianMixture& mixture) : parts_{mixture, {}} {}
  float pdf(const Vec2& y) const;  // per unit area
  std::optional<Vec2> sample(float u, const Vec2& u2) const;

 private:
  GaussianMixture parts_[2];
  float first_share_ = 1;
};

// Points for judging several mixtures together, drawn from the lobe's own sampler, from all of the
// mixtures and from the hemisphere: where any of them is large there are points, so that none can
// hide what it gets wrong. Each is weighed by the density of all that could draw it.
class LobeJudge {
 public:
  // units: one a point, independent of those of the fit.
  LobeJudge(const LobeTarget& target, std::span<const FitDensity> mixtures,
            std::span<const UnitPoint> units);

  // The integral of |f - G| over the upper hemisphere, f normalised there and G the mixture's own
  // sub-density: in [0, 2]. Half of it is the share of samples that go to the wrong place.
  float error(const FitDensity& mixture) const;

 private:
  std::vector<LobePoint> points_;
  double f_integral_ = 0;  // per steradian, times the points drawn
  size_t drawn_ = 0;
};

// The error of one mixture, at points of its own.
float held_out_error(const LobeTarget& target, const GaussianMixture& mixture, uint64_t seed);

}  // namespace waylight
