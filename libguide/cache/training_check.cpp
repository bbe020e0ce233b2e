#include "libguide/cache/training_check.h"

#include <fmt/format.h>

#include <cmath>

namespace waylight {
namespace {

bool valid(const ComponentStatistics& s) {
  return std::isfinite(s.s0) && s.s0 >= 0 && std::isfinite(s.s1_x) && std::isfinite(s.s1_y) &&
         std::isfinite(s.s2_xx) && std::isfinite(s.s2_xy) && std::isfinite(s.s2_yy);
}

bool valid_moments(const CellTraining& t) {
  return t.position_mean.allFinite() && t.position_m2.allFinite() && t.position_cross.allFinite() &&
         t.normal_mean.allFinite() && t.normal_m2.allFinite() && t.position_m2.minCoeff() >= 0 &&
         t.normal_m2.minCoeff() >= 0;
}

bool finite_and_not_negative(double v) { return std::isfinite(v) && v >= 0; }

std::string fault_of(const CacheCell& cell, const CellTraining& t, double photons) {
  if (!valid_moments(t)) return "moments that are not finite or negative";
  for (double v : {double{t.count}, t.flux, double{t.inherited_area}, t.weight_sum,
                   t.weight_sum2, double{t.step}, double{t.samples}})
    if (!finite_and_not_negative(v)) return "a sum that is negative or not finite";
  if (!(t.born >= 0 && t.born <= photons)) return "made after the last photon";
  if ((t.step > 0) != (cell.component_count > 0)) return "steps without mixture or the reverse";
  if (t.step > 0 && !(t.samples > 0 && t.weight_sum > 0 && cell.photon_count > 0))
    return "a mixture that stands for no photons";
  return {};
}

}  // namespace

std::string check_training(const GuideCache& cache) {
  for (size_t i = 0; i < cache.statistics.size(); ++i)
    if (!valid(cache.statistics[i])) return fmt::format("statistics {} are not finite", i);
  for (size_t i = 0; i < cache.cells.size(); ++i) {
    const std::string fault =
        fault_of(cache.cells[i], cache.training[i], static_cast<double>(cache.photons));
    if (!fault.empty()) return fmt::format("cell {}: {}", i, fault);
  }
  return {};
}

}  // namespace waylight
