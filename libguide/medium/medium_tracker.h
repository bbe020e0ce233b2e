#pragma once
// A medium prepared for flights: distances sampled by the standard methods, and transmittance.

#include <optional>

#include "libguide/base/random_stream.h"
#include "libguide/medium/extinction_blocks.h"
#include "libguide/medium/phase.h"

namespace waylight {

// Distances in optical depths end here: 0 times infinity is kept out.
inline constexpr float kFar = 1e30f;

// Of a homogeneous medium.
inline float exponential_transmittance(float sigma_t, float distance) {
  return std::exp(-sigma_t * std::min(distance, kFar));
}
inline Color exponential_transmittance(const Color& sigma_t, float distance) {
  return (-sigma_t * std::min(distance, kFar)).exp();
}

struct MediumCoefficients {
  Color sigma_t, albedo;
};

// How a flight ended: collided at distance t, or past the medium's end at t_max. weight: what the
// throughput takes, sigma_t T / pdf or T / P(pass), without the albedo; 1 in media of one colour,
// bounded in others.
struct Flight {
  float t = 0;
  bool scattered = false;
  Color weight = Color::Ones();
  MediumCoefficients here = {};  // where it collided
};

// Probabilities of the channels, in proportion to the throughput that they would carry on.
inline Color channel_probs(const Color& throughput) {
  const float sum = throughput.sum();
  if (!(sum > 0) || !std::isfinite(sum)) return Color::Constant(1.0f / 3);
  return throughput / sum;
}

// One of the channels, in proportion to probs; u: uniform, in [0, 1) times their sum. Never one of
// probability 0, whatever rounding makes of their sum.
inline int choose_channel(const Color& probs, float u) {
  int channel = 0;
  float below = 0;
  for (int c = 0; c < 3; ++c) {
    if (!(probs[c] > 0)) continue;
    channel = c;
    below += probs[c];
    if (u < below) break;
  }
  return channel;
}

class MediumTracker {
 public:
  explicit MediumTracker(const Medium& medium);

  const PhaseFunction& phase() const { return phase_; }
  MediumCoefficients at(const Vec3& p) const { return {extinction_at(p), albedo_at(p)}; }
  Color albedo_at(const Vec3& p) const {
    return albedo_grid_ ? albedo_grid_->color_at(p) : albedo_;
  }
  bool homogeneous() const { return !density_grid_; }
  bool emits() const { return emits_; }
  // Le, see MediumEmission.
  Color emitted_at(const Vec3& p) const {
    return emission_grid_ ? Color(radiance_ * emission_grid_->color_at(p)) : radiance_;
  }

  // In proportion to transmittance times extinction. Homogeneous media: the exponential of one
  // channel, chosen in proportion to the throughput, with the balance heuristic over the three.
  // Others: delta tracking against the majorants of blocks [Woodcock et al. 1965; Galtier et al.
  // 2013 for the weights of colours].
  Flight fly(const Ray& ray, float t_max, const Color& throughput, Sampler& sampler) const;

  // An unbiased estimate between 0 and 1; exact in homogeneous media. Others: residual ratio
  // tracking with the least extinction of each block as control [Novak et al. 2014].
  Color transmittance(const Ray& ray, float t_max, RandomStream& random) const;

  // Radiance that the medium adds along the ray, int_0^t_max T(0, t) sigma_a Le dt. Exact where all
  // coefficients are constant; else an unbiased estimate, by ratio tracking that collects at every
  // tentative collision: emission is mostly in thin media, in which real ones are rare. Draws
  // random numbers only in the latter case.
  Color emission(const Ray& ray, float t_max, Sampler& sampler) const;

  // The blocks along a ray, one in homogeneous media.
  BlockWalk walk(const Ray& ray, float t_max) const {
    return density_grid_ ? BlockWalk(blocks_, ray, t_max) : BlockWalk(bounds_, t_max);
  }

 private:
  Color extinction_at(const Vec3& p) const {
    return density_grid_ ? Color(scale_ * density_grid_->color_at(p)) : sigma_t_;
  }
  Flight fly_exponential(const Ray& ray, float t_max, const Color& channels,
                         Sampler& sampler) const;
  Flight track(const Ray& ray, float t_max, const Color& throughput, Sampler& sampler) const;
  Color residual(const Ray& ray, const RayBlock& block, RandomStream& random) const;
  Color tracked_emission(const Ray& ray, float t_max, RandomStream& random) const;
  void prepare(const HeterogeneousMedium& medium);
  void prepare(const MediumEmission& emission);

  PhaseFunction phase_;
  Color sigma_t_ = Color::Zero(), albedo_ = Color::Zero();  // where there is no grid
  ExtinctionBounds bounds_;                                 // of sigma_t_
  float scale_ = 1;
  bool emits_ = false;
  Color radiance_ = Color::Zero();  // Le, or the factor of its grid
  std::optional<GridLookup> density_grid_, albedo_grid_, emission_grid_;
  ExtinctionBlocks blocks_;
};

}  // namespace waylight
