// What media emit along rays.

#include "libguide/medium/faint_roulette.h"
#include "libguide/medium/medium_tracker.h"
#include "libguide/medium/tentative_collisions.h"

namespace waylight {
namespace {

constexpr float kMinCandidates = 4;  // tentative collisions expected along a ray that sees a medium
constexpr float kFaint = 0.05f;      // transmittance below which roulette ends the walk

}  // namespace

bool emits(const MediumEmission& emission) {
  if (!(emission.scale > 0).any()) return false;
  if (const Color* constant = std::get_if<Color>(&emission.radiance))
    return (*constant * emission.scale > 0).any();
  const auto& grid = std::get<std::shared_ptr<const VolumeGrid>>(emission.radiance);
  return grid->voxels.range().most > 0;
}

Color MediumTracker::emission(const Ray& ray, float t_max, Sampler& sampler) const {
  if (!emits_) return Color::Zero();
  if (density_grid_ || albedo_grid_ || emission_grid_) {
    RandomStream random(sampler);
    return tracked_emission(ray, t_max, random);
  }
  Color share;
  for (int c = 0; c < 3; ++c) share[c] = -std::expm1(-sigma_t_[c] * std::min(t_max, kFar));
  return (1 - albedo_) * radiance_ * share;
}

// Every tentative collision counts, weighed by the chance to reach it and to be real. A channel
// without any extinction emits nothing, and must not keep the walk of an endless ray going.
Color MediumTracker::tracked_emission(const Ray& ray, float t_max, RandomStream& random) const {
  Color sum = Color::Zero(), left = Color::Ones();
  if (!density_grid_) left = (sigma_t_ > 0).cast<float>();
  const float factor = rate_factor(walk(ray, t_max), kMinCandidates);
  tentative_collisions(walk(ray, t_max), factor, random.next(), random, [&](float t, float rate) {
    const Vec3 p = ray(t);
    const MediumCoefficients here = at(p);
    const Color real = (here.sigma_t / rate).min(1.0f);
    sum += left * real * (1 - here.albedo) * emitted_at(p);
    left *= 1 - real;
    left *= faint_roulette(left.maxCoeff(), kFaint, random);
    return !is_black(left);
  });
  return sum;
}

}  // namespace waylight
