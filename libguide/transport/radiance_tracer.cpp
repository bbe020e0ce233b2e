#include "libguide/transport/radiance_tracer.h"

#include "libguide/transport/mis_weight.h"
#include "libguide/transport/spread_directions.h"

namespace waylight {
namespace {

constexpr float kMinSurvival = 0.05f, kMaxSurvival = 0.95f;

float cosine_at(const SurfacePoint& at, const Vec3& wi) { return std::abs(at.ns.dot(wi)); }
float cosine_at(const MediumPoint& /*at*/, const Vec3& /*wi*/) { return 0; }

void store(const RadianceStep& step, const Vec3& wi, const Color& irradiance, uint32_t path_depth,
           PhotonRecords* records) {
  if (!is_finite(irradiance) || !step.position.allFinite()) {
    ++records->counts.invalid;
    return;
  }
  const Vec3 normal = step.normal.dot(wi) < 0 ? Vec3(-step.normal) : step.normal;
  records->photons.push_back(
      {step.position, wi, normal, irradiance, path_depth, TracedFrom::camera});
  ++records->counts.samples;
}

// Dark samples of indirect light count: the irradiance is a mean over them all.
void store_all(const RadianceStep& step, const Color& indirect, PhotonRecords* records) {
  store(step, step.wi, step.cos_over_pdf * indirect, 1, records);
  if (step.both_sides) {
    const Vec3 behind = step.normal.dot(step.wi) < 0 ? step.normal : Vec3(-step.normal);
    store(step, behind, Color::Zero(), 1, records);
  }
  const Color direct = step.cos_over_pdf * step.direct;
  if (!is_black(direct)) store(step, step.wi, direct, 0, records);
  if (!is_black(step.light)) store(step, step.to_light, step.light, 0, records);
}

// What arrives at step i from indirect light: S_i + E_i W_{i+1} (D_{i+1} + that of step i + 1),
// with S scattered, D direct, E edge and W weight.
void carry_back(const RadiancePath& path, PhotonRecords* records) {
  Color carried = Color::Zero();
  for (size_t i = path.size(); i-- > 0;) {
    const RadianceStep& step = path[i];
    const Color indirect = step.scattered + step.edge * carried;
    if (step.stores) store_all(step, indirect, records);
    carried = step.weight * (step.direct + indirect);
  }
}

}  // namespace

struct RadianceTracer::State {
  Ray ray;
  Sampler& sampler;
  RadiancePath& path;  // the ray leaves its last step
  int medium;          // that `ray` is in
  Color throughput = Color::Ones();
  Vec3 previous = Vec3::Zero();  // last vertex, from which light_pdf is measured
  float pdf = 0;                 // of the direction of `ray`
  bool specular = true;          // it came from a delta lobe or the camera
  int depth = 0;

