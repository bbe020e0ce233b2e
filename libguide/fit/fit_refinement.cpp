#include "libguide/fit/fit_refinement.h"

#include <numeric>

#include "libguide/base/parallel.h"
#include "libguide/base/stopwatch.h"
#include "libguide/directional/entry_layout.h"
#include "libguide/fit/lobe_error.h"

namespace waylight {
namespace {

double sum(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

FitRefinement::FitRefinement(FitPlaces places, int first, int most, float tolerance,
                             const LobeFitOptions& options)
    : places_(std::move(places)),
      most_(most),
      tolerance_(tolerance),
      seed_(options.seed),
      fitter_(std::make_shared<LobeFitter>(options)) {
  start(tolerance > 0 && 2 * first <= most ? first : most);
}

void FitRefinement::start(int count) {
  coarser_ = std::move(entries_);
  entries_.assign(count, {});
  task_seconds_.assign(count, 0);
  phase_ = Phase::fit;
}

size_t FitRefinement::tasks() const { return phase_ == Phase::done ? 0 : task_seconds_.size(); }

void FitRefinement::run(size_t task) {
  const double begin = thread_seconds();
  phase_ == Phase::fit ? fit_entry(task) : test_place(task);
  task_seconds_[task] = thread_seconds() - begin;
}

void FitRefinement::fit_entry(size_t i) {
  const LobeTarget target = places_.target(static_cast<int>(i), static_cast<int>(entries_.size()));
  EntryFit& fit = entries_[i];
  const bool first = coarser_.empty();
  fit.details =
      fitter_->fit(target, first ? std::span<const GaussianComponent>()
                                 : coarser_[i * coarser_.size() / entries_.size()].details.asked);
  fit.components = std::move(fit.details.components);
  fit.held_out_error = fit.details.error;
}

void FitRefinement::test_place(size_t i) {
  const int place = static_cast<int>(i);
  const LobeTarget target = places_.target(place, static_cast<int>(coarser_.size()));
  const std::vector<ServingEntry> serving =
      places_.serving(place, static_cast<int>(entries_.size()));
  float error = 0;
  for (const ServingEntry& s : serving) {
    const GaussianMixture mixture(entries_[s.entry].components);
    error += held_out_error(target, mixture.carried(s.rotation), seed_) / serving.size();
  }
  excess_[i] = error - coarser_[i].held_out_error;
}

void FitRefinement::advance() {
  const double spent = sum(task_seconds_);
  seconds_ += spent;
  if (phase_ == Phase::test) return go_on();
  fit_seconds_ += spent;
  fits_ += entries_.size();
  if (entries_.size() == static_cast<size_t>(most_)) {
    phase_ = Phase::done;
  } else if (coarser_.empty()) {
    start(static_cast<int>(2 * entries_.size()));
  } else {
    phase_ = Phase::test;
    task_seconds_.assign(coarser_.size(), 0);
    excess_.assign(coarser_.size(), 0);
  }
}

void FitRefinement::go_on() {
  const double mean = std::accumulate(excess_.begin(), excess_.end(), 0.0) / excess_.size();
  if (mean <= tolerance_)
    phase_ = Phase::done;
  else
    start(2 * entries_.size() <= static_cast<size_t>(most_) ? static_cast<int>(2 * entries_.size())
                                                            : most_);
}

FitPlaces wo_places(std::shared_ptr<const Bsdf> bsdf, EntryLayout layout) {
  FitPlaces places;
  places.target = [bsdf, layout](int i, int n) {
    return LobeTarget(*bsdf, entry_wo(layout, i, n));
  };
  // The elevations of half as many entries lie just between two of the n.
  places.serving = [layout](int i, int n) {
    const Vec3 wo = entry_wo(layout, i, n / 2);
    const int nearest = nearest_entry(layout, wo, n);
    std::vector<int> entries = {nearest};
    if (layout == EntryLayout::elevations) entries = {2 * i, 2 * i + 1};
    std::vector<ServingEntry> serving;
    for (const int e : entries) serving.push_back({e, entry_rotation(layout, wo, e, n)});
    return serving;
  };
  return places;
}

namespace {

struct Task {
  FitRefinement* refinement;
  size_t index;
};

std::vector<Task> tasks_of(std::span<FitRefinement> refinements) {
  std::vector<Task> tasks;
  for (FitRefinement& r : refinements)
    for (size_t i = 0; i < r.tasks(); ++i) tasks.push_back({&r, i});
  return tasks;
}

// How many of the tasks were run before the user stopped.
size_t run_tasks(std::span<const Task> tasks, size_t before, const RunControl& control) {
  constexpr size_t kAtOnce = 256;  // between looks at the clock and at the user
  size_t done = 0;
  while (done < tasks.size() && !control.stopped()) {
    const size_t count = std::min(kAtOnce, tasks.size() - done);
    parallel_for(count, [&](size_t i) {
      if (!control.stopped()) tasks[done + i].refinement->run(tasks[done + i].index);
    });
    if (control.stopped()) break;
    done += count;
    control.progress(double(before + done), 0, "fits and tests");
  }
  return done;
}

}  // namespace

void refine_all(std::span<FitRefinement> refinements, const RunControl& control) {
  size_t before = 0;
  for (std::vector<Task> tasks; !(tasks = tasks_of(refinements)).empty();) {
    size_t left = run_tasks(tasks, before, control);
    before += left;
    for (FitRefinement& r : refinements) {
      const size_t count = r.tasks();
      if (count > left) return;
      left -= count;
      if (count > 0) r.advance();
    }
  }
}

}  // namespace waylight
