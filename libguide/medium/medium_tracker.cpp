#include "libguide/medium/medium_tracker.h"

#include "libguide/medium/faint_roulette.h"
#include "libguide/medium/tentative_collisions.h"

namespace waylight {
namespace {

using Grid = std::shared_ptr<const VolumeGrid>;

float exponential_distance(float u) { return -std::log1p(-u); }

// Whether a tentative collision is real, and the weights of either outcome. channels: of the
// throughput so far. For extinction of one colour they are albedo and 1.
struct Collision {
  float real_prob;
  Color real_share;  // of each channel

  Collision(const Color& sigma_t, float majorant, const Color& channels)
      : real_share((sigma_t / majorant).min(1.0f)) {
    real_prob = (channel_probs(channels) * real_share).sum();
  }
  Color real_weight() const { return real_share / real_prob; }
  Color null_weight() const { return (1 - real_share) / (1 - real_prob); }
};

}  // namespace

MediumTracker::MediumTracker(const Medium& medium) : phase_(medium.phase) {
  if (const auto* homogeneous = std::get_if<HomogeneousMedium>(&medium.coefficients)) {
    sigma_t_ = homogeneous->sigma_t;
    albedo_ = homogeneous->albedo;
  } else {
    prepare(std::get<HeterogeneousMedium>(medium.coefficients));
  }
  bounds_ = {sigma_t_.minCoeff(), sigma_t_.mean(), sigma_t_.maxCoeff()};
  prepare(medium.emission);
}

void MediumTracker::prepare(const HeterogeneousMedium& medium) {
  scale_ = medium.scale;
  if (const Grid* grid = std::get_if<Grid>(&medium.density)) {
    density_grid_.emplace(*grid);
    blocks_ = ExtinctionBlocks(**grid, scale_);
  } else {
    sigma_t_ = scale_ * std::get<Color>(medium.density);
  }
  if (const Grid* grid = std::get_if<Grid>(&medium.albedo))
    albedo_grid_.emplace(*grid);
  else
    albedo_ = std::get<Color>(medium.albedo);
}

void MediumTracker::prepare(const MediumEmission& emission) {
  emits_ = waylight::emits(emission);
  if (!emits_) return;
  radiance_ = emission.scale;
  if (const Grid* grid = std::get_if<Grid>(&emission.radiance))
    emission_grid_.emplace(*grid);
  else
    radiance_ *= std::get<Color>(emission.radiance);
}

Flight MediumTracker::fly(const Ray& ray, float t_max, const Color& throughput,
                          Sampler& sampler) const {
  return density_grid_ ? track(ray, t_max, throughput, sampler)
                       : fly_exponential(ray, t_max, channel_probs(throughput), sampler);
}

Flight MediumTracker::fly_exponential(const Ray& ray, float t_max, const Color& channels,
                                      Sampler& sampler) const {
  const float u = sampler.next();
  const float sigma = sigma_t_[choose_channel(channels, sampler.next())];
  const float t = sigma > 0 ? exponential_distance(u) / sigma : kInfinity;
  const bool scattered = t < t_max;
  const Color transmittance = exponential_transmittance(sigma_t_, scattered ? t : t_max);
  if (!scattered) return {t_max, false, transmittance / (channels * transmittance).sum(), {}};
  const float pdf = (channels * sigma_t_ * transmittance).sum();
  return {t, true, sigma_t_ * transmittance / pdf, at(ray(t))};
}

Flight MediumTracker::track(const Ray& ray, float t_max, const Color& throughput,
                            Sampler& sampler) const {
  const float u = sampler.next();
  RandomStream random(sampler);
  Flight flight{t_max};
  tentative_collisions(walk(ray, t_max), 1, u, random, [&](float t, float majorant) {
    const MediumCoefficients here = at(ray(t));
    const Collision collision(here.sigma_t, majorant, throughput * flight.weight);
    flight.scattered = random.next() < collision.real_prob;
    if (flight.scattered) flight.t = t, flight.here = here;
    flight.weight *= flight.scattered ? collision.real_weight() : collision.null_weight();
    return !flight.scattered;
  });
  return flight;
}

Color MediumTracker::transmittance(const Ray& ray, float t_max, RandomStream& random) const {
  if (!density_grid_) return exponential_transmittance(sigma_t_, t_max);
  constexpr float kFaint = 0.05f;  // below, roulette decides whether to look further
  Color result = Color::Ones();
  BlockWalk blocks = walk(ray, t_max);
  for (RayBlock block; blocks.next(block);) {
    result *= std::exp(-block.least * block.length()) * residual(ray, block, random);
    const float largest = result.maxCoeff();
    result *= faint_roulette(largest, kFaint, random);
    if (is_black(result)) return result;
  }
  return result;
}

// Of the extinction above the block's least.
Color MediumTracker::residual(const Ray& ray, const RayBlock& block, RandomStream& random) const {
  Color result = Color::Ones();
  const float range = block.most - block.least;
  if (!(range > 0)) return result;
  float t = block.t0;
  while ((t += exponential_distance(random.next()) / range) < block.t1)
    result *= (1 - (extinction_at(ray(t)) - block.least) / range).max(0.0f);
  return result;
}

}  // namespace waylight
