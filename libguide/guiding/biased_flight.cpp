#include "libguide/guiding/biased_flight.h"

namespace waylight {

BlockWalk BiasedFlight::walk() const {
  return space_.medium.walk(space_.ray, std::min(space_.t_max, kFar));
}

// What flights go by.
Color BiasedFlight::sigma(const RayBlock& block) const {
  if (space_.medium.homogeneous()) return space_.medium.at(space_.ray.origin).sigma_t;
  return Color::Constant(block.mean);
}

float BiasedFlight::pdf(const Color& sigma, const Color& depth) const {
  const Color density = (-depth).exp() + bias_ * (-bias_ * depth).exp();
  return 0.5f * (space_.channels * sigma * density).sum();
}

float BiasedFlight::pass_prob(const Color& depth) const {
  return 0.5f * (space_.channels * ((-depth).exp() + (-bias_ * depth).exp())).sum();
}

Flight BiasedFlight::sample(Sampler& sampler) const {
  const float u = sampler.next();
  const Vec2 choice = sampler.next_2d();
  RandomStream random(sampler);
  const int channel = choose_channel(space_.channels, choice.y());
  float left = -std::log1p(-u) / (choice.x() < 0.5f ? 1 : bias_);  // of the channel's depth
  Color depth = Color::Zero();
  BlockWalk blocks = walk();
  for (RayBlock block; blocks.next(block);) {
    const Color s = sigma(block), thickness = s * block.length();
    if (left < thickness[channel]) {
      const float t = std::min(block.t0 + left / s[channel], block.t1);
      const MediumCoefficients here = space_.medium.at(space_.ray(t));
      const Color transmittance = space_.medium.transmittance(space_.ray, t, random);
      const float density = pdf(s, depth + s * (t - block.t0));
      return {t, true, transmittance * here.sigma_t / density, here};
    }
    left -= thickness[channel];
    depth += thickness;
  }
  const Color transmittance = space_.medium.transmittance(space_.ray, space_.t_max, random);
  return {space_.t_max, false, transmittance / pass_prob(depth), {}};
}

float BiasedFlight::pdf(float t) const {
  Color depth = Color::Zero();
  BlockWalk blocks = walk();
  for (RayBlock block; blocks.next(block); depth += sigma(block) * block.length())
    if (t >= block.t0 && t < block.t1)
      return pdf(sigma(block), depth + sigma(block) * (t - block.t0));
  return 0;
}

float BiasedFlight::pass_prob() const {
  Color depth = Color::Zero();
  BlockWalk blocks = walk();
  for (RayBlock block; blocks.next(block);) depth += sigma(block) * block.length();
  return pass_prob(depth);
}

}  // namespace waylight
