#include "libguide/directional/mixture_divergence.h"

#include <algorithm>
#include <cmath>

#include "libguide/directional/gaussian_quadrature.h"

namespace waylight {
namespace {

constexpr int kRings = 4, kSpokes = 8;

void visit_points(const GaussianComponent& c, const auto& visit) {
  visit_quantiles(c, kRings, kSpokes, visit);
}

void visit_points(const VmfComponent& c, const auto& visit) {
  for (int i = 0; i < kRings * kSpokes; ++i)
    visit(sample_vmf(c.mean, c.kappa, ring_point(i, kRings, kSpokes)));
}

template <typename Mixture>
double divergence_of(const Mixture& p, const Mixture& q) {
  constexpr double kMinRatio = 1e-20;
  if (p.count() == 0 || q.count() == 0) return 0;
  double sum = 0;
  for (int k = 0; k < p.count(); ++k) {
    const auto c = p.component(k);
    visit_points(c, [&](const auto& y) {
      const double density = p.pdf(y);
      if (density > 0) sum -= c.weight * std::log(std::max(q.pdf(y) / density, kMinRatio));
    });
  }
  return std::max(sum / (kRings * kSpokes), 0.0);
}

}  // namespace

double divergence(const GaussianMixture& p, const GaussianMixture& q) {
  return divergence_of(p, q);
}

double divergence(const VmfMixture& p, const VmfMixture& q) { return divergence_of(p, q); }

}  // namespace waylight
