#include "libguide/directional/mixture_divergence.h"

#include <algorithm>
#include <cmath>

#include "libguide/directional/gaussian_quadrature.h"

namespace waylight {

double divergence(const GaussianMixture& p, const GaussianMixture& q) {
  constexpr int kRings = 4, kSpokes = 8;
  constexpr double kMinRatio = 1e-20;
  if (p.count() == 0 || q.count() == 0) return 0;
  double sum = 0;
  for (int k = 0; k < p.count(); ++k) {
    const GaussianComponent c = p.component(k);
    visit_quantiles(c, kRings, kSpokes, [&](const Vec2& y) {
      const double density = p.pdf(y);
      if (density > 0) sum -= c.weight * std::log(std::max(q.pdf(y) / density, kMinRatio));
    });
  }
  return std::max(sum / (kRings * kSpokes), 0.0);
}

}  // namespace waylight
