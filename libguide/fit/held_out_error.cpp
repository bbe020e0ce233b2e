#include "libguide/fit/lobe_fit.h"

namespace waylight {
namespace {

constexpr int kPoints = 1024;              // per entry, over all azimuths
constexpr uint64_t kHeldOutSeed = 0x4e1d;  // apart from every sequence of the fit

// Shares of what makes the points: every point is weighed by the density of all three together.
constexpr float kLobeShare = 0.4f, kMixtureShare = 0.4f;
constexpr float kUniformShare = 1 - kLobeShare - kMixtureShare;

std::optional<Vec3> draw(const LobeTarget& target, const GaussianMixture& mixture,
                         Sampler& sampler) {
  const float u = sampler.next();
  const Vec2 u2 = sampler.next_2d();
  if (u < kLobeShare) return target.sample(u / kLobeShare, u2);
  if (u >= kLobeShare + kMixtureShare) return square_to_hemisphere(u2);
  const std::optional<Vec2> y = mixture.sample((u - kLobeShare) / kMixtureShare, u2);
  if (!y || y->squaredNorm() >= 1) return std::nullopt;
  return disk_to_direction(*y);
}

struct Point {
  float f, g, density;  // per steradian
};

// Failed draws are left out: their value is zero.
std::vector<Point> draw_points(const LobeTarget& target, const GaussianMixture& mixture,
                               uint64_t seed, uint64_t stream, int count) {
  std::vector<Point> points;
  points.reserve(count);
  for (int i = 0; i < count; ++i) {
    Sampler sampler(seed, stream, i);
    const std::optional<Vec3> wi = draw(target, mixture, sampler);
    if (!wi) continue;
    const LobeTarget::Value at = target.evaluate(*wi);
    const float g = mixture.pdf(direction_to_disk(*wi)) / kSteradianPerDiskArea;
    points.push_back(
        {at.f, g, kLobeShare * at.pdf + kMixtureShare * g + kUniformShare * kHemispherePdf});
  }
  return points;
}

double target_error(std::span<const Point> points, int drawn) {
  double f_integral = 0, difference = 0;
  for (const Point& p : points) f_integral += p.f / p.density;
  if (!(f_integral > 0)) return 0;
  const double normalise = drawn / f_integral;
  for (const Point& p : points) difference += std::abs(p.f * normalise - p.g) / p.density;
  return std::min(difference / drawn, 2.0);
}

}  // namespace

float held_out_error(const LobeTargets& targets, const GaussianMixture& mixture, uint64_t seed) {
  const int each = std::max<int>(kPoints / targets.size(), 1);
  double sum = 0;
  for (size_t t = 0; t < targets.size(); ++t)
    sum += target_error(draw_points(targets[t], mixture, hash_combine(seed, kHeldOutSeed), t, each),
                        each);
  return static_cast<float>(sum / targets.size());
}

}  // namespace waylight
