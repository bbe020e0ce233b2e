#include "libguide/transport/path_tracer.h"

namespace waylight {
namespace {

constexpr int kMaxCrossings = 1000;       // transparent surfaces in a row before a path is given up
constexpr int kUnlimitedDepth = 1 << 20;  // bound of "no limit": roulette ends paths long before
constexpr float kMinSurvival = 0.05f;
constexpr float kMinGuidedSurvival = 0.1f;  // a cell's irradiance may be off by far
// A path goes on for certain while it promises at least a third of what is expected of its pixel:
// the lower end 2 / (1 + s) of the weight window with s = 5 [Vorba, Krivanek 2016].
constexpr float kWindow = 3;

// Power heuristic with exponent two for one sample of each technique [Veach 1997, 9.2.4].
float mis_weight(float pdf, float other) {
  if (!(pdf < 1e18f)) return 1;
  const float ratio = other / pdf;
  return 1 / (1 + ratio * ratio);
}

}  // namespace

struct PathTracer::State {
  PathRecord record;
  Ray ray;
  Color throughput = Color::Ones();
  Color roulette_throughput = Color::Ones();  // what BSDF sampling would have had
  float eta_scale = 1;                        // undoes the 1/eta^2 of refraction for roulette
  Vec3 previous;                              // last vertex, from which light_pdf is measured
  float pdf = 0;                              // of the direction of `ray`
  bool specular = true;                       // it came from a delta lobe or the camera
  float pixel_estimate = 0;                   // luminance expected at the first vertex with a cache
  bool has_estimate = false;                  // roulette at this vertex goes by the caches
  int edges = 1;
};

PathRecord PathTracer::trace(Ray ray, Sampler& sampler) const {
  State state;
  state.previous = ray.origin;
  state.ray = ray;
  while (advance(state, sampler)) {
  }
  state.record.edges = state.edges;
  return state.record;
}

// Follows one edge and scatters at its end; false when the path is over.
bool PathTracer::advance(State& state, Sampler& sampler) const {
  const std::optional<SurfacePoint> at = next_surface(state, sampler);
  if (!at) return false;
  add_emission(state, *at);
  const int max_depth = options_.max_depth < 0 ? kUnlimitedDepth : options_.max_depth;
  if (state.edges >= max_depth) return false;

  const Vec3 wo = -state.ray.direction;
  const DirectionSampler directions(scene_, caches_, options_.guide, options_.guiding_prob, *at,
                                    wo);
  if (state.edges == 1) {
    state.record.albedo = directions.resolved().bsdf.mean_reflectance();
    state.record.normal = directions.resolved().frame.n;
    state.record.depth = at->t;
  }
  if (directions.has_smooth()) add_direct_light(state, *at, directions, sampler);
  if (!survives_guided(state, directions, sampler)) return false;

  const float u = sampler.next(), u_lobe = sampler.next();
  const std::optional<DirectionSample> next = directions.sample(u, u_lobe, sampler.next_2d());
  if (directions.has_smooth()) {
    ++state.record.scatterings;
    state.record.guided += directions.guided();
  }
  if (!next) return false;
  state.throughput *= next->weight;
  state.roulette_throughput *= next->bsdf_weight.min(1.0f);
  state.eta_scale *= next->eta * next->eta;
  state.pdf = next->pdf;
  state.specular = next->is_delta;
  state.previous = at->p;
  state.ray = scene_.spawn_ray(*at, next->wi);
  if (!survives_throughput(state, sampler)) return false;
  ++state.edges;
  return true;
}

// The next surface that is really met: transparent ones are crossed with probability 1 - opacity.
std::optional<SurfacePoint> PathTracer::next_surface(State& state, Sampler& sampler) const {
  float crossed = 0;
  for (int i = 0; i < kMaxCrossings; ++i) {
    ++state.record.rays;
    std::optional<SurfacePoint> at = scene_.intersect(state.ray);
    if (!at) {
      add_environment(state);
      return std::nullopt;
    }
    const float opacity = scene_.opacity(*at);
    at->t += crossed;
    if (opacity >= 1 || (opacity > 0 && sampler.next() < opacity)) return at;
    if (at->emitter != kNone) add_emission(state, *at);
    crossed = at->t;
    state.ray = scene_.spawn_ray(*at, state.ray.direction);
  }
  return std::nullopt;
}

void PathTracer::add_emission(State& state, const SurfacePoint& at) const {
  if (at.emitter == kNone || (options_.hide_emitters && state.edges == 1)) return;
  const Vec3 wo = -state.ray.direction;
  const Color emitted = scene_.emitted(at, wo);
  if (is_black(emitted)) return;
  const float light_pdf =
      state.specular ? 0.0f : scene_.light_pdf(state.previous, at, state.ray.direction);
  const float weight = state.specular ? 1.0f : mis_weight(state.pdf, light_pdf);
  state.record.radiance += state.throughput * emitted * weight;
}

void PathTracer::add_environment(State& state) const {
  if (options_.hide_emitters && state.edges == 1) return;
  const Color radiance = scene_.environment(state.ray.direction);
  if (is_black(radiance)) return;
  const float weight =
      state.specular ? 1.0f : mis_weight(state.pdf, scene_.environment_pdf(state.ray.direction));
  state.record.radiance += state.throughput * radiance * weight;
}

void PathTracer::add_direct_light(State& state, const SurfacePoint& at,
                                  const DirectionSampler& directions, Sampler& sampler) const {
  const float u = sampler.next();
  const std::optional<LightSample> light = scene_.sample_light(at.p, u, sampler.next_2d());
  if (!light || !(light->pdf > 0)) return;
  const EvalPdf f = directions.evaluate(light->wi);
  if (is_black(f.value)) return;
  ++state.record.rays;
  const float visibility = scene_.visibility(at, light->wi, light->distance);
  if (visibility <= 0) return;
  const float weight = light->is_delta ? 1.0f : mis_weight(light->pdf, f.pdf);
  state.record.radiance +=
      state.throughput * f.value * light->radiance * (visibility * weight / light->pdf);
}

// Plays roulette: false when the path ends, else its weight is raised.
bool PathTracer::play(State& state, float survival_prob, Sampler& sampler) {
  if (survival_prob >= 1) return true;
  if (sampler.next() >= survival_prob) return false;
  state.throughput /= survival_prob;
  state.roulette_throughput /= survival_prob;
  return true;
}

// q = E[contribution] / I; a path within the window q >= 1 / kWindow goes on. Played after
// next-event estimation: what it credits is the reflected light that is still to come.
bool PathTracer::survives_guided(State& state, const DirectionSampler& directions,
                                 Sampler& sampler) const {
  const float estimate = directions.reflected_estimate();
  state.has_estimate = options_.roulette == Roulette::guided && estimate > 0;
  if (!state.has_estimate) return true;
  const float expected = luminance(state.throughput) * estimate;
  if (state.pixel_estimate <= 0) state.pixel_estimate = expected;
  const float q = expected / state.pixel_estimate;
  return play(state, std::clamp(kWindow * q, kMinGuidedSurvival, 1.0f), sampler);
}

// By the throughput that BSDF sampling would have had: a guided path's own throughput is low by
// design where light is, and roulette by it kills just the paths that matter.
bool PathTracer::survives_throughput(State& state, Sampler& sampler) const {
  if (is_black(state.throughput)) return false;
  if (options_.roulette == Roulette::none || state.has_estimate) return true;
  if (state.edges < options_.rr_depth) return true;
  const float expected = state.roulette_throughput.maxCoeff() * state.eta_scale;
  return play(state, std::clamp(expected, kMinSurvival, 0.95f), sampler);
}

}  // namespace waylight
