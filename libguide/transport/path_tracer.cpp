#include "libguide/transport/path_tracer.h"

#include <utility>

#include "libguide/transport/mis_weight.h"
#include "libguide/transport/path_state.h"
#include "libguide/transport/split_sampler.h"

namespace waylight {
namespace {

constexpr int kUnlimitedDepth = 1 << 20;  // bound of "no limit": roulette ends paths long before
constexpr int kLongPath = 100;            // edges; beyond, roulette is by throughput as well
constexpr int kMaxUnjudged = 16;          // delta scatterings after which it is so too
constexpr float kMinSurvival = 0.05f;
constexpr uint32_t kNoCell = ~0u;

uint32_t cell_of(const GuidingCaches& caches, const DirectionSampler& directions) {
  return directions.cell() ? caches.index(*directions.cell()) : kNoCell;
}
uint32_t cell_of(const GuidingCaches& /*caches*/, const PhaseSampler& /*directions*/) {
  return kNoCell;
}

}  // namespace

PathRecord PathTracer::trace(const Ray& ray, const Sampler& sampler,
                             const PathContext& context) const {
  Walk walk(context);
  State state{ray,          sampler, Color::Ones(), Color::Ones(), ray.origin, 0, true,
              kMaxUnjudged, 1,       camera_medium_};
  walk.reach(1);
  return follow(walk, state);
}

// The point is as a vertex whose phase function is even, and that nothing came to.
PathRecord PathTracer::gather(const Vec3& p, int medium, const Sampler& sampler,
                              const PathContext& context) const {
  const PhaseFunction even = IsotropicPhase();
  const PhaseSampler directions(even, Vec3::UnitZ());
  MediumPoint at;
  at.p = p;
  at.medium = &scene_.medium(medium);
  at.index = medium;
  Walk walk(context);
  State state{Ray{}, sampler, Color::Constant(4 * kPi), Color::Ones(), p, 0, false, kMaxUnjudged,
              0,     medium};
  return go_on(walk, state, at, directions) ? follow(walk, state) : walk.record;
}

// To the end, and all copies after it.
PathRecord PathTracer::follow(Walk& walk, State& state) const {
  for (;;) {
    while (advance(walk, state)) {
    }
    if (walk.waiting_count == 0) return walk.record;
    state = walk.waiting[--walk.waiting_count];
  }
}

// Follows one edge and scatters at its end; false when the path is over.
bool PathTracer::advance(Walk& walk, State& state) const {
  const PathVertex vertex = next_vertex(walk, state);
  if (const auto* at = std::get_if<SurfacePoint>(&vertex)) return visit(walk, state, *at);
  if (const auto* at = std::get_if<MediumPoint>(&vertex)) return visit(walk, state, *at);
  return false;
}

// The next vertex that is really met: transparent surfaces are crossed with probability
// 1 - opacity, and media with the probability of the flight.
PathVertex PathTracer::next_vertex(Walk& walk, State& state) const {
  float crossed = std::exchange(state.crossed, 0.0f);
  for (int i = 0; i < kMaxCrossings; ++i) {
    ++walk.record.rays;
    std::optional<SurfacePoint> at = scene_.intersect(state.ray);
    if (state.medium != kNone)
      if (const auto event = fly(walk, state, at ? at->t : kInfinity, crossed)) return *event;
    if (!at) {
      add_environment(walk, state);
      return {};
    }
    const float opacity = scene_.opacity(*at);
    at->t += crossed;
    if (opacity >= 1 || (opacity > 0 && state.sampler.next() < opacity)) return *at;
    if (at->emitter != kNone) add_emission(walk, state, *at);
    crossed = at->t;
    state.medium = medium_beyond(*at, state.ray.direction, state.medium);
    state.ray = scene_.spawn_ray(*at, state.ray.direction);
  }
  return {};
}

// One flight through the medium of the ray; empty when it passes.
std::optional<MediumPoint> PathTracer::fly(Walk& walk, State& state, float t_max,
                                           float crossed) const {
  const MediumTracker& medium = scene_.medium(state.medium);
  add_emission(walk, state, medium, t_max);
  const Flight end = flight(walk, state, medium, t_max);
  state.throughput *= end.weight;
  if (!end.scattered) return std::nullopt;
  state.weigh(end.here.albedo);
  return medium_point(medium, state.medium, state.ray, end, crossed);
}

// Light straight from emitters counts at the end of a flight where no next-event estimation at its
// start has sampled it.
Flight PathTracer::flight(Walk& walk, State& state, const MediumTracker& medium,
                          float t_max) const {
  const FlightMethod method = options_.flight;
  if (is_standard(method, medium, options_.flights) ||
      (needs_guides(method) && caches_.media().empty()))
    return medium.fly(state.ray, t_max, state.throughput, state.sampler);
  ++walk.record.guided_flights;
  const Color channels = channel_probs(state.throughput);
  const FlightSpace space{medium, caches_.media(), state.medium,  state.ray,
                          t_max,  channels,        state.specular};
  return sample_flight(method, scene_, space, options_.flights, state.sampler);
}

bool PathTracer::too_deep(const State& state) const {
  return state.edges >= (options_.max_depth < 0 ? kUnlimitedDepth : options_.max_depth);
}

bool PathTracer::visit(Walk& walk, State& state, const SurfacePoint& at) const {
  add_emission(walk, state, at);
  const bool ends = too_deep(state) && !scene_.may_be_transparent(at);
  if (ends && state.edges > 1) return false;
  const DirectionSampler directions(scene_, caches_, options_.directions, at, -state.ray.direction);
  if (state.edges == 1) {
    walk.record.albedo = directions.resolved().bsdf.mean_reflectance();
    walk.record.normal = directions.resolved().frame.n;
    walk.record.depth = at.t;
  }
  return !ends && go_on(walk, state, at, directions);
}

bool PathTracer::visit(Walk& walk, State& state, const MediumPoint& at) const {
  if (state.edges == 1) {
    walk.record.albedo = at.albedo;
    walk.record.depth = at.t;
  }
  if (too_deep(state) || is_black(state.throughput)) return false;
  const MediumGuides& guides = caches_.media();
  const bool asks = !guides.empty() && (options_.phases.guide != PhaseGuide::none ||
                                        options_.roulette == Roulette::guided);
  const PhaseSampler directions(at.medium->phase(), -state.ray.direction, at.p,
                                asks ? &guides.at(at.index, at.p) : nullptr,
                                asks ? &guides.phase(at.index) : nullptr,
                                options_.phases.for_medium(at.medium->homogeneous()));
  return go_on(walk, state, at, directions);
}

template <typename At, typename Directions>
bool PathTracer::go_on(Walk& walk, State& state, const At& at, const Directions& directions) const {
  if (too_deep(state)) return scatter(walk, state, at, directions);
  if (directions.has_smooth()) add_direct_light(walk, state, at, directions);
  const int copies = choose_copies(walk, state, directions);
  if (copies == 1) return scatter(walk, state, at, directions);
  if (copies > 1) return scatter_copies(walk, state, copies, at, directions);
  ++walk.record.killed;
  return false;
}

void PathTracer::add_emission(Walk& walk, const State& state, const SurfacePoint& at) const {
  if (at.emitter == kNone || (options_.hide_emitters && state.edges == 1)) return;
  const Vec3 wo = -state.ray.direction;
  const Color emitted = scene_.emitted(at, wo);
  if (is_black(emitted)) return;
  const float light_pdf =
      state.specular ? 0.0f : scene_.light_pdf(state.previous, at, state.ray.direction);
  const float weight = state.specular ? 1.0f : mis_weight(state.pdf, light_pdf);
  walk.add(state.edges, state.throughput * emitted * weight);
}

// All that the medium emits along the ray up to the next surface, wherever the flight ends: the
// light behind its end is no other path's. Next-event estimation does not look for it.
void PathTracer::add_emission(Walk& walk, State& state, const MediumTracker& medium,
                              float t_max) const {
  if (!medium.emits() || (options_.hide_emitters && state.edges == 1)) return;
  walk.add(state.edges, state.throughput * medium.emission(state.ray, t_max, state.sampler));
}

void PathTracer::add_environment(Walk& walk, const State& state) const {
  if (options_.hide_emitters && state.edges == 1) return;
  const Color radiance = scene_.environment(state.ray.direction);
  if (is_black(radiance)) return;
  const float weight =
      state.specular ? 1.0f : mis_weight(state.pdf, scene_.environment_pdf(state.ray.direction));
  walk.add(state.edges, state.throughput * radiance * weight);
}

template <typename At, typename Directions>
void PathTracer::add_direct_light(Walk& walk, State& state, const At& at,
                                  const Directions& directions) const {
  const float u = state.sampler.next();
  const std::optional<LightSample> light = scene_.sample_light(at.p, u, state.sampler.next_2d());
  if (!light || !(light->pdf > 0)) return;
  const EvalPdf f = directions.evaluate(light->wi);
  if (is_black(f.value)) return;
  ++walk.record.rays;
  const Color visibility = scene_.transmittance(at, medium_after(at, light->wi, state.medium),
                                                light->wi, light->distance, state.sampler);
  if (is_black(visibility)) return;
  const float weight = light->is_delta ? 1.0f : mis_weight(light->pdf, f.pdf);
  walk.add(state.edges + 1,
           state.throughput * f.value * light->radiance * visibility * (weight / light->pdf));
}

// Guided roulette and splitting: how many copies of the path go on from this vertex.
template <typename Directions>
int PathTracer::choose_copies(Walk& walk, State& state, const Directions& directions) const {
  state.unjudged = directions.has_smooth() ? kMaxUnjudged : state.unjudged + 1;
  if (options_.roulette != Roulette::guided) return 1;
  const float estimate = directions.reflected_estimate();
  if (!(estimate > 0)) return 1;
  const float expected = luminance(state.throughput) * estimate;
  if (!(walk.pixel_estimate > 0)) walk.pixel_estimate = expected;
  const float q = expected / walk.pixel_estimate;
  const bool settles = walk.record.copies < kMaxCopies && state.edges < kLongPath;
  const int room = walk.room(options_.max_split);
  Population population;
  if (options_.window.leaves(q, room)) {
    population = options_.window.decide(q, room, state.sampler.next());
    state.weigh(Color::Constant(population.weight));
  }
  if (settles) state.judged();
  return population.copies;
}

// One copy goes on at once, the others wait.
template <typename At, typename Directions>
bool PathTracer::scatter_copies(Walk& walk, State& state, int copies, const At& at,
                                const Directions& directions) const {
  walk.record.copies += copies - 1;
  for (int i = 1; i < copies; ++i) {
    State& copy = *std::construct_at(&walk.waiting[walk.waiting_count], state);
    copy.sampler = split_sampler(state.sampler, i);
    if (scatter(walk, copy, at, directions)) ++walk.waiting_count;
  }
  state.sampler = split_sampler(state.sampler, 0);
  return scatter(walk, state, at, directions);
}

template <typename At, typename Directions>
bool PathTracer::scatter(Walk& walk, State& state, const At& at,
                         const Directions& directions) const {
  const std::optional<DirectionSample> next = directions.sample(state.sampler);
  if (directions.has_smooth()) {
    ++walk.record.scatterings;
    walk.record.guided += directions.guided();
    walk.record.in_grids += in_grid(at);
    walk.record.bsdf_share += directions.bsdf_share();
  }
  if (!next) return false;
  if (next->straight) return pass_pane(walk, state, at, *next);
  if (too_deep(state)) return false;
  const uint32_t cell = walk.context.guided ? cell_of(caches_, directions) : kNoCell;
  if (cell != kNoCell && !next->is_delta)
    walk.context.guided->push_back({cell, next->bsdf_pdf, next->light_pdf, next->guide_pdf,
                                    next->pdf / (1 - directions.delta_prob()),
                                    luminance(walk.record.radiance)});
  state.throughput *= next->weight;
  state.roulette_throughput *= (next->bsdf_weight * (next->eta * next->eta)).min(1.0f);
  state.pdf = next->pdf;
  state.specular = next->is_delta;
  state.previous = at.p;
  state.medium = medium_after(at, next->wi, state.medium);
  state.ray = scene_.spawn_ray(at, next->wi);
  if (is_black(state.throughput)) return false;
  if (!survives_throughput(state)) {
    ++walk.record.killed;
    return false;
  }
  walk.reach(++state.edges);
  return true;
}

// A pane is no vertex: next-event estimation sees through it, so what is met beyond is weighed
// against that as if there were none.
template <typename At>
bool PathTracer::pass_pane(Walk& walk, State& state, const At& at,
                           const DirectionSample& through) const {
  if (state.edges == 1) walk.record.forget_first_vertex();
  state.crossed = at.t;
  state.weigh(through.weight);
  state.medium = medium_after(at, through.wi, state.medium);
  state.ray = scene_.spawn_ray(at, through.wi);
  return !is_black(state.throughput);
}

// By the throughput that BSDF sampling would have had: a guided path's own throughput is low by
// design where light is, and roulette by it kills just the paths that matter. Of a path that was
// judged by the caches it counts what happened since; mirrors and smooth glass, about which caches
// say nothing, change little, and their next vertex is judged again.
bool PathTracer::survives_throughput(State& state) const {
  if (options_.roulette == Roulette::none || state.unjudged < kMaxUnjudged) return true;
  if (state.edges < options_.rr_depth) return true;
  const float expected = state.roulette_throughput.maxCoeff();
  const float survival_prob = std::clamp(expected, kMinSurvival, 0.95f);
  if (state.sampler.next() >= survival_prob) return false;
  state.weigh(Color::Constant(1 / survival_prob));
  return true;
}

}  // namespace waylight
