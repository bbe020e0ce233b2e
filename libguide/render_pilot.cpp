#include "libguide/render_pilot.h"

#include <cmath>
#include <limits>
#include <optional>

#include "libguide/render_alternatives.h"
#include "libguide/render_plan.h"
#include "libguide/transport/choice_pilot.h"
#include "libguide/transport/glance.h"

namespace waylight {
namespace {

constexpr double kPilotShare = 1 / 32.0;  // of the render's paths or time
constexpr double kLearningShare = 0.4;    // of that, for the choices of the cells
constexpr uint64_t kMaxPaths = 1 << 20;
// Standard errors that a gain has to be worth; and what it has to be beyond, of what guides less
// too: what that loses is rare bright paths, which a pilot may not have seen.
constexpr double kCertainty = 3, kLeastGain = 0.01, kLeastGainOfLess = 0.1;
// And of BSDFs on surfaces beside media: in the lantern they are a fifth cheaper, have the same
// noise in a pilot, and three to four times the error in the render.
constexpr double kLeastGainOfBsdfs = 0.3;
// Standard error of the comparison with guiding nothing from which on it decides nothing: it knows
// too little of the rare bright paths that can be most of the variance. Twelve of sixteen such
// pilots of dense fog found path tracing 3 to 90 times better, which had twice the cost.
constexpr double kVague = 0.35;

// Where fewer scatterings than this have a guide, nothing is guided unless that is surely worse:
// what so few can gain has to pay the lookups of all others. Behind a closed door it is 2 %, beside
// a thin wall 13 %; where guiding pays, it is at least 40 %.
constexpr double kRarelyGuided = 0.25;
// Nor where there are fewer cells: they are so large that none knows the light of its places. In a
// room and in a lit bulb 1 to 18 cells cost 1.2 to 2.2 times path tracing, 95 cells 0.6; in sparse
// jewelry 43 cells 0.24.
constexpr size_t kFewCells = 30;
// Where more scatterings than this are in grids, roulette is by throughput at first: guided it goes
// by one value of light for the thick and the thin parts of a cell, and on two clouds takes half as
// long again to the same error.
constexpr double kMostlyInGrids = 0.5;
constexpr int kGlancePaths = 128;
// Where a path of plain path tracing has less variance than this, relative to its pixel, nothing is
// guided but what is that many times better. Such noise is mostly that of lamps and edges, which
// stratified samples take away and guiding does not, and independent paths of a pilot do not see
// that: in the Cornell box (0.13) they find guiding 1.3 to 2.4 times better, and at 64 samples it
// is 1.1 times worse, at 256 1.3. A room where it gains 3 times has 0.6. Renders that are too small
// to compare anything guide nothing where a few paths surely have less, unless it is much less by
// guided ones: 0.56 to 0.84 in the Cornell box, 0.1 to 0.52 beside an empty cloud.
constexpr double kEasy = 0.3, kWorthIt = 4, kEasyAtAGlance = 0.25, kHardlyLess = 0.55;

class MethodChoice {
 public:
  MethodChoice(const RenderOptions& options, const SensorDescription& sensor,
               const PathTracer& tracer, const std::function<bool()>& stop)
      : options_(options),
        frame_(sensor, options.seed),
        tracer_(tracer),
        stop_(stop),
        clock_(clock_of(options)) {
    const double paths = double(options.spp) * sensor.film.width * sensor.film.height;
    if (options.spp > 0)
      max_paths_ = static_cast<uint64_t>(std::min(double(kMaxPaths), kPilotShare * paths));
  }

  // At no path where a few would be more than a pilot may take.
  Glance at_a_glance(const PathTracerOptions& tracing) const {
    return glance(tracer_.with(tracing), frame_, max_paths_ < kGlancePaths ? 0 : kGlancePaths);
  }

  // Whether there will be no comparison, and as far as a few paths tell little noise without one,
  // and hardly less by guiding. Those that are guided find what others would find rarely.
  bool surely_easy(const PathTracerOptions& everything, const PathTracerOptions& nothing) const {
    if (may_measure(frame_, paths_to_compare())) return false;
    const uint64_t paths = paths_to_compare() / 2;
    const Noise plain = relative_noise(tracer_.with(nothing), frame_, paths);
    const Noise guided = relative_noise(tracer_.with(everything), frame_, paths);
    return plain.surely_below(kEasyAtAGlance) && guided.surely_below(kEasyAtAGlance) &&
           guided.mean > kHardlyLess * plain.mean;
  }

