#pragma once
// What may be lost where one cell takes the place of two, on surfaces and in media.
//
// With n_i effective photons, irradiance or fluence E_i and mixture p_i of either cell, and E, p of
// the merged one:
//   chi^2 / 2 of E_1 and E_2 about E      <=  ln(n_1 + n_2) / 2    [Schwarz 1978], and
//   n_1 KL(p_1 || p) + n_2 KL(p_2 || p)   <=  c parameters saved   (c in merge_rules.cpp).
// Each must pay for itself: what one mixture saves does not buy a wrong irradiance.

#include <span>
#include <vector>

#include "libguide/directional/greedy_reduction.h"
#include "libguide/directional/mixture_divergence.h"

namespace waylight {

// The irradiance or fluence of a cell, as its photons tell it.
struct DensityEstimate {
  double density = 0;   // weight per area or volume and photon of the training
  double exposure = 0;  // area or volume times photons of the training
  double samples = 0;   // effective photons behind it
};

// Whether both are as near to that of the merged cell as chance has it.
bool same_density(const DensityEstimate& a, const DensityEstimate& b, double merged);

// A mixture and the effective photons that it was learned from.
template <typename Component>
struct KnownLobes {
  std::span<const Component> components;
  float samples = 0;
};

// The components of both, each by its evidence, which is what its photons weigh where the light is
// the same; to be reduced.
template <typename Component>
std::vector<Component> pool(const KnownLobes<Component>& a, const KnownLobes<Component>& b) {
  std::vector<Component> both;
  for (const KnownLobes<Component>* lobes : {&a, &b})
    for (Component c : lobes->components) {
      c.weight *= lobes->samples;
      both.push_back(c);
    }
  return both;
}

// Whether what is lost, in nats, is worth `parameters` fewer.
bool worth_losing(double nats, double parameters);

// parameters: of a component, its weight among them. True where either cell knows nothing.
template <typename Mixture, typename Component>
bool same_lobes(const KnownLobes<Component>& a, const KnownLobes<Component>& b,
                std::span<const Component> merged, int parameters) {
  if (a.components.empty() || b.components.empty()) return true;
  const Mixture mixture(merged);
  const auto loss = [&](const KnownLobes<Component>& lobes) {
    return lobes.samples * divergence(Mixture(lobes.components), mixture);
  };
  const double fewer = static_cast<double>(a.components.size() + b.components.size()) -
                       static_cast<double>(merged.size());
  return worth_losing(loss(a) + loss(b), parameters * fewer - 1);  // weights sum to one
}

}  // namespace waylight
