#include "libguide/fit/lobe_fit.h"

#include "libguide/base/stopwatch.h"
#include "libguide/directional/gaussian_reduction.h"
#include "libguide/fit/ceres_fit.h"
#include "libguide/fit/lobe_error.h"

namespace waylight {
namespace {

constexpr int kUniformOf = 4;   // one point of so many is uniform over the hemisphere
constexpr int kStartTries = 8;  // a rough lobe throws more than half of its samples below ground
constexpr int kSelectionPoints = 512, kReportPoints = 1024;

// Fewer components are taken while they cost no more than this over the error of those asked for:
// one sample in a hundred goes to another place.
constexpr float kCountTolerance = 0.02f;
constexpr int kCounts[] = {12, 8, 6, 4, 3, 2, 1};

// By the mean held-out error of EM over 648 lobes: 0.1515, and 0.1530 for 32 plain iterations,
// which take twice as long; 12 have 0.1535, 24 gain 0.001. More fit the points too well.
constexpr int kEmIterations = 16;
constexpr float kEmStep = 1.8f;

// Sequences of random numbers.
enum Stream : uint64_t {
  kLobeStream,
  kUniformStream,
  kStartStream,
  kSelectionStream,
  kReportStream
};

using Components = std::vector<GaussianComponent>;

EmOptions em_options(const LobeFitOptions& options) {
  EmOptions em;
  em.components = options.components;
  em.prior = options.prior;
  em.max_iterations = kEmIterations;
  em.step = kEmStep;
  return em;
}

std::vector<WeightedPoint> weighted(std::span<const LobePoint> points) {
  std::vector<WeightedPoint> result;
  result.reserve(points.size());
  for (const LobePoint& p : points) result.push_back({p.y, p.f / p.pdf});
  return result;
}

}  // namespace

struct LobeFitter::Work {
  const LobeTarget& target;
  std::vector<LobePoint> points;
  std::vector<LobeRow> rows;
  Components em, ceres;
  LobeFit fit;
};

LobeFitter::LobeFitter(const LobeFitOptions& options) : options_(options) {
  const int uniform = options.samples / kUniformOf;
  const auto units = [&](Stream stream, int count) {
    return unit_points(options.seed, stream, count);
  };
  lobe_units_ = units(kLobeStream, options.samples - uniform);
  disk_units_ = units(kUniformStream, uniform);
  start_units_ = units(kStartStream, kStartTries * options.components);
  selection_units_ = units(kSelectionStream, kSelectionPoints);
  report_units_ = units(kReportStream, kReportPoints);
}

std::vector<LobePoint> LobeFitter::draw_points(const LobeTarget& target) const {
  std::vector<LobePoint> points;
  points.reserve(options_.samples);
  for (const UnitPoint& unit : lobe_units_)
    if (const auto p = sample_lobe(target, unit)) points.push_back(*p);
  for (const UnitPoint& unit : disk_units_)
    points.push_back(evaluate_lobe(target, square_to_disk(unit.u2)));
  const float uniform_share = static_cast<float>(disk_units_.size()) / options_.samples;
  for (LobePoint& p : points) p.pdf = lerp(p.pdf, kHemispherePdf, uniform_share);
  return points;
}

// K directions of the lobe.
std::vector<Vec2> LobeFitter::start_centres(const LobeTarget& target) const {
  std::vector<Vec2> centres;
  const size_t count = options_.components;
  for (size_t i = 0; centres.size() < count && i < start_units_.size(); ++i)
    if (const auto p = sample_lobe(target, start_units_[i])) centres.push_back(p->y);
  return centres;
}

Components LobeFitter::fit_em(const LobeTarget& target, std::span<const LobePoint> points) const {
  const std::vector<WeightedPoint> weights = weighted(points);
  const Components start = components_around(weights, start_centres(target), options_.prior);
  return fit_mixture(weights, em_options(options_), start).components;
}

// With the components asked for.
void LobeFitter::fit_asked(Work& work, std::span<const GaussianComponent> neighbour) const {
  const double em_begin = thread_seconds();
  work.points = draw_points(work.target);
  work.em = fit_em(work.target, work.points);
  work.fit.em_seconds = thread_seconds() - em_begin;
  if (options_.method == FitMethod::em || work.em.empty()) return;
  const double ceres_begin = thread_seconds();
  work.rows = lobe_rows(work.points, options_.samples);
  const bool nearer = neighbour.size() == work.em.size() &&
                      relative_cost(work.rows, neighbour) < relative_cost(work.rows, work.em);
  const CeresResult refined = refine_mixture(
      work.rows, nearer ? neighbour : std::span<const GaussianComponent>(work.em), {});
  work.ceres = refined.components;
  work.fit.ceres_iterations = refined.iterations;
  work.fit.ceres_seconds = thread_seconds() - ceres_begin;
}

void LobeFitter::choose_method(Work& work) const {
  work.fit.method = options_.method;
  if (work.ceres.empty()) work.fit.method = FitMethod::em;
  if (work.fit.method == FitMethod::best) {
    const FitDensity both[] = {FitDensity(work.em), FitDensity(work.ceres)};
    const LobeJudge judge(work.target, both, selection_units_);
    work.fit.method =
        judge.error(both[1]) < judge.error(both[0]) ? FitMethod::ceres : FitMethod::em;
  }
  work.fit.components = work.fit.asked = work.fit.method == FitMethod::em ? work.em : work.ceres;
}

// Merges components and polishes the rest by the method that was chosen, step by step.
void LobeFitter::choose_count(Work& work) const {
  Components& best = work.fit.components;
  const std::vector<WeightedPoint> weights = weighted(work.points);
  const FitDensity asked(best);
  const LobeJudge judge(work.target, std::span(&asked, 1), selection_units_);
  const float limit = judge.error(asked) + kCountTolerance;
  for (const int count : kCounts) {
    if (count >= static_cast<int>(best.size())) continue;
    const bool must = best.size() > GaussianMixture::kMaxComponents;
    if (options_.fixed_components && !must) break;
    const Components merged = reduce_mixture(best, 0, count).components;
    const Components polished = work.fit.method == FitMethod::em
                                    ? fit_mixture(weights, em_options(options_), merged).components
                                    : refine_mixture(work.rows, merged, {}).components;
    if (!must && judge.error(FitDensity(polished)) > limit) break;
    best = polished;
  }
}

void LobeFitter::report(Work& work) const {
  const FitDensity mixtures[] = {FitDensity(work.em),
                                 FitDensity(work.ceres.empty() ? work.em : work.ceres),
                                 FitDensity(work.fit.components)};
  const LobeJudge judge(work.target, mixtures, report_units_);
  work.fit.em_error = judge.error(mixtures[0]);
  work.fit.ceres_error = judge.error(mixtures[1]);
  work.fit.error = judge.error(mixtures[2]);
}

LobeFit LobeFitter::fit(const LobeTarget& target,
                        std::span<const GaussianComponent> neighbour) const {
  const double begin = thread_seconds();
  Work work{target, {}, {}, {}, {}, {}};
  fit_asked(work, neighbour);
  if (work.em.empty()) return work.fit;
  choose_method(work);
  choose_count(work);
  report(work);
  work.fit.seconds = thread_seconds() - begin;
  return work.fit;
}

}  // namespace waylight
