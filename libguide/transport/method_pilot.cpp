#include "libguide/transport/method_pilot.h"

#include <algorithm>
#include <cmath>

#include "libguide/base/parallel.h"
#include "libguide/base/stopwatch.h"

namespace waylight {
namespace {

constexpr int kTilesPerTurn = 32;
constexpr int kMaxRounds = 8;  // over the whole frame
// Cost over a vertex without guide and over a standard flight, in rays.
constexpr double kGuidedVertex = 0.4, kGuidedFlight = 2;

// Of the paths of one arm through one tile, two for each place.
struct TileSums {
  double sum = 0, squares = 0;  // squares: of the differences of pairs
  double cost = 0;
  int pairs = 0;

  double mean() const { return sum / (2.0 * pairs); }
  double variance() const { return squares / (2.0 * double(pairs)); }  // of a path
};

class MethodPilot {
 public:
  MethodPilot(const PathTracer& tracer, const std::vector<PilotArm>& arms, const PilotFrame& frame,
              bool timed)
      : frame_(frame), timed_(timed) {
    for (const PilotArm& arm : arms) tracers_.push_back(tracer.with(arm.options));
  }

  std::vector<TileSums> trace_tile(int tile, int round) const {
    std::vector<TileSums> sums(tracers_.size());
    // Each arm in turn is first, and finds what it reads not yet in the processor's caches.
    for (size_t k = 0; k < tracers_.size(); ++k) {
      const size_t i = (k + size_t(tile) + size_t(round)) % tracers_.size();
      const double start = thread_seconds();
      frame_.for_places(tile, [&](int place) { trace_pair(tracers_[i], place, round, sums[i]); });
      if (timed_) sums[i].cost = thread_seconds() - start;
    }
    return sums;
  }

 private:
  void trace_pair(const PathTracer& tracer, int place, int round, TileSums& sums) const {
    double radiance[2];
    for (int s = 0; s < 2; ++s) {
      Sampler sampler = frame_.sampler(place, round, s);
      const Ray ray = frame_.ray(place, round, sampler);
      const PathRecord path = tracer.trace(ray, sampler);
      const float value = luminance(path.radiance);
      radiance[s] = std::isfinite(value) ? value : 0;
      sums.cost += path.rays + kGuidedVertex * path.guided + kGuidedFlight * path.guided_flights;
    }
    ++sums.pairs;
    sums.sum += radiance[0] + radiance[1];
    sums.squares += (radiance[0] - radiance[1]) * (radiance[0] - radiance[1]);
  }

  const PilotFrame& frame_;
  bool timed_;
  std::vector<PathTracer> tracers_;
};

// By the pixels' value as the arms agree on it: one of them may hold a firefly.
double scale_of(const std::vector<TileSums>& arms) {
  std::vector<double> means;
  for (const TileSums& arm : arms) means.push_back(arm.mean());
  std::nth_element(means.begin(), means.begin() + means.size() / 2, means.end());
  return relative_scale(means[means.size() / 2]);
}

// What an arm missed of the light that the first one found. Paths that are found once in N carry N
// times their part of the mean each, so their second moment is at least N times its square, also
// while none has been found. The first arm's own noise is taken off.
class Missed {
 public:
  // difference: of the means, this arm's minus the first's.
  void add(double difference, double paths, double variance_of_first) {
    const double told = difference < 0 ? paths * sqr(difference) - variance_of_first : 0;
    sum_ += told;
    squares_ += told * told;
    ++count_;
  }
  // As far as it is more than chance: two standard errors less. One value alone has none.
  double variance() const {
    if (count_ < 2) return 0;
    const double mean = sum_ / count_, spread = squares_ / count_ - mean * mean;
    return mean - 2 * std::sqrt(std::max(spread, 0.0) / count_);
  }

 private:
  static double sqr(double v) { return v * v; }

  double sum_ = 0, squares_ = 0, count_ = 0;
};

// Relative variances and costs by tile, and what is missed by tile and by turn. The first arm is
// not held against others: it has everything guided, and a share of all it does is what they do, so
// what it finds rarely they find hardly more often.
class ArmFigures {
 public:
  explicit ArmFigures(size_t arms) : arms_(arms), turn_(arms) {}

  void add(const std::vector<TileSums>& tile) {
    const double scale = scale_of(tile), paths = 2.0 * tile[0].pairs;
    for (size_t i = 0; i < tile.size(); ++i) {
      const Unit unit{tile[i].mean() * scale, tile[i].variance() * scale * scale};
      arms_[i].variances.push_back(unit.variance);
      arms_[i].costs.push_back(tile[i].cost / paths);
      turn_[i].mean += paths * unit.mean;
      turn_[i].variance += paths * unit.variance;
      tile_.push_back(unit);
    }
    compare(tile_, paths, &Arm::missed_by_tile);
    tile_.clear();
    turn_paths_ += paths;
  }

