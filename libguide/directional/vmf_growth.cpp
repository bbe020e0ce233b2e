#include "libguide/directional/vmf.h"
#include "libguide/directional/vmf_em.h"
#include "libguide/math/frame.h"

namespace waylight {
namespace {

constexpr double kKeptDispersion = 0.75;
constexpr float kGoldenAngle = 2.39996323f;

float spread(const VmfComponent& c) {
  return c.weight * static_cast<float>(1 - mean_cosine(c.kappa));
}

// Makes `c` one half and returns the other. With A' the mean cosine of the halves and +-theta their
// angles to the old mean, A' cos theta = A.
VmfComponent split_off(VmfComponent& c, float azimuth) {
  const double old = mean_cosine(c.kappa);
  c.kappa = static_cast<float>(kappa_of_mean_cosine(1 - kKeptDispersion * (1 - old)));
  c.weight *= 0.5f;
  const float cosine = static_cast<float>(std::min(old / mean_cosine(c.kappa), 1.0));
  const float sine = safe_sqrt(1 - cosine * cosine);
  const float x = sine * std::cos(azimuth), y = sine * std::sin(azimuth);
  const Frame frame(c.mean);
  VmfComponent other = c;
  c.mean = frame.to_world({-x, -y, cosine});
  other.mean = frame.to_world({x, y, cosine});
  return other;
}

}  // namespace

VmfStatistics statistics_of(const VmfComponent& c) {
  return {c.weight, c.weight * static_cast<float>(mean_cosine(c.kappa)) * c.mean};
}

// Lobes are round, so the azimuth of a split is free: it turns from one to the next, or repeated
// splits would all lie in one plane.
int grow_vmf_mixture(std::span<VmfComponent> components, std::span<VmfStatistics> statistics,
                     int count, int wanted) {
  if (count == 0) return 0;
  for (; count < wanted; ++count) {
    VmfComponent& widest = *std::max_element(
        components.begin(), components.begin() + count,
        [](const VmfComponent& a, const VmfComponent& b) { return spread(a) < spread(b); });
    components[count] = split_off(widest, kGoldenAngle * count);
    statistics[count] = statistics_of(components[count]);
    statistics[&widest - components.data()] = statistics_of(widest);
  }
  return count;
}

}  // namespace waylight