  std::vector<CellChoice> learn(PathTracerOptions tracing, const GuidingCaches& caches) const {
    ChoicePilotOptions pilot;
    pilot.guides = {DirectionGuide::illumination};
    if (caches.has_fits()) pilot.guides.push_back(DirectionGuide::product);
    tracing.directions.guide = pilot.guides.back();
    tracing.directions.compares = caches.has_fits();
    tracing.max_split = 1;
    pilot.default_share = tracing.directions.bsdf_share;
    pilot.priced = true;
    pilot.max_paths = static_cast<uint64_t>(kLearningShare * double(max_paths_));
    return learn_choices(tracer_.with(tracing), frame_, caches.guide().cells.size(), pilot,
                         [&] { return stop_() || late(kLearningShare); });
  }

  bool compare(std::vector<PilotArm>& arms) const {
    MethodPilotOptions pilot;
    pilot.max_paths = paths_to_compare();
    pilot.timed = options_.time > 0;
    return measure(tracer_, arms, frame_, pilot, [&] { return stop_() || late(1); });
  }

  double seconds() const { return clock_.seconds(); }

 private:
  uint64_t paths_to_compare() const {
    return static_cast<uint64_t>((1 - kLearningShare) * double(max_paths_));
  }
  bool late(double share) const {
    return options_.time > 0 && seconds() > share * kPilotShare * options_.time;
  }

  const RenderOptions& options_;
  PilotFrame frame_;
  const PathTracer& tracer_;
  const std::function<bool()>& stop_;
  uint64_t max_paths_ = kMaxPaths;  // a million
  Stopwatch clock_;
};

void count_cells(const std::vector<CellChoice>& choices, AutoDecision* decision) {
  for (const CellChoice& choice : choices) {
    if (choice.guide == DirectionGuide::none) ++decision->cells_bsdf;
    if (choice.guide == DirectionGuide::illumination) ++decision->cells_illumination;
    if (choice.guide == DirectionGuide::product) ++decision->cells_product;
  }
}

// What was measured: everything guided, nothing, and the first of the changes in their order.
class Verdict {
 public:
  Verdict(const std::vector<PilotArm>& arms, const std::vector<Alternative>& open, bool doubtful)
      : arms_(arms), open_(open), doubtful_(doubtful) {}

  PathTracerOptions decide(AutoDecision* decision) const {
    PathTracerOptions chosen = arms_[0].options;
    decision->method = arms_[0].figures.name;
    double best = 0;
    for (const Decision of :
         {Decision::surfaces, Decision::directions, Decision::distances, Decision::roulette}) {
      const std::optional<size_t> change = best_change(of);
      if (!change) continue;
      open_[*change].apply(chosen);
      decision->method += std::string(", ") + open_[*change].name;
      best = std::max(best, gain(*change + 2));
    }
    if (!(gain(1) > least_gain_of_plain(best))) return chosen;
    decision->method = arms_[1].figures.name;
    return arms_[1].options;
  }

 private:
  // The logarithm of a ratio of variance times cost; none where one of the two found no light.
  double gain(size_t arm) const {
    const double first = arms_[0].figures.inefficiency(), other = arms_[arm].figures.inefficiency();
    return first > 0 && other > 0 ? std::log(first / other) : 0;
  }
  static double least_gain(const PilotArm& arm, double of_less = kLeastGainOfLess) {
    const double by_chance = kCertainty * arm.figures.uncertainty;
    return arm.held ? std::max(by_chance, kLeastGain) : by_chance + of_less;
  }
  double least_gain_of_plain(double best) const {
    const double uncertainty = arms_[1].figures.uncertainty;
    if (doubtful_) return best - kCertainty * uncertainty;
    if (uncertainty > kVague) return std::numeric_limits<double>::infinity();
    if (arms_[1].figures.variance < kEasy) return best - std::log(kWorthIt);
    return std::max(best, least_gain(arms_[1]));
  }
  std::optional<size_t> best_change(Decision of) const {
    const double of_less = of == Decision::surfaces ? kLeastGainOfBsdfs : kLeastGainOfLess;
    std::optional<size_t> best;
    for (size_t i = 0; i + 2 < arms_.size(); ++i) {
      if (open_[i].of != of || !(gain(i + 2) > least_gain(arms_[i + 2], of_less))) continue;
      if (!best || gain(i + 2) > gain(*best + 2)) best = i;
    }
    return best;
  }

