#pragma once
// Mixtures and references that the tests of densities over the sphere share.

#include <vector>

#include "libguide/base/sampler.h"
#include "libguide/directional/vmf_em.h"
#include "libguide/directional/vmf_mixture.h"

namespace waylight::test {

// Lobes anywhere, with concentrations between 1 and `narrow`, evenly by their logarithm.
inline std::vector<VmfComponent> random_lobes(int count, uint64_t seed, float narrow = 300) {
  std::vector<VmfComponent> result;
  for (int k = 0; k < count; ++k) {
    Sampler s(seed, 0, k);
    const Vec3 mean = square_to_sphere(s.next_2d());
    const float weight = 0.1f + s.next();
    result.push_back({weight, mean, std::pow(narrow, s.next())});
  }
  return result;
}

// The textbook form of the density, in double.
inline double density(const VmfComponent& c, const Vec3& w) {
  const Eigen::Vector3d mean = c.mean.cast<double>().normalized(), d = w.cast<double>();
  const double kappa = c.kappa;
  if (kappa == 0) return 0.25 / std::numbers::pi;
  const double norm = kappa / (2 * std::numbers::pi * -std::expm1(-2 * kappa));
  return norm * std::exp(kappa * (mean.dot(d.normalized()) - 1));
}

inline double density(const std::vector<VmfComponent>& components, const Vec3& w) {
  double sum = 0, total = 0;
  for (const VmfComponent& c : components) sum += c.weight * density(c, w), total += c.weight;
  return sum / total;
}

inline Vec3 random_direction(uint64_t seed, int i) {
  return square_to_sphere(Sampler(seed, 5, i).next_2d());
}

// Integral over the sphere by the midpoint rule in z and azimuth; for lobes wider than its cells.
template <typename Function>
double integrate_sphere(const Function& f, int cells = 400) {
  double sum = 0;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < 2 * cells; ++j)
      sum += f(square_to_sphere(Vec2((i + 0.5f) / cells, (j + 0.5f) / (2 * cells))));
  return sum * 4 * std::numbers::pi / (2.0 * cells * cells);
}

inline std::vector<WeightedDirection> draw(const VmfMixture& mixture, int count, uint64_t seed) {
  std::vector<WeightedDirection> points;
  for (int i = 0; i < count; ++i) {
    Sampler s(seed, 1, i);
    const float u = s.next();
    points.push_back({mixture.sample(u, s.next_2d()), 1});
  }
  return points;
}

}  // namespace waylight::test
