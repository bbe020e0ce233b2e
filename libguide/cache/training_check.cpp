#include "libguide/cache/training_check.h"

#include <fmt/format.h>

#include "libguide/directional/gaussian_mixture.h"
#include "libguide/math/finite.h"

namespace waylight {
namespace {

constexpr float kRounding = 1e-3f;  // room for it

bool within(float v, float least, float most) { return v >= least && v <= most; }  // no NaN is

bool valid_share(float s0) { return within(s0, 0, 1 + kRounding); }

bool valid(const ComponentStatistics& s) {
  const float least = -kRounding * s.s0, most = kMaxGaussianMagnitude * s.s0;
  return valid_share(s.s0) && within(s.s1_x, -most, most) && within(s.s1_y, -most, most) &&
         within(s.s2_xx, least, most) && within(s.s2_yy, least, most) &&
         within(s.s2_xy, -most, most);
}

bool valid(const VmfStatistics& s) {
  return valid_share(s.s0) && s.s1.allFinite() && s.s1.norm() <= (1 + kRounding) * s.s0;
}

template <typename Statistics>
std::string check_statistics(const std::vector<Statistics>& statistics) {
  for (size_t i = 0; i < statistics.size(); ++i)
    if (!valid(statistics[i])) return fmt::format("statistics {} are those of no lobe", i);
  return {};
}

// Of either kind of training.
template <typename Training>
bool valid_positions(const Training& t) {
  return t.position_mean.allFinite() && t.position_m2.allFinite() && t.position_cross.allFinite() &&
         t.position_m2.minCoeff() >= 0;
}

bool valid_moments(const CellTraining& t) {
  return valid_positions(t) && t.normal_mean.allFinite() && t.normal_m2.allFinite() &&
         t.normal_m2.minCoeff() >= 0;
}

// What a cell of a surface and each kind of light in a medium have in common.
template <typename Light, typename Training>
std::string fault_of_mixture(const Light& light, const Training& t) {
  if (!finite_and_not_negative({t.flux, t.step, t.samples, t.weight_sum, t.weight_sum2}))
    return "a sum that is negative or not finite";
  if ((t.step > 0) != (light.component_count > 0)) return "steps without mixture or the reverse";
  if (t.step > 0 && !(t.samples > 0 && t.weight_sum > 0 && light.photon_count > 0))
    return "a mixture that stands for no photons";
  return {};
}

std::string fault_of(const CacheCell& cell, const CellTraining& t, double photons) {
  if (!valid_moments(t)) return "moments that are not finite or negative";
  if (!finite_and_not_negative({t.count, t.inherited_area}))
    return "a sum that is negative or not finite";
  if (!(t.born >= 0 && t.born <= photons)) return "made after the last photon";
  return fault_of_mixture(cell, t);
}

std::string fault_of(const MediumCell& cell, const MediumTraining& t, double photons) {
  if (!valid_positions(t)) return "moments that are not finite or negative";
  if (!finite_and_not_negative({t.count, t.inherited_volume}))
    return "a sum that is negative or not finite";
  if (!(t.born >= 0 && t.born <= photons)) return "made after the last photon";
  const std::string fault = fault_of_mixture(cell.indirect, t.indirect);
  return fault.empty() ? fault_of_mixture(cell.direct, t.direct) : fault;
}

// cache: of surfaces, or its part of media.
template <typename Cache>
std::string check_part(const Cache& cache) {
  if (cache.training.size() != cache.cells.size() ||
      cache.statistics.size() != cache.components.size())
    return "the training statistics do not belong to the cells";
  if (std::string fault = check_statistics(cache.statistics); !fault.empty()) return fault;
  for (size_t i = 0; i < cache.cells.size(); ++i) {
    const std::string fault =
        fault_of(cache.cells[i], cache.training[i], static_cast<double>(cache.photons));
    if (!fault.empty()) return fmt::format("cell {}: {}", i, fault);
  }
  return {};
}

std::string check_sources(const GuideCache& cache) {
  if (cache.sources.size() != (cache.paths > 0 ? cache.cells.size() : 0))
    return "what camera paths found does not belong to the cells";
  for (const CellSources& s : cache.sources)
    if (!finite_and_not_negative({s.light_all, s.light_guided, s.light_guided2, s.camera_all,
                                  s.camera_guided, s.camera_guided2, s.camera_samples,
                                  s.camera_looks}))
      return "a sum of what camera paths found is negative or not finite";
  return {};
}

}  // namespace

std::string check_training(const GuideCache& cache) {
  if (std::string fault = check_part(cache); !fault.empty()) return fault;
  if (std::string fault = check_sources(cache); !fault.empty()) return fault;
  const std::string fault = check_part(cache.medium);
  return fault.empty() ? fault : "media: " + fault;
}

}  // namespace waylight
