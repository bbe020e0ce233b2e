#include "libguide/render_pilot.h"

#include <cmath>
#include <limits>
#include <optional>

#include "libguide/render_plan.h"
#include "libguide/transport/choice_pilot.h"
#include "libguide/transport/method_pilot.h"

namespace waylight {
namespace {

constexpr double kPilotShare = 1 / 32.0;  // of the render's paths or time
constexpr double kLearningShare = 0.4;    // of that, for the choices of the cells
constexpr uint64_t kMaxPaths = 1 << 20;
// Standard errors that a gain has to be worth; and what it has to be beyond, of what guides less
// too: what that loses is rare bright paths, which a pilot may not have seen.
constexpr double kCertainty = 3, kLeastGain = 0.01, kLeastGainOfLess = 0.1;
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

enum class Decision { surfaces, directions, distances, roulette };

// A change to what guides everything; no more than one is made of each decision.
struct Alternative {
  const char* name;
  Decision of;
  void (*apply)(PathTracerOptions&);
  bool held = true;  // not where it guides less: see PilotArm
};

constexpr Alternative kResampling = {"ris", Decision::surfaces, [](PathTracerOptions& o) {
                                       o.directions.guide = DirectionGuide::resampled;
                                       o.directions.bsdf_share = default_share(RenderMode::ris);
                                       o.directions.learned = false;
                                     }};
constexpr Alternative kLight = {"without product", Decision::surfaces,
                                [](PathTracerOptions& o) { o.directions.light_alone = true; }};
constexpr Alternative kSurfaces = {"bsdf on surfaces", Decision::surfaces,
                                   [](PathTracerOptions& o) { o.directions = {}; }, false};
constexpr Alternative kPhase = {"phase function", Decision::directions,
                                [](PathTracerOptions& o) { o.phases.guide = PhaseGuide::none; },
                                false};
constexpr Alternative kDistance = {"standard distances", Decision::distances,
                                   [](PathTracerOptions& o) { o.flight = FlightMethod::standard; },
                                   false};
constexpr Alternative kGrids = {"guided distances in grids", Decision::distances,
                                [](PathTracerOptions& o) { o.flights.guides_grids = true; }};

constexpr Alternative kRoulette = {"roulette by throughput", Decision::roulette,
                                   [](PathTracerOptions& o) { o.roulette = Roulette::throughput; },
                                   false};

constexpr Alternative kGuidedRoulette = {
    "guided roulette", Decision::roulette,
    [](PathTracerOptions& o) { o.roulette = Roulette::guided; }};

bool has_media(const Scene& scene, bool homogeneous) {
  for (int i = 0; i < static_cast<int>(scene.description().media.size()); ++i)
    if (scene.medium(i).homogeneous() == homogeneous) return true;
  return false;
}

// Smooth scatterings of a few paths.
struct Glance {
  uint64_t scatterings = 0, guided = 0, in_grids = 0;

  double guided_share() const { return scatterings > 0 ? double(guided) / double(scatterings) : 1; }
  double share_in_grids() const {
    return scatterings > 0 ? double(in_grids) / double(scatterings) : 0;
  }
};

// What the options leave open, and the caches make possible, to change in `everything`. A short
// pilot gets to the first of these only.
std::vector<Alternative> alternatives(const Scene& scene, const GuidingCaches& caches,
                                      const RenderOptions& options,
                                      const PathTracerOptions& everything,
                                      const AutoDecision& cells) {
  const bool chosen = cells.cells_bsdf + cells.cells_illumination + cells.cells_product > 0;
  const bool may_use_product = caches.has_fits() && (cells.cells_product > 0 || !chosen);
  std::vector<Alternative> open;
  if (options.roulette == RouletteMode::automatic)
    open.push_back(everything.roulette == Roulette::throughput ? kGuidedRoulette : kRoulette);
  if (caches.guided()) open.push_back(kResampling);
  if (caches.guided() && may_use_product) open.push_back(kLight);
  if (caches.media().empty()) return open;
  if (caches.guided()) open.push_back(kSurfaces);
  if (options.direction == PhaseMode::automatic) open.push_back(kPhase);
  if (options.distance != DistanceMode::automatic) return open;
  if (has_media(scene, true)) open.push_back(kDistance);
  if (has_media(scene, false)) open.push_back(kGrids);
  return open;
}

PilotArm arm_of(const Alternative& change, PathTracerOptions options) {
  change.apply(options);
  return {{change.name}, options, change.held};
}

// Nothing guided but what the options ask for by name.
PathTracerOptions plain(const RenderOptions& options, PathTracerOptions tracing) {
  tracing.directions = {};
  if (options.direction == PhaseMode::automatic) kPhase.apply(tracing);
  if (options.distance == DistanceMode::automatic) kDistance.apply(tracing);
  if (options.roulette == RouletteMode::automatic) kRoulette.apply(tracing);
  return tracing;
}

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

