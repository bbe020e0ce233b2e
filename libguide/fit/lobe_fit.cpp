#include "libguide/fit/lobe_fit.h"

namespace waylight {
namespace {

constexpr int kAzimuths = 16;  // of an anisotropic lobe
constexpr int kUniformOf = 4;  // one point of so many is uniform over the hemisphere
constexpr float kUniformShare = 1.0f / kUniformOf;

// Sequences of random numbers. All entries share them: neighbours in elevation are then fitted to
// points that move with the lobe, and equal lobes get equal fits.
enum Stream : uint64_t { kLobeStream, kUniformStream, kStartStream };

uint64_t stream_of(Stream kind, size_t target) { return target * 16 + kind; }

std::optional<Vec3> draw(const LobeTarget& target, uint64_t seed, uint64_t stream, int index) {
  Sampler sampler(seed, stream, index);
  const float u = sampler.next();
  return target.sample(u, sampler.next_2d());
}

WeightedPoint weighted(const LobeTarget& target, const Vec3& wi) {
  const LobeTarget::Value at = target.evaluate(wi);
  const float density = lerp(at.pdf, kHemispherePdf, kUniformShare);
  return {direction_to_disk(wi), at.f / density};
}

// K directions of the lobe, the first centres of EM.
std::vector<Vec2> start_centres(const LobeTargets& targets, const LobeFitOptions& options) {
  constexpr int kMaxTries = 8;  // a rough lobe throws more than half of its samples below ground
  std::vector<Vec2> centres;
  const size_t count = options.components;
  for (size_t i = 0; centres.size() < count && i < kMaxTries * count; ++i) {
    const LobeTarget& target = targets[i % targets.size()];
    const auto wi = draw(target, options.seed, stream_of(kStartStream, 0), static_cast<int>(i));
    if (wi) centres.push_back(direction_to_disk(*wi));
  }
  return centres;
}

}  // namespace

LobeTargets lobe_targets(const Bsdf& bsdf, float theta, bool anisotropic) {
  const int count = anisotropic ? kAzimuths : 1;
  LobeTargets targets;
  for (int i = 0; i < count; ++i) targets.emplace_back(bsdf, theta, 2 * kPi * i / count);
  return targets;
}

std::vector<WeightedPoint> lobe_points(const LobeTargets& targets, const LobeFitOptions& options) {
  std::vector<WeightedPoint> points;
  points.reserve(options.samples);
  const int each = std::max<int>(options.samples / targets.size(), kUniformOf);
  const int uniform = each / kUniformOf;
  for (size_t t = 0; t < targets.size(); ++t) {
    for (int i = 0; i < each - uniform; ++i)
      if (const auto wi = draw(targets[t], options.seed, stream_of(kLobeStream, t), i))
        points.push_back(weighted(targets[t], *wi));
    for (int i = 0; i < uniform; ++i) {
      Sampler sampler(options.seed, stream_of(kUniformStream, t), i);
      points.push_back(weighted(targets[t], square_to_hemisphere(sampler.next_2d())));
    }
  }
  return points;
}

std::vector<GaussianComponent> fit_lobe(const LobeTargets& targets, const LobeFitOptions& options) {
  const std::vector<WeightedPoint> points = lobe_points(targets, options);
  EmOptions em;
  em.components = options.components;
  em.prior = options.prior;
  const std::vector<GaussianComponent> start =
      components_around(points, start_centres(targets, options), options.prior);
  return fit_mixture(points, em, start).components;
}

}  // namespace waylight