  void end_turn() {
    for (Unit& unit : turn_) unit.mean /= turn_paths_, unit.variance /= turn_paths_;
    compare(turn_, turn_paths_, &Arm::missed_by_turn);
    turn_.assign(turn_.size(), {});
    turn_paths_ = 0;
  }

  void report(std::vector<PilotArm>& arms) {
    std::vector<double> taken;
    if (arms[0].held) taken = hold_variances(arms_[0]);
    for (size_t i = 1; i < arms.size(); ++i) {
      if (arms[i].held)
        hold_variances(arms_[i]);
      else
        take_off(arms_[i], taken);
    }
    for (size_t i = 0; i < arms.size(); ++i) {
      arms[i].figures.variance = variance(i);
      arms[i].figures.cost = mean(arms_[i].costs);
      arms[i].figures.uncertainty = uncertainty(i);
    }
  }

 private:
  static double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / double(values.size());
  }
  // Mean of the places, relative to their value, and variance of a path.
  struct Unit {
    double mean = 0, variance = 0;
  };
  struct Arm {
    std::vector<double> variances, costs;  // by tile
    Missed missed_by_tile, missed_by_turn;
  };

  // No tile counts for more than a 20th of the variance of its arm, or twice the mean where there
  // are few: a single bright path would decide, and by chance. Many still count for what they are.
  // Returns what is taken off, by tile.
  static std::vector<double> hold_variances(Arm& arm) {
    const double tiles = double(arm.variances.size());
    const double most = mean(arm.variances) * std::max(0.05 * tiles, 2.0);
    std::vector<double> taken;
    for (double& v : arm.variances) {
      taken.push_back(std::max(v - most, 0.0));
      v = std::min(v, most);
    }
    return taken;
  }
  // Of an arm that is not held: no more than of the first, and no more than makes it equal. What
  // both have, such as all light of the scene in a few tiles, is not held against one of them.
  void take_off(Arm& arm, const std::vector<double>& taken) const {
    for (size_t t = 0; t < taken.size(); ++t)
      arm.variances[t] -= std::clamp(arm.variances[t] - arms_[0].variances[t], 0.0, taken[t]);
  }
  void compare(const std::vector<Unit>& units, double paths, Missed Arm::*missed) {
    for (size_t i = 1; i < units.size(); ++i)
      (arms_[i].*missed).add(units[i].mean - units[0].mean, paths, units[0].variance);
  }
  double variance(size_t i) const {
    const double own = mean(arms_[i].variances);
    if (i == 0) return own;
    return std::max({own, arms_[i].missed_by_tile.variance(), arms_[i].missed_by_turn.variance()});
  }
  double uncertainty(size_t i) const {
    const Arm &arm = arms_[i], &first = arms_[0];
    const double v = mean(arm.variances), v0 = mean(first.variances);
    const double c = mean(arm.costs), c0 = mean(first.costs);
    if (!(v > 0) || !(v0 > 0)) return 1;
    double sum = 0;
    for (size_t t = 0; t < arm.costs.size(); ++t) {
      const double d =
          arm.variances[t] / v - first.variances[t] / v0 + arm.costs[t] / c - first.costs[t] / c0;
      sum += d * d;
    }
    return std::sqrt(sum) / double(arm.costs.size());
  }

  std::vector<Arm> arms_;
  std::vector<Unit> tile_, turn_;
  double turn_paths_ = 0;
};

// Of all arms together.
FrameTurns turns_of(const PilotFrame& frame, uint64_t max_paths, size_t arms) {
  const double paths_per_tile = 2.0 * frame.places() / frame.tiles();  // of one arm
  return {frame.tiles(), kTilesPerTurn, kMaxRounds * int(arms), double(max_paths) / paths_per_tile};
}

}  // namespace

bool may_measure(const PilotFrame& frame, uint64_t max_paths) {
  return turns_of(frame, max_paths, 2).count() >= 2;
}

bool measure(const PathTracer& tracer, std::vector<PilotArm>& arms, const PilotFrame& frame,
             const MethodPilotOptions& options, const std::function<bool()>& stop) {
  if (!may_measure(frame, options.max_paths)) return false;
  const FrameTurns turns = turns_of(frame, options.max_paths, arms.size());
  arms.resize(std::min(arms.size(), size_t(turns.count())));
  const int turns_of_each = turns.count() / int(arms.size());
  const MethodPilot pilot(tracer, arms, frame, options.timed);
  ArmFigures figures(arms.size());
  std::vector<std::vector<TileSums>> tiles(kTilesPerTurn);
  for (int turn = 0; turn < turns_of_each && (turn == 0 || !stop()); ++turn) {
    parallel_for(turns.tiles(turn), [&](size_t i) {
      tiles[i] = pilot.trace_tile(turns.tile(turn, int(i)), turns.round(turn));
    });
    for (int i = 0; i < turns.tiles(turn); ++i) figures.add(tiles[i]);
    figures.end_turn();
  }
  figures.report(arms);
  return true;
}

}  // namespace waylight
