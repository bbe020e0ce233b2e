#include "libguide/directional/vmf_convolution.h"

namespace waylight {

// 1 - A_i A_j = D_i + D_j - D_i D_j of the dispersions D: narrow lobes keep their digits.
VmfConvolution::VmfConvolution(const VmfMixture& light, const PhaseLobes& phase)
    : count_(phase.count), mean_x_(light.mean_x_), mean_y_(light.mean_y_), mean_z_(light.mean_z_) {
  for (int j = 0; j < count_; ++j) {
    const PhaseLobe& lobe = phase.lobes[j];
    const Lanes dispersion =
        light.dispersion_ + lobe.dispersion - light.dispersion_ * lobe.dispersion;
    const Lanes kappa = lanes_kappa_of_dispersion(dispersion);
    sign_[j] = lobe.sign;
    half_[j] = (-0.5f * kLog2E) * kappa;
    norm_[j] = lobe.weight * light.weight_ * lanes_vmf_norm(kappa);
  }
}

}  // namespace waylight
