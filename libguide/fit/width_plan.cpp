#include "libguide/fit/width_plan.h"

#include <map>

#include "libguide/fit/fit_refinement.h"

namespace waylight {
namespace {

constexpr int kFirst = 1, kMost = 64;

// Of series i of n: the middle of the ith part of the range.
float series_width(const WidthRange& range, int i, int n) {
  return range.least * std::pow(range.largest / range.least, (i + 0.5f) / n);
}

using BsdfsByCount = std::map<int, std::vector<Bsdf>>;  // series i of n

BsdfsByCount resolve_series(std::span<const Material> materials, int material,
                            const WidthRange& range) {
  BsdfsByCount bsdfs;
  for (int n = kFirst; n <= kMost; n *= 2)
    for (int i = 0; i < n; ++i)
      bsdfs[n].push_back(resolve_at_width(materials, material, series_width(range, i, n)));
  return bsdfs;
}

// The widths of half as many series lie just between two of the n. The lobe needs no turning.
FitPlaces width_places(const BsdfsByCount& bsdfs, const Vec3& wo) {
  FitPlaces places;
  places.target = [&bsdfs, wo](int i, int n) { return LobeTarget(bsdfs.at(n)[i], wo); };
  places.serving = [](int i, int /*n*/) {
    return std::vector<ServingEntry>{{2 * i, Mat3::Identity()}, {2 * i + 1, Mat3::Identity()}};
  };
  return places;
}

}  // namespace

WidthPlan plan_widths(std::span<const Material> materials, int material, const WidthRange& range,
                      float tolerance, const LobeFitOptions& options, const RunControl& control) {
  const BsdfsByCount bsdfs = resolve_series(materials, material, range);
  std::vector<FitRefinement> refinements;
  for (const float degrees : {15.0f, 45.0f, 75.0f}) {
    const float theta = degrees * kPi / 180;
    refinements.emplace_back(width_places(bsdfs, {std::sin(theta), 0, std::cos(theta)}), kFirst,
                             kMost, tolerance, options);
  }
  refine_all(refinements, control);
  WidthPlan plan;
  size_t count = 0;
  for (const FitRefinement& r : refinements) {
    count = std::max(count, r.entries().size());
    plan.seconds += r.seconds();
  }
  for (size_t i = 0; i < count; ++i)
    plan.widths.push_back(series_width(range, static_cast<int>(i), static_cast<int>(count)));
  return plan;
}

}  // namespace waylight