  const std::vector<PilotArm>& arms_;
  const std::vector<Alternative>& open_;
  bool doubtful_;  // few scatterings have a guide, or few cells one
};

// Why guiding can hardly pay, in words; empty where it can.
const char* doubt(const GuidingCaches& guiding, const Glance& seen) {
  if (!guiding.media().empty()) return "";
  if (guiding.guide().cells.size() < kFewCells) return "few cells";
  return seen.guided_share() < kRarelyGuided ? "few scatterings have a guide" : "";
}

// What is guided before a cell has learned.
PathTracerOptions begin(PathTracerOptions everything, const GuidingCaches& guiding,
                        const RenderOptions& options, const Glance& seen) {
  if (options.roulette == RouletteMode::automatic && !guiding.media().empty() &&
      seen.share_in_grids() > kMostlyInGrids)
    everything.roulette = Roulette::throughput;
  if (guiding.has_fits()) return everything;
  everything.directions.guide = DirectionGuide::illumination;
  everything.directions.bsdf_share = default_share(RenderMode::illumination);
  return everything;
}

void load_fits(GuidingCaches& guiding, const std::string& doubt, AutoDecision* decision) {
  if (!guiding.may_load_fits()) return;
  const std::string reason = guiding.guided() ? doubt : "no surface has cells";
  decision->fits = reason.empty() ? "loaded" : "not loaded: " + reason;
  if (reason.empty()) guiding.load_fits();
}

void drop_useless_fits(GuidingCaches& guiding, const PathTracerOptions& chosen,
                       AutoDecision* decision) {
  const DirectionOptions& directions = chosen.directions;
  if (!guiding.has_fits() || (directions.guide == DirectionGuide::product &&
                              !directions.light_alone && may_use_product(*decision)))
    return;
  guiding.drop_fits();
  decision->fits = "dropped: no direction is sampled by the product";
}

// Everything guided, nothing, and the changes that are open.
PathTracerOptions choose_measured(const MethodChoice& pilot, const PathTracerOptions& everything,
                                  const PathTracerOptions& nothing,
                                  const std::vector<Alternative>& open, bool doubtful,
                                  AutoDecision* decision) {
  std::vector<PilotArm> arms = {{{"guided"}, everything}, {{"bsdf"}, nothing, false}};
  for (const Alternative& change : open) arms.push_back(arm_of(change, everything));
  const PilotArm& otherwise = arms[doubtful ? 1 : 0];
  decision->method = otherwise.figures.name;
  const bool measured = pilot.compare(arms);
  decision->seconds = pilot.seconds();
  if (!measured) return otherwise.options;
  for (const PilotArm& arm : arms) decision->compared.push_back(arm.figures);
  return Verdict(arms, open, doubtful).decide(decision);
}

}  // namespace

PathTracerOptions choose_method(const Scene& scene, const SensorDescription& sensor,
                                const PathTracer& tracer, GuidingCaches& guiding,
                                const RenderOptions& options, const std::function<bool()>& stop,
                                AutoDecision* decision) {
  PathTracerOptions everything = tracer_options(scene, options);
  if (!guiding.guided() && guiding.media().empty()) {
    load_fits(guiding, "", decision);
    return plain(options, everything);
  }
  const MethodChoice pilot(options, sensor, tracer, stop);
  const Glance seen = pilot.at_a_glance(everything);
  const std::string doubts = pilot.surely_easy(everything, plain(options, everything))
                                 ? "little noise"
                                 : doubt(guiding, seen);
  load_fits(guiding, doubts, decision);
  everything = begin(everything, guiding, options, seen);
  std::vector<CellChoice> choices;
  if (guiding.guided()) choices = pilot.learn(everything, guiding);
  count_cells(choices, decision);
  guiding.learned(std::move(choices));
  everything.directions.learned = true;

  const PathTracerOptions chosen = choose_measured(
      pilot, everything, plain(options, everything),
      alternatives(scene, guiding, options, everything, *decision), !doubts.empty(), decision);
  drop_useless_fits(guiding, chosen, decision);
  return chosen;
}

}  // namespace waylight
