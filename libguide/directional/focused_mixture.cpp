#include "libguide/directional/focused_mixture.h"

namespace waylight {
namespace {

constexpr float kLeast = 1e-17f, kMost = 1e17f;  // squares of them are floats

bool is_between(float v) { return v >= kLeast && v <= kMost; }

}  // namespace

bool is_focused_lobe(const FocusedLobe& lobe) {
  return is_between(lobe.weight) && is_between(lobe.size) &&
         (lobe.focus.array().abs() <= kMost).all();
}

FocusedMixture::FocusedMixture(std::span<const FocusedLobe> lobes)
    : count_(static_cast<int>(lobes.size())) {
  for (int k = 0; k < count_; ++k) {
    weight_[k] = lobes[k].weight;
    focus_x_[k] = lobes[k].focus.x();
    focus_y_[k] = lobes[k].focus.y();
    focus_z_[k] = lobes[k].focus.z();
    inverse_size2_[k] = 1 / sqr(lobes[k].size);
  }
}

VmfMixture FocusedMixture::seen_from(const Vec3& x) const {
  constexpr float kTiny = 1e-30f;
  VmfMixture mixture;
  mixture.count_ = count_;
  mixture.weight_ = weight_;
  mixture.mean_x_ = focus_x_ - x.x();
  mixture.mean_y_ = focus_y_ - x.y();
  mixture.mean_z_ = focus_z_ - x.z();
  const Lanes distance2 = mixture.mean_x_ * mixture.mean_x_ + mixture.mean_y_ * mixture.mean_y_ +
                          mixture.mean_z_ * mixture.mean_z_;
  mixture.mean_z_ = distance2 > kTiny ? mixture.mean_z_ : splat(1);
  mixture.kappa_ = distance2 * inverse_size2_;
  mixture.prepare();
  return mixture;
}

}  // namespace waylight