  // At a few paths all over the frame; at none where these would be more than a pilot may take.
  Glance glance(const PathTracerOptions& tracing) const {
    Glance seen;
    if (max_paths_ < kGlancePaths) return seen;
    const PathTracer tracer = tracer_.with(tracing);
    for (int i = 0; i < kGlancePaths; ++i) {
      const int place = static_cast<int>(int64_t{i} * frame_.places() / kGlancePaths);
      Sampler sampler = frame_.sampler(place, 0, 0);
      const Ray ray = frame_.ray(place, 0, sampler);
      const PathRecord path = tracer.trace(ray, sampler, {});
      seen.scatterings += path.scatterings;
      seen.guided += path.guided;
      seen.in_grids += path.in_grids;
    }
    return seen;
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
    pilot.max_paths = static_cast<uint64_t>((1 - kLearningShare) * double(max_paths_));
    pilot.timed = options_.time > 0;
    return measure(tracer_, arms, frame_, pilot, [&] { return stop_() || late(1); });
  }

  double seconds() const { return clock_.seconds(); }

 private:
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
  static double least_gain(const PilotArm& arm) {
    const double by_chance = kCertainty * arm.figures.uncertainty;
    return arm.held ? std::max(by_chance, kLeastGain) : by_chance + kLeastGainOfLess;
  }
  double least_gain_of_plain(double best) const {
    const double uncertainty = arms_[1].figures.uncertainty;
    if (doubtful_) return best - kCertainty * uncertainty;
    if (uncertainty > kVague) return std::numeric_limits<double>::infinity();
    return std::max(best, least_gain(arms_[1]));
  }
  std::optional<size_t> best_change(Decision of) const {
    std::optional<size_t> best;
    for (size_t i = 0; i + 2 < arms_.size(); ++i) {
      if (open_[i].of != of || !(gain(i + 2) > least_gain(arms_[i + 2]))) continue;
      if (!best || gain(i + 2) > gain(*best + 2)) best = i;
    }
    return best;
  }

  const std::vector<PilotArm>& arms_;
  const std::vector<Alternative>& open_;
  bool doubtful_;  // few scatterings have a guide, or few cells one
};

}  // namespace

PathTracerOptions choose_method(const Scene& scene, const SensorDescription& sensor,
                                const PathTracer& tracer, GuidingCaches& guiding,
                                const RenderOptions& options, const std::function<bool()>& stop,
                                AutoDecision* decision) {
  PathTracerOptions everything = tracer_options(scene, options);
  if (!guiding.guided() && guiding.media().empty()) return plain(options, everything);
  if (!guiding.has_fits()) {
    everything.directions.guide = DirectionGuide::illumination;
    everything.directions.bsdf_share = default_share(RenderMode::illumination);
  }
  const MethodChoice pilot(options, sensor, tracer, stop);
  const Glance seen = pilot.glance(everything);
  if (options.roulette == RouletteMode::automatic && !guiding.media().empty() &&
      seen.share_in_grids() > kMostlyInGrids)
    kRoulette.apply(everything);
  const bool doubtful = guiding.media().empty() && (guiding.guide().cells.size() < kFewCells ||
                                                    seen.guided_share() < kRarelyGuided);
  std::vector<CellChoice> choices;
  if (guiding.guided()) choices = pilot.learn(everything, guiding);
  count_cells(choices, decision);
  guiding.learned(std::move(choices));
  everything.directions.learned = true;

  const std::vector<Alternative> open =
      alternatives(scene, guiding, options, everything, *decision);
  std::vector<PilotArm> arms = {{{"guided"}, everything},
                                {{"bsdf"}, plain(options, everything), false}};
  for (const Alternative& change : open) arms.push_back(arm_of(change, everything));
  const size_t otherwise = doubtful ? 1 : 0;
  decision->method = arms[otherwise].figures.name;
  const bool measured = pilot.compare(arms);
  decision->seconds = pilot.seconds();
  if (!measured) return arms[otherwise].options;
  for (const PilotArm& arm : arms) decision->compared.push_back(arm.figures);
  return Verdict(arms, open, doubtful).decide(decision);
}

}  // namespace waylight