  RadianceStep& last() { return path.back(); }
  void attenuate(const Color& factor) {  // on the way to the next vertex
    last().edge *= factor;
    throughput *= factor;
  }
};

RadianceTracer::RadianceTracer(const Scene& scene, const RadianceTracerOptions& options,
                               const GuideCacheView& cache)
    : scene_(scene),
      options_(options),
      camera_(scene),
      caches_(nullptr, cache, scene.description().materials) {
  if (caches_.guided()) directions_.guide = DirectionGuide::illumination;
}

void RadianceTracer::trace(Sampler& sampler, RadiancePath& path, PhotonRecords* records) const {
  ++records->counts.paths;
  path.assign(1, {});
  State state{camera_.ray(sampler), sampler, path, camera_.medium()};
  for (bool alive = true; alive;) {
    const PathVertex vertex = next_vertex(state);
    const auto* surface = std::get_if<SurfacePoint>(&vertex);
    const auto* medium = std::get_if<MediumPoint>(&vertex);
    alive = surface ? visit(state, *surface) : medium && visit(state, *medium);
  }
  carry_back(path, records);
}

PathVertex RadianceTracer::next_vertex(State& state) const {
  float crossed = 0;
  for (int i = 0; i < kMaxCrossings; ++i) {
    std::optional<SurfacePoint> at = scene_.intersect(state.ray);
    if (state.medium != kNone)
      if (const auto event = fly(state, at ? at->t : kInfinity, crossed)) return *event;
    if (!at) {
      meet_environment(state);
      return {};
    }
    const float opacity = scene_.opacity(*at);
    at->t += crossed;
    meet_emitter(state, *at);
    if (opacity >= 1 || (opacity > 0 && state.sampler.next() < opacity)) return *at;
    crossed = at->t;
    state.medium = medium_beyond(*at, state.ray.direction, state.medium);
    state.ray = scene_.spawn_ray(*at, state.ray.direction);
  }
  return {};
}

// All that the medium emits up to the next surface, wherever the flight ends, is indirect light:
// next-event estimation does not look for it.
std::optional<MediumPoint> RadianceTracer::fly(State& state, float t_max, float crossed) const {
  const MediumTracker& medium = scene_.medium(state.medium);
  if (medium.emits())
    state.last().scattered += state.last().edge * medium.emission(state.ray, t_max, state.sampler);
  const Flight end = medium.fly(state.ray, t_max, state.throughput, state.sampler);
  state.attenuate(end.weight);
  if (!end.scattered) return std::nullopt;
  state.attenuate(end.here.albedo);
  return medium_point(medium, state.medium, state.ray, end, crossed);
}

void RadianceTracer::meet_emitter(State& state, const SurfacePoint& at) const {
  if (at.emitter == kNone) return;
  const Color emitted = scene_.emitted(at, -state.ray.direction);
  if (is_black(emitted)) return;
  const float light_pdf =
      state.specular ? 0 : scene_.light_pdf(state.previous, at, state.ray.direction);
  const float weight = state.specular ? 1 : mis_weight(state.pdf, light_pdf);
  state.last().direct += state.last().edge * emitted * weight;
}

void RadianceTracer::meet_environment(State& state) const {
  const Color radiance = scene_.environment(state.ray.direction);
  if (is_black(radiance)) return;
  const float weight =
      state.specular ? 1 : mis_weight(state.pdf, scene_.environment_pdf(state.ray.direction));
  state.last().direct += state.last().edge * radiance * weight;
}

bool RadianceTracer::visit(State& state, const SurfacePoint& at) const {
  const Vec3 wo = -state.ray.direction;
  const DirectionSampler path(scene_, caches_, directions_, at, wo);
  const SpreadDirections directions(path, wo);
  const Bsdf& bsdf = path.resolved().bsdf;
  const Color albedo = bsdf.mean_reflectance();
  RadianceStep step;
  if (directions.has_smooth()) add_direct_light(state, at, directions, step);
  if (is_black(albedo) || !survives(state, albedo.maxCoeff(), step)) return false;
  const std::optional<DirectionSample> next = directions.sample(state.sampler);
  if (next && next->straight) return pass_pane(state, at, step.weight * next->weight);
  if (directions.has_smooth() && !(next && next->is_delta)) {
    step.both_sides = bsdf.smooth_transmissive();
    set_sample(step, at, wo, next, directions.smooth_prob());
  }
  if (next) return go_on(state, at, *next, step);
  step.weight = Color::Zero();
  state.path.push_back(step);
  return false;
}

// A pane is no vertex: next-event estimation sees through it.
bool RadianceTracer::pass_pane(State& state, const SurfacePoint& at, const Color& weight) const {
  state.attenuate(weight);
  state.medium = medium_beyond(at, state.ray.direction, state.medium);
  state.ray = scene_.spawn_ray(at, state.ray.direction);
  return !is_black(state.throughput);
}

bool RadianceTracer::visit(State& state, const MediumPoint& at) const {
  const PhaseSampler directions(at.medium->phase(), -state.ray.direction);
  RadianceStep step;
  add_direct_light(state, at, directions, step);
  if (!survives(state, at.albedo.maxCoeff(), step)) return false;
  const std::optional<DirectionSample> next = directions.sample(state.sampler);
  return next && go_on(state, at, *next, step);
}

// By the albedo alone: each vertex learns from what comes after it, however little of that reaches
// the camera. Played before the direction is chosen, so that those who survive leave samples of all
// directions.
bool RadianceTracer::survives(State& state, float albedo, RadianceStep& step) const {
  if (state.depth >= options_.max_depth) return false;
  if (state.depth < options_.rr_depth) return true;
  const float prob = std::clamp(albedo, kMinSurvival, kMaxSurvival);
  if (state.sampler.next() >= prob) return false;
  step.weight = Color::Constant(1 / prob);
  return true;
}

// Without a direction the vertex has sampled one from which no light is scattered.
void RadianceTracer::set_sample(RadianceStep& step, const SurfacePoint& at, const Vec3& wo,
                                const std::optional<DirectionSample>& next,
                                float smooth_prob) const {
  step.stores = true;
  step.position = at.p;
  step.normal = at.ns.dot(wo) < 0 ? Vec3(-at.ns) : at.ns;
  step.wi = next ? next->wi : step.normal;
  if (next) step.cos_over_pdf = cosine_at(at, next->wi) * smooth_prob / next->pdf;
}

template <typename At>
bool RadianceTracer::go_on(State& state, const At& at, const DirectionSample& next,
                           RadianceStep& step) const {
  step.weight *= next.weight;
  state.path.push_back(step);
  if (!is_black(step.weight)) state.throughput *= step.weight;  // else it goes on for `step` alone
  state.pdf = next.pdf;
  state.specular = next.is_delta;
  state.previous = at.p;
  state.medium = medium_after(at, next.wi, state.medium);
  state.ray = scene_.spawn_ray(at, next.wi);
  ++state.depth;
  return step.stores || !is_black(step.weight);
}

template <typename At, typename Directions>
void RadianceTracer::add_direct_light(State& state, const At& at, const Directions& directions,
                                      RadianceStep& step) const {
  const float u = state.sampler.next();
  const std::optional<LightSample> light = scene_.sample_light(at.p, u, state.sampler.next_2d());
  if (!light || !(light->pdf > 0)) return;
  const EvalPdf f = directions.evaluate(light->wi);
  if (!(f.pdf > 0)) return;
  const Color visibility = scene_.transmittance(at, medium_after(at, light->wi, state.medium),
                                                light->wi, light->distance, state.sampler);
  if (is_black(visibility)) return;
  const float weight = light->is_delta ? 1.0f : mis_weight(light->pdf, f.pdf);
  const Color arriving = light->radiance * visibility * (weight / light->pdf);
  state.last().scattered += state.last().edge * f.value * arriving;
  step.to_light = light->wi;
  step.light = cosine_at(at, light->wi) * arriving;
}

}  // namespace waylight
