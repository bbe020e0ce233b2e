#pragma once
// In-scattered light: a mixture of incident directions convolved with a phase function.

#include <array>

#include "libguide/directional/phase_lobes.h"

namespace waylight {

// int phase(w . w') light(w') dw' with each pair of lobes replaced by the lobe of its resultant:
//   A(kappa_ij) = A(kappa_i) A(kappa_j) [Mardia, Jupp 2000].
// It integrates to one and keeps the mean direction. The shape is exact for uniform lobes and in
// the limit of narrow ones; between, for |g| <= 0.9 and one lobe of light of any kappa, it is
// within 4.5 % below and 17.5 % above the convolution with HG(g)'s lobes, int |difference| dw <=
// 0.031 (at g = 0.7, kappa = 3; 0.003 at kappa = 100). From the convolution with HG(g) itself:
// 0.031, too.
class VmfConvolution {
 public:
  VmfConvolution(const VmfMixture& light, const PhaseLobes& phase);

  // w: where the path from the camera goes on without scattering, -wo; the light's mixture is of
  // the directions that light comes from. Unit; per steradian. 0 where either has no lobes.
  float pdf(const Vec3& w) const {
    Lanes sum{};
    for (int j = 0; j < count_; ++j) {
      const Vec3 v = sign_[j] * w;
      const Lanes x = mean_x_ - v.x(), y = mean_y_ - v.y(), z = mean_z_ - v.z();
      sum += norm_[j] * exp2_clamped(half_[j] * (x * x + y * y + z * z));
    }
    return lanes_sum(sum);
  }

 private:
  int count_;
  std::array<float, PhaseLobes::kMaxLobes> sign_;
  Lanes mean_x_, mean_y_, mean_z_;
  std::array<Lanes, PhaseLobes::kMaxLobes> half_, norm_;  // -log2(e) kappa / 2; weights c(kappa)
};

}  // namespace waylight
