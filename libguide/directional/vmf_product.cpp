#include "libguide/directional/vmf_product.h"

namespace waylight {
namespace {

constexpr float kMinOverlap = 1e-20f;

// 1 / c(kappa) = 4 pi (1 - e^-x) / x with x = 2 kappa; relative error below 3e-6.
Lanes inverse_norm(Lanes kappa) {
  const Lanes x = 2 * kappa;
  Lanes series = 1.0f / 720 - x * (1.0f / 5040);
  series = 1.0f / 120 - x * series;
  series = 1.0f / 24 - x * series;
  series = 1.0f / 6 - x * series;
  series = 1 - x * (0.5f - x * series);
  return 4 * kPi * (x < 0.5f ? series : (1 - exp_clamped(-x)) / x);
}

}  // namespace

VmfProduct::VmfProduct(const VmfMixture& first, const VmfMixture& second)
    : rows_(first.count() <= second.count() ? first : second),
      lanes_(first.count() <= second.count() ? second : first) {
  Lanes scale{};  // the weights without their exponentials
  for (int i = 0; i < rows_.count_; ++i) {
    const Vec3 mean = rows_.mean(i);
    const float row_kappa = rows_.kappa_[i];
    const Lanes x = row_kappa * mean.x() + lanes_.kappa_ * lanes_.mean_x_;
    const Lanes y = row_kappa * mean.y() + lanes_.kappa_ * lanes_.mean_y_;
    const Lanes z = row_kappa * mean.z() + lanes_.kappa_ * lanes_.mean_z_;
    const Lanes kappa = lanes_sqrt(x * x + y * y + z * z);
    // kappa_i + kappa_j - kappa, which cancels, by its product with their sum.
    const Lanes sum = row_kappa + lanes_.kappa_ + kappa;
    const Lanes loss = row_kappa * lanes_.kappa_ * lanes_.distance2(mean) /
                       lanes_max(sum, splat(std::numeric_limits<float>::min()));
    const Lanes norm = rows_.norm_[i] * lanes_.norm_ * inverse_norm(kappa);
    scale += norm;
    weights_[i] = norm * exp_clamped(-loss);
    // Written a lane at a time, the vector could not be read back before all stores are done.
    row_sum_ = kLaneIndex == i ? lanes_sum_splat(weights_[i]) : row_sum_;
  }
  const float z = lanes_sum(row_sum_);
  if (!(z > kMinOverlap * lanes_sum(scale))) return;
  z_ = z;
  inverse_z_ = 1 / z;
}

Vec3 VmfProduct::sample(float u, const Vec2& u2) const {
  float target = u * z_;
  const int i = lanes_choose(row_sum_, target, rows_.count_);
  const int j = lanes_choose(weights_[i], target, lanes_.count_);
  const Vec3 sum = rows_.kappa_[i] * rows_.mean(i) + lanes_.kappa_[j] * lanes_.mean(j);
  const float kappa = sum.norm();
  return sample_vmf(kappa > 0 ? Vec3(sum / kappa) : Vec3::UnitZ(), kappa, u2);
}

}  // namespace waylight
