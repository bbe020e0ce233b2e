#include "libguide/directional/gaussian_mixture.h"

#include <array>

#include "libguide/directional/frame_carry.h"
#include "libguide/directional/gaussian_quadrature.h"

namespace waylight {
namespace {

constexpr float kSqrtHalfLog2E = 0.849321800288f;
constexpr float kMaxWeight = 1e30f;

constexpr GaussianComponent kUnused = {0, 0, 0, 1, 0, 1};

template <float GaussianComponent::*member>
Lanes gather(const GaussianComponent* const (&c)[kLanes]) {
  return Lanes{c[0]->*member, c[1]->*member, c[2]->*member, c[3]->*member,
               c[4]->*member, c[5]->*member, c[6]->*member, c[7]->*member};
}

IntLanes within(Lanes v, float low, float high) { return (v > low) & (v < high); }  // no NaN is

}  // namespace

GaussianMixture::GaussianMixture(std::span<const GaussianComponent> components)
    : GaussianMixture(components, Vec2(1, 0)) {}

GaussianMixture::GaussianMixture(std::span<const GaussianComponent> components, const Vec2& axis) {
  fill(components);
  if (components.size() > kMaxComponents || lanes_count(valid()) != count_) fill_valid(components);
  if (axis.x() != 1) rotate(axis.x(), axis.y());
  prepare();
}

// From array of structures to structure of arrays through registers: eight stores and a load that
// spans them would wait for each other.
void GaussianMixture::fill(std::span<const GaussianComponent> components) {
  count_ = static_cast<int>(std::min<size_t>(components.size(), kMaxComponents));
  const GaussianComponent* c[kLanes];
  for (int k = 0; k < kLanes; ++k) c[k] = k < count_ ? &components[k] : &kUnused;
  weight_ = gather<&GaussianComponent::weight>(c);
  mean_x_ = gather<&GaussianComponent::mean_x>(c), mean_y_ = gather<&GaussianComponent::mean_y>(c);
  cov_xx_ = gather<&GaussianComponent::cov_xx>(c), cov_xy_ = gather<&GaussianComponent::cov_xy>(c);
  cov_yy_ = gather<&GaussianComponent::cov_yy>(c);
}

// The rare path: files are checked and fits are valid.
void GaussianMixture::fill_valid(std::span<const GaussianComponent> components) {
  std::array<GaussianComponent, kMaxComponents> kept;
  size_t count = 0;
  for (const GaussianComponent& c : components) {
    fill(std::span(&c, 1));
    if (count < kept.size() && lanes_count(valid()) == 1) kept[count++] = c;
  }
  fill(std::span(kept.data(), count));
}

IntLanes GaussianMixture::valid() const {
  return within(weight_, 0, kMaxWeight) &
         within(mean_x_, -kMaxGaussianMagnitude, kMaxGaussianMagnitude) &
         within(mean_y_, -kMaxGaussianMagnitude, kMaxGaussianMagnitude) &
         within(cov_xx_, 0, kMaxGaussianMagnitude) & within(cov_yy_, 0, kMaxGaussianMagnitude) &
         (difference_of_products(cov_xx_, cov_yy_, cov_xy_, cov_xy_) > 0);
}

void GaussianMixture::rotate(float c, float s) {
  const Lanes x = mean_x_, xx = cov_xx_, xy = cov_xy_, yy = cov_yy_;
  mean_x_ = c * x - s * mean_y_;
  mean_y_ = s * x + c * mean_y_;
  cov_xx_ = c * c * xx - 2 * c * s * xy + s * s * yy;
  cov_xy_ = c * s * (xx - yy) + (c * c - s * s) * xy;
  cov_yy_ = s * s * xx + 2 * c * s * xy + c * c * yy;
}

void GaussianMixture::prepare() {
  if (count_ == 0) return;
  weight_ *= splat(1 / lanes_sum(weight_));
  const Lanes trace = cov_xx_ + cov_yy_;
  const Lanes rough_det = difference_of_products(cov_xx_, cov_yy_, cov_xy_, cov_xy_);
  const Lanes floor = rough_det < kCovarianceFloor * trace ? splat(kCovarianceFloor) : Lanes{};
  // The floor again where rounding has made a rotated covariance indefinite: the variance across a
  // long lobe may come out negative.
  cov_xx_ = lanes_max(cov_xx_ + floor, splat(kCovarianceFloor));
  cov_yy_ = lanes_max(cov_yy_ + floor, splat(kCovarianceFloor));
  const Lanes det = lanes_max(difference_of_products(cov_xx_, cov_yy_, cov_xy_, cov_xy_),
                              kCovarianceFloor * kCovarianceFloor * (1 + Lanes{}));
  const Lanes inverse = 1 / (cov_xx_ * det), inverse_xx = inverse * det;
  const Lanes scale_a = lanes_sqrt(inverse_xx), scale_b = lanes_sqrt(inverse * cov_xx_ * cov_xx_);
  slope_ = cov_xy_ * inverse_xx;
  inverse_a_ = kSqrtHalfLog2E * scale_a;
  inverse_b_ = kSqrtHalfLog2E * scale_b;
  norm_ = weight_ * (0.5f * kInvPi) * scale_a * scale_b;
  cumulative_ = lanes_prefix_sum(weight_);
}

std::optional<Vec2> GaussianMixture::sample(float u, const Vec2& u2) const {
  if (count_ == 0) return std::nullopt;
  const int k = std::min(lanes_count(cumulative_ <= u), count_ - 1);
  const Vec2 z = kSqrtHalfLog2E * square_to_gaussian(u2);
  const float dx = z.x() / inverse_a_[k];
  const Vec2 y(mean_x_[k] + dx, mean_y_[k] + slope_[k] * dx + z.y() / inverse_b_[k]);
  if (!(y.squaredNorm() <= kDiskMaxRadius2)) return std::nullopt;
  return y;
}

GaussianMixture GaussianMixture::carried(const Mat3& rotation) const {
  GaussianMixture result = *this;
  carry(rotation, result.mean_x_, result.mean_y_, result.cov_xx_, result.cov_xy_, result.cov_yy_);
  result.prepare();
  return result;
}

Vec2 square_to_gaussian(const Vec2& u) {
  const float r = std::sqrt(-2 * std::log(1 - u.x())), phi = 2 * kPi * u.y();
  return {r * std::cos(phi), r * std::sin(phi)};
}

float mass_inside(const GaussianMixture& mixture, float radius2) {
  constexpr int kRings = 16, kSpokes = 16;
  double mass = 0;
  for (int k = 0; k < mixture.count(); ++k) {
    const GaussianComponent c = mixture.component(k);
    int inside = 0;
    visit_quantiles(c, kRings, kSpokes,
                    [&](const Vec2& y) { inside += y.squaredNorm() <= radius2; });
    mass += c.weight * inside / (kRings * kSpokes);
  }
  return static_cast<float>(mass);
}

}  // namespace waylight
