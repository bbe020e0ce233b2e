#include "libguide/brdf_fit.h"

#include "libguide/base/error.h"
#include "libguide/directional/entry_layout.h"
#include "libguide/fit/fitted_series.h"
#include "libguide/fit/lobe_family.h"

namespace waylight {
namespace {

SeriesLimits limits_of(const BrdfFitOptions& options) {
  return {options.tolerance,
          options.elevations,
          options.directions,
          {options.components, options.samples, options.seed, options.prior, options.method,
           options.fixed_components}};
}

void warn_of_means(const Material& material, const PlannedFit& fit, const RunControl& control) {
  if (!fit.traits.textured) return;
  control.warn(fmt::format("material \"{}\" is textured: fitted at mean parameters{}",
                           material.name, fit.width_range ? ", but for its width" : ""));
}

// Of the front, where the material is two-sided.
const char* fitted_kind(const SceneDescription& scene, int material) {
  const auto* two_sided = std::get_if<TwoSidedMaterial>(&scene.materials[material].model);
  return material_kind(scene.materials[two_sided ? two_sided->front : material]);
}

// Lays out in the cache what was fitted, material by material.
class Assembly {
 public:
  Assembly(const SceneDescription& scene, const FitPlan& plan, const SeriesLimits& limits)
      : scene_(scene), limits_(limits) {
    result_.summary.skipped = plan.skipped;
  }

  // The next fit of the plan, with its series; none where an earlier one serves it.
  void add(const PlannedFit& fit, std::span<const FittedSeries> series) {
    const Material& material = scene_.materials[fit.material];
    MaterialFit record;
    record.material = static_cast<uint32_t>(fit.material);
    record.name = material.name;
    record.kind = fitted_kind(scene_, fit.material);
    record.textured = fit.traits.textured;
    record.layout = fit.layout;
    MaterialFitSummary summary;
    summary.name = record.name, summary.kind = record.kind, summary.textured = record.textured;
    if (fit.same_as >= 0)
      share(fit, record, summary);
    else
      store(series, record, summary);
    count(fit, summary);
    places_.push_back(result_.cache.materials.size());
    result_.cache.materials.push_back(std::move(record));
    result_.summary.materials.push_back(std::move(summary));
  }

  BrdfFitResult finish() { return std::move(result_); }

 private:
  void store(std::span<const FittedSeries> series, MaterialFit& record,
             MaterialFitSummary& summary) {
    for (size_t i = 0; i < series.size(); ++i) {
      const WidthSeries stored = store(series[i], record.layout, summary);
      if (i == series.size() / 2)
        record.first_entry = stored.first_entry, record.entry_count = stored.entry_count;
      if (stored.width > 0) record.widths.push_back(stored);
      summary.seconds += series[i].seconds;
      if (series[i].seconds_per_fit > 0) seconds_per_fit_ = series[i].seconds_per_fit;
    }
    summary.widths = static_cast<int>(record.widths.size());
    summary.from_family = series[0].seconds_per_fit == 0;
    summary.mean_components /= summary.entries;
    summary.held_out_error /= summary.entries;
    summary.em_error /= summary.entries, summary.ceres_error /= summary.entries;
    summary.ceres_share /= summary.entries;
  }

  // Sums of the summary only.
  WidthSeries store(const FittedSeries& series, EntryLayout layout, MaterialFitSummary& summary) {
    BrdfCache& cache = result_.cache;
    const WidthSeries stored{series.width, static_cast<uint32_t>(cache.entries.size()),
                             static_cast<uint32_t>(series.entries.size())};
    const int entries = static_cast<int>(series.entries.size());
    for (int i = 0; i < entries; ++i) {
      const EntryFit& fit = series.entries[i];
      const size_t first = cache.components.size(), count = fit.components.size();
      cache.entries.push_back(
          {static_cast<uint32_t>(first), static_cast<uint32_t>(count), fit.held_out_error});
      cache.components.insert(cache.components.end(), fit.components.begin(), fit.components.end());
      summary.mean_components += double(count);
      summary.held_out_error += fit.held_out_error;
      summary.bytes += sizeof(BrdfCacheEntry) + count * sizeof(GaussianComponent);
      const bool fitted = series.seconds_per_fit > 0;
      const size_t most = std::min(limits_.lobe.components, GaussianMixture::kMaxComponents);
      result_.summary.bytes_at_most_components +=
          sizeof(BrdfCacheEntry) + (fitted ? most : count) * sizeof(GaussianComponent);
      if (fitted) add_details(fit, std::acos(entry_wo(layout, i, entries).z()), summary);
    }
    summary.entries += static_cast<int>(series.entries.size());
    return stored;
  }

