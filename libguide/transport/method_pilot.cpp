#include "libguide/transport/method_pilot.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "libguide/base/parallel.h"

namespace waylight {
namespace {

constexpr int kTilesPerTurn = 32;
constexpr int kMaxRounds = 8;            // over the whole frame
constexpr double kRelativeFloor = 0.01;  // of relMSE
constexpr double kGuidedVertex = 0.4;    // cost over a vertex without guide, in rays
// What the difference of two arms says of a variance counts from this many times the arm's own
// figure on: below it is the noise of both.
constexpr double kMissing = 1.5;

double thread_seconds() {
  timespec now;
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

// Of the paths of one arm through one tile, two for each place.
struct TileSums {
  double sum = 0, squares = 0;  // squares: half of those of the differences of pairs
  double cost = 0;
  int pairs = 0;

  double mean() const { return pairs > 0 ? sum / (2 * pairs) : 0; }
  double variance() const { return pairs > 0 ? squares / pairs : 0; }  // of a path
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
    for (size_t i = 0; i < tracers_.size(); ++i) {
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
      sums.cost += path.rays + kGuidedVertex * path.guided;
    }
    ++sums.pairs;
    sums.sum += radiance[0] + radiance[1];
    sums.squares += 0.5 * (radiance[0] - radiance[1]) * (radiance[0] - radiance[1]);
  }

  const PilotFrame& frame_;
  bool timed_;
  std::vector<PathTracer> tracers_;
};

// Square of the pixels' value, as the arms agree on it: one of them may hold a firefly.
double denominator(const std::vector<TileSums>& arms) {
  std::vector<double> means;
  for (const TileSums& arm : arms) means.push_back(arm.mean());
  std::nth_element(means.begin(), means.begin() + means.size() / 2, means.end());
  const double median = means[means.size() / 2];
  return median * median + kRelativeFloor;
}

// Relative variances by tile, and sums over tiles.
class ArmFigures {
 public:
  explicit ArmFigures(size_t arms) : variances_(arms), differences_(arms), costs_(arms) {}

  void add(const std::vector<TileSums>& tile) {
    const double scale = 1 / denominator(tile);
    for (size_t i = 0; i < tile.size(); ++i) {
      variances_[i].push_back(tile[i].variance() * scale);
      const double difference = tile[i].mean() - tile[0].mean();
      differences_[i] += 2 * tile[i].pairs * difference * difference * scale;
      costs_[i] += tile[i].cost;
    }
    pairs_ += tile[0].pairs;
  }

  void report(std::vector<PilotArm>& arms) const {
    for (size_t i = 0; i < arms.size(); ++i) {
      arms[i].figures.variance = variance(i);
      arms[i].figures.cost = costs_[i] / (2 * pairs_);
      arms[i].figures.uncertainty = uncertainty(i);
    }
  }

 private:
  double own(size_t i) const {
    double sum = 0;
    for (const double v : variances_[i]) sum += v;
    return sum / double(variances_[i].size());
  }
  double variance(size_t i) const {
    const size_t other = i == 0 ? std::min<size_t>(1, variances_.size() - 1) : 0;
    const double difference = differences_[std::max(i, other)] / double(variances_[0].size());
    const double told = difference - own(other);
    return told > kMissing * own(i) ? told : own(i);
  }
  double uncertainty(size_t i) const {
    const double n = double(variances_[0].size()), own_mean = own(i), first_mean = own(0);
    if (!(own_mean > 0) || !(first_mean > 0)) return 1;
    double sum = 0;
    for (size_t t = 0; t < variances_[i].size(); ++t) {
      const double d = variances_[i][t] / own_mean - variances_[0][t] / first_mean;
      sum += d * d;
    }
    return std::sqrt(sum) / n;
  }

  std::vector<std::vector<double>> variances_;
  std::vector<double> differences_, costs_;
  double pairs_ = 0;
};

}  // namespace

bool measure(const PathTracer& tracer, std::vector<PilotArm>& arms, const PilotFrame& frame,
             const MethodPilotOptions& options, const std::function<bool()>& stop) {
  const MethodPilot pilot(tracer, arms, frame, options.timed);
  ArmFigures figures(arms.size());
  const double paths_per_tile = 2.0 * arms.size() * frame.places() / frame.tiles();
  const FrameTurns turns(frame.tiles(), kTilesPerTurn, kMaxRounds,
                         double(options.max_paths) / paths_per_tile);
  if (turns.count() == 0) return false;
  std::vector<std::vector<TileSums>> tiles(kTilesPerTurn);
  for (int turn = 0; turn < turns.count() && (turn == 0 || !stop()); ++turn) {
    parallel_for(turns.tiles(turn), [&](size_t i) {
      tiles[i] = pilot.trace_tile(turns.tile(turn, int(i)), turns.round(turn));
    });
    for (int i = 0; i < turns.tiles(turn); ++i) figures.add(tiles[i]);
  }
  figures.report(arms);
  return true;
}

}  // namespace waylight
