#include "libguide/render_alternatives.h"

#include "libguide/render_plan.h"

namespace waylight {
namespace {

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

}  // namespace

bool may_use_product(const AutoDecision& cells) {
  return cells.cells_product > 0 || cells.cells_bsdf + cells.cells_illumination == 0;
}

std::vector<Alternative> alternatives(const Scene& scene, const GuidingCaches& caches,
                                      const RenderOptions& options,
                                      const PathTracerOptions& everything,
                                      const AutoDecision& cells) {
  std::vector<Alternative> open;
  if (options.roulette == RouletteMode::automatic)
    open.push_back(everything.roulette == Roulette::throughput ? kGuidedRoulette : kRoulette);
  if (caches.guided()) open.push_back(kResampling);
  if (caches.guided() && caches.has_fits() && may_use_product(cells)) open.push_back(kLight);
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

PathTracerOptions plain(const RenderOptions& options, PathTracerOptions tracing) {
  tracing.directions = {};
  if (options.direction == PhaseMode::automatic) kPhase.apply(tracing);
  if (options.distance == DistanceMode::automatic) kDistance.apply(tracing);
  if (options.roulette == RouletteMode::automatic) kRoulette.apply(tracing);
  return tracing;
}

}  // namespace waylight
