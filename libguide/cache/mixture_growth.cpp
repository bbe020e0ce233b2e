#include "libguide/cache/mixture_growth.h"

#include <algorithm>
#include <cmath>

#include "libguide/math/types.h"

namespace waylight {
namespace {

// Half the trace plus the deviator's length; never negative for a covariance.
float largest_eigenvalue(const GaussianComponent& c) {
  const float half_difference = 0.5f * (c.cov_xx - c.cov_yy);
  return 0.5f * (c.cov_xx + c.cov_yy) + std::hypot(half_difference, c.cov_xy);
}

// sigma e: the principal axis as long as its standard deviation.
Vec2 principal_axis(const GaussianComponent& c) {
  const float angle = 0.5f * std::atan2(2 * c.cov_xy, c.cov_xx - c.cov_yy);
  return std::sqrt(largest_eigenvalue(c)) * Vec2(std::cos(angle), std::sin(angle));
}

float spread(const GaussianComponent& c) { return c.weight * largest_eigenvalue(c); }

// Makes `c` one half and returns the other.
GaussianComponent split_off(GaussianComponent& c) {
  const Vec2 offset = 0.5f * principal_axis(c);
  c.weight *= 0.5f;
  c.cov_xx -= offset.x() * offset.x();
  c.cov_xy -= offset.x() * offset.y();
  c.cov_yy -= offset.y() * offset.y();
  GaussianComponent other = c;
  c.mean_x -= offset.x();
  c.mean_y -= offset.y();
  other.mean_x += offset.x();
  other.mean_y += offset.y();
  return other;
}

}  // namespace

size_t grow_mixture(std::span<GaussianComponent> components,
                    std::span<ComponentStatistics> statistics, size_t count, size_t wanted) {
  if (count == 0) return 0;
  for (; count < wanted; ++count) {
    const auto widest =
        std::max_element(components.begin(), components.begin() + count,
                         [](const GaussianComponent& a, const GaussianComponent& b) {
                           return spread(a) < spread(b);
                         });
    components[count] = split_off(*widest);
    statistics[count] = statistics_of(components[count]);
    statistics[widest - components.begin()] = statistics_of(*widest);
  }
  return count;
}

}  // namespace waylight
