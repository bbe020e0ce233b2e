#include "libguide/brdf_fit.h"

#include <chrono>

#include "libguide/base/error.h"
#include "libguide/base/parallel.h"
#include "libguide/fit/fit_plan.h"
#include "libguide/fit/lobe_fit.h"

namespace waylight {
namespace {

using Clock = std::chrono::steady_clock;

constexpr size_t kTasksPerRound = 256;  // between looks at the clock and at the user

struct EntryFit {
  std::vector<GaussianComponent> components;
  float held_out_error = 0;
  double seconds = 0;
};

struct Task {
  size_t fit;  // of the plan
  int entry;
};

std::vector<Task> tasks_of(const FitPlan& plan) {
  std::vector<Task> tasks;
  for (size_t f = 0; f < plan.fits.size(); ++f)
    for (int i = 0; plan.fits[f].same_as < 0 && i < plan.fits[f].entries; ++i)
      tasks.push_back({f, i});
  return tasks;
}

EntryFit fit_entry(const PlannedFit& fit, int entry, const LobeFitOptions& options) {
  const Clock::time_point start = Clock::now();
  const LobeTargets targets =
      lobe_targets(fit.bsdf, entry_theta(entry, fit.entries), fit.traits.anisotropic);
  EntryFit result;
  result.components = fit_lobe(targets, options);
  result.held_out_error = held_out_error(targets, GaussianMixture(result.components), options.seed);
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

// In the order of the tasks; fewer where the user has stopped the run.
std::vector<EntryFit> fit_all(const FitPlan& plan, std::span<const Task> tasks,
                              const LobeFitOptions& options, const RunControl& control) {
  std::vector<EntryFit> results;
  while (results.size() < tasks.size() && !control.stopped()) {
    const size_t first = results.size();
    results.resize(std::min(tasks.size(), first + kTasksPerRound));
    parallel_for(results.size() - first, [&](size_t i) {
      const Task& task = tasks[first + i];
      if (!control.stopped())
        results[first + i] = fit_entry(plan.fits[task.fit], task.entry, options);
    });
    if (control.stopped()) results.resize(first);
    control.progress(double(results.size()), double(tasks.size()), "fits");
  }
  return results;
}

void warn_of_means(const Material& material, const LobeTraits& traits, const RunControl& control) {
  if (traits.textured)
    control.warn(
        fmt::format("material \"{}\" is textured: fitted at mean parameters", material.name));
  if (traits.anisotropic)
    control.warn(fmt::format("material \"{}\" is anisotropic: fitted to the mean over all azimuths",
                             material.name));
}

// Of the front, where the material is two-sided.
const char* fitted_kind(const SceneDescription& scene, int material) {
  const auto* two_sided = std::get_if<TwoSidedMaterial>(&scene.materials[material].model);
  return material_kind(scene.materials[two_sided ? two_sided->front : material]);
}

// Lays out in the cache what was fitted, material by material.
class Assembly {
 public:
  Assembly(const SceneDescription& scene, const FitPlan& plan) : scene_(scene) {
    result_.summary.skipped = plan.skipped;
  }

  // The next fit of the plan, with the entries made for it; none where an earlier one serves it.
  void add(const PlannedFit& fit, std::span<const EntryFit> entries) {
    const Material& material = scene_.materials[fit.material];
    MaterialFit record{static_cast<uint32_t>(fit.material), material.name,
                       fitted_kind(scene_, fit.material), fit.traits.textured};
    MaterialFitSummary summary;
    summary.name = record.name, summary.kind = record.kind, summary.textured = record.textured;
    if (fit.same_as >= 0)
      share(fit, record, summary);
    else
      store(entries, record, summary);
    places_.push_back(result_.cache.materials.size());
    result_.cache.materials.push_back(std::move(record));
    result_.summary.materials.push_back(std::move(summary));
  }

  // In place of add() where the user stopped the run before the material was complete.
  void leave_out(const PlannedFit& fit) {
    const Material& material = scene_.materials[fit.material];
    places_.push_back(0);
    result_.summary.skipped.push_back(
        fmt::format("{} ({}): interrupted", material.name, material_kind(material)));
  }

  BrdfFitResult finish() { return std::move(result_); }

 private:
  void store(std::span<const EntryFit> entries, MaterialFit& record, MaterialFitSummary& summary) {
    BrdfCache& cache = result_.cache;
    record.first_entry = static_cast<uint32_t>(cache.entries.size());
    record.entry_count = static_cast<uint32_t>(entries.size());
    summary.entries = static_cast<int>(entries.size());
    for (const EntryFit& fit : entries) {
      const size_t first = cache.components.size(), count = fit.components.size();
      cache.entries.push_back(
          {static_cast<uint32_t>(first), static_cast<uint32_t>(count), fit.held_out_error});
      cache.components.insert(cache.components.end(), fit.components.begin(), fit.components.end());
      summary.mean_components += double(count) / entries.size();
      summary.held_out_error += double(fit.held_out_error) / entries.size();
      summary.seconds += fit.seconds;
      summary.bytes += sizeof(BrdfCacheEntry) + count * sizeof(GaussianComponent);
    }
  }

  // It cost neither time nor space.
  void share(const PlannedFit& fit, MaterialFit& record, MaterialFitSummary& summary) const {
    const size_t place = places_[fit.same_as];
    record.first_entry = result_.cache.materials[place].first_entry;
    record.entry_count = result_.cache.materials[place].entry_count;
    const MaterialFitSummary& first = result_.summary.materials[place];
    summary.entries = first.entries;
    summary.mean_components = first.mean_components;
    summary.held_out_error = first.held_out_error;
    summary.shares_with = first.name;
  }

  const SceneDescription& scene_;
  std::vector<size_t> places_;  // of each fit of the plan among the cache's materials
  BrdfFitResult result_;
};

BrdfFitResult assemble(const SceneDescription& scene, const FitPlan& plan,
                       std::span<const EntryFit> fitted) {
  Assembly assembly(scene, plan);
  std::vector<bool> complete;
  size_t first = 0;
  for (const PlannedFit& fit : plan.fits) {
    const size_t count = fit.same_as < 0 ? fit.entries : 0;
    complete.push_back(fit.same_as < 0 ? first + count <= fitted.size() : complete[fit.same_as]);
    if (complete.back())
      assembly.add(fit, fitted.subspan(std::min(first, fitted.size()), count));
    else
      assembly.leave_out(fit);
    first += count;
  }
  return assembly.finish();
}

}  // namespace

void BrdfFitOptions::validate() const {
  require(elevations >= 1 && elevations <= 4096, "--elevations {}: must be within 1..4096",
          elevations);
  require(components >= 1 && components <= GaussianMixture::kMaxComponents,
          "--components {}: must be within 1..8", components);
  require(samples >= 16 && samples <= 65536, "--samples {}: must be within 16..65536", samples);
  require(prior.v >= 1 && std::isfinite(prior.v), "prior.v is {}: must be at least 1", prior.v);
  require(prior.a > 2 && std::isfinite(prior.a), "prior.a is {}: must be above 2", prior.a);
  require(prior.b > 0 && std::isfinite(prior.b), "prior.b is {}: must be positive", prior.b);
}

BrdfFitResult fit_brdfs(const SceneDescription& scene, const BrdfFitOptions& options,
                        const RunControl& control) {
  options.validate();
  const FitPlan plan = plan_fits(scene, options.elevations);
  for (const PlannedFit& fit : plan.fits)
    warn_of_means(scene.materials[fit.material], fit.traits, control);
  const LobeFitOptions lobe{options.components, options.samples, options.seed, options.prior};
  return assemble(scene, plan, fit_all(plan, tasks_of(plan), lobe, control));
}

}  // namespace waylight
