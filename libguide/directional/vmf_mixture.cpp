#include "libguide/directional/vmf_mixture.h"

#include <array>
#include <limits>

namespace waylight {
namespace {

constexpr float kMinWeight = 1e-30f, kMaxWeight = 1e30f;  // sums and inverses stay finite
constexpr float kUnitTolerance = 1e-3f;                   // of |mean|^2

IntLanes within(Lanes v, float low, float high) { return (v > low) & (v < high); }  // no NaN is

}  // namespace

VmfMixture::VmfMixture(std::span<const VmfComponent> components) {
  fill(components.first(std::min<size_t>(components.size(), kMaxComponents)));
  if (components.size() > kMaxComponents || lanes_count(valid()) != count_) {
    // The rare path: files are checked and fits are valid.
    std::array<VmfComponent, kMaxComponents> kept;
    size_t kept_count = 0;
    for (const VmfComponent& c : components) {
      fill({&c, 1});
      if (kept_count < kept.size() && lanes_count(valid()) == 1) kept[kept_count++] = c;
    }
    fill(std::span(kept.data(), kept_count));
  }
  prepare();
}

// Through registers: eight stores and a load that spans them would wait for each other.
void VmfMixture::fill(std::span<const VmfComponent> components) {
  static const VmfComponent kUnused = {};
  count_ = static_cast<int>(components.size());
  const VmfComponent* c[kLanes];
  for (int k = 0; k < kLanes; ++k) c[k] = k < count_ ? &components[k] : &kUnused;
  const auto gather = [&](auto member) {
    return Lanes{member(*c[0]), member(*c[1]), member(*c[2]), member(*c[3]),
                 member(*c[4]), member(*c[5]), member(*c[6]), member(*c[7])};
  };
  weight_ = gather([](const VmfComponent& v) { return v.weight; });
  mean_x_ = gather([](const VmfComponent& v) { return v.mean.x(); });
  mean_y_ = gather([](const VmfComponent& v) { return v.mean.y(); });
  mean_z_ = gather([](const VmfComponent& v) { return v.mean.z(); });
  kappa_ = gather([](const VmfComponent& v) { return v.kappa; });
}

IntLanes VmfMixture::valid() const {
  const Lanes length2 = mean_x_ * mean_x_ + mean_y_ * mean_y_ + mean_z_ * mean_z_;
  return within(weight_, kMinWeight, kMaxWeight) &
         within(length2, 1 - kUnitTolerance, 1 + kUnitTolerance) & (kappa_ >= 0) &
         (kappa_ <= std::numeric_limits<float>::max());
}

void VmfMixture::prepare() {
  if (count_ == 0) return;
  weight_ *= splat(1 / lanes_sum(weight_));
  const Lanes scale = 1 / lanes_sqrt(mean_x_ * mean_x_ + mean_y_ * mean_y_ + mean_z_ * mean_z_);
  mean_x_ *= scale, mean_y_ *= scale, mean_z_ *= scale;
  kappa_ = lanes_min(kappa_, splat(kMaxKappa));
  half_ = (-0.5f * kLog2E) * kappa_;
  norm_ = weight_ * lanes_vmf_norm(kappa_);
  dispersion_ = lanes_dispersion(kappa_);
  cumulative_ = lanes_prefix_sum(weight_);
}

Vec3 VmfMixture::sample(float u, const Vec2& u2) const {
  const int k = std::clamp(lanes_count(cumulative_ <= u), 0, std::max(count_ - 1, 0));
  return sample_vmf(mean(k), kappa_[k], u2);
}

}  // namespace waylight
