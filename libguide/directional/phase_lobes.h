#pragma once
// Phase functions as mixtures of von Mises-Fisher lobes about the direction of propagation.

#include <array>

#include "libguide/directional/vmf_mixture.h"

namespace waylight {

// One lobe about the axis (sign 1) or against it (sign -1).
struct PhaseLobe {
  float weight = 0, sign = 1, kappa = 0;
  float dispersion = 1;  // 1 - A(kappa)
};

// At most four lobes whose weights sum to 1.
struct PhaseLobes {
  static constexpr int kMaxLobes = 4;
  int count = 0;
  std::array<PhaseLobe, kMaxLobes> lobes{};

  float pdf(float cos_theta) const;  // per steradian
  float mean_cosine() const;
  VmfMixture about(const Vec3& axis) const;  // axis unit
};

// Of [Henyey, Greenstein 1941] with mean cosine g; |g| ends at 0.99. It is a continuous mixture of
// lobes all about one axis, so EM from lobes spread over their range finds few that stand for it,
// and keeps the mean cosine. As few as make int |HG - lobes| dw less than 0.03, or four: see the
// test for what is left. Takes up to 3 ms: once a phase function.
PhaseLobes phase_lobes(float g);

}  // namespace waylight