  void add_details(const EntryFit& fit, float theta, MaterialFitSummary& summary) {
    const LobeFit& details = fit.details;
    summary.em_error += details.em_error, summary.ceres_error += details.ceres_error;
    summary.ceres_share += details.method == FitMethod::ceres;
    summary.em_seconds += details.em_seconds, summary.ceres_seconds += details.ceres_seconds;
    result_.summary.entries.push_back(
        {result_.summary.materials.size(), theta, fit.components.size(), details});
  }

  // It cost neither time nor space.
  void share(const PlannedFit& fit, MaterialFit& record, MaterialFitSummary& summary) const {
    const size_t place = places_[fit.same_as];
    const MaterialFit& served = result_.cache.materials[place];
    record.first_entry = served.first_entry, record.entry_count = served.entry_count;
    const MaterialFitSummary& first = result_.summary.materials[place];
    summary.entries = first.entries;
    summary.mean_components = first.mean_components;
    summary.held_out_error = first.held_out_error;
    summary.em_error = first.em_error, summary.ceres_error = first.ceres_error;
    summary.ceres_share = first.ceres_share;
    summary.from_family = first.from_family;
    summary.shares_with = first.name;
  }

  // Sharing is counted at the price of the last fit that was made.
  void count(const PlannedFit& fit, const MaterialFitSummary& m) {
    FitCost &cost = result_.summary.cost, &full = result_.summary.full;
    if (m.shares_with.empty()) cost.entries += m.entries;
    cost.bytes += m.bytes, cost.seconds += m.seconds;
    const size_t most = size_t(std::max(m.widths, 1)) * most_entries(fit, limits_);
    full.entries += most;
    full.bytes += static_cast<size_t>(
        most * (sizeof(BrdfCacheEntry) + m.mean_components * sizeof(GaussianComponent)));
    full.seconds += most * seconds_per_fit_;
  }

  const SceneDescription& scene_;
  const SeriesLimits& limits_;
  std::vector<size_t> places_;  // of each fit of the plan among the cache's materials
  double seconds_per_fit_ = 0;
  BrdfFitResult result_;
};

BrdfFitResult assemble(const SceneDescription& scene, const FitPlan& plan,
                       const SeriesLimits& limits,
                       std::span<const std::vector<FittedSeries>> series) {
  Assembly assembly(scene, plan, limits);
  for (size_t f = 0; f < plan.fits.size(); ++f) assembly.add(plan.fits[f], series[f]);
  return assembly.finish();
}

}  // namespace

void BrdfFitOptions::validate() const {
  require(elevations >= 2 && elevations <= 4096, "--elevations {}: must be within 2..4096",
          elevations);
  require(directions >= 1 && directions <= 65536, "--directions {}: must be within 1..65536",
          directions);
  require(tolerance >= 0 && tolerance <= 2, "--tolerance {}: must be within 0..2", tolerance);
  require(components >= 1 && components <= kMaxEmComponents,
          "--components {}: must be within 1..16", components);
  require(samples >= 16 && samples <= 65536, "--samples {}: must be within 16..65536", samples);
  require(prior.v >= 1 && std::isfinite(prior.v), "prior.v is {}: must be at least 1", prior.v);
  require(prior.a > 2 && std::isfinite(prior.a), "prior.a is {}: must be above 2", prior.a);
  require(prior.b > 0 && std::isfinite(prior.b), "prior.b is {}: must be positive", prior.b);
}

BrdfFitResult fit_brdfs(const SceneDescription& scene, const BrdfFitOptions& options,
                        const RunControl& control, std::span<const BrdfCache> families) {
  options.validate();
  const FitPlan plan = plan_fits(scene, options.tolerance);
  for (const PlannedFit& fit : plan.fits)
    warn_of_means(scene.materials[fit.material], fit, control);
  const SeriesLimits limits = limits_of(options);
  const std::vector<std::vector<FittedSeries>> series =
      fit_series(scene, plan, families, limits, control);
  if (control.stopped()) return {};
  return assemble(scene, plan, limits, series);
}

BrdfFitResult fit_family(const std::string& name, const BrdfFitOptions& options,
                         const RunControl& control) {
  RunControl silent = control;  // that the family's width is textured is how it is made
  silent.on_warning = nullptr;
  return fit_brdfs(family_scene(name), options, silent);
}

}  // namespace waylight
