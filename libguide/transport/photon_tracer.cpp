#include "libguide/transport/photon_tracer.h"

namespace waylight {
namespace {

constexpr float kMaxCorrection = 10;

constexpr float kBsdfShare = 0.5f;  // the rest is scattered by importance, where it is known

// A photon goes on for certain while it promises at least a third of what the average photon does:
// the lower end of the weight window of [Vorba, Krivanek 2016] with s = 5.
constexpr float kWindow = 3;
constexpr float kMinSurvival = 0.05f;

// The adjoint BSDF: f |cos ns(out)| becomes f |cos ng(out)| |cos ns(in)| / |cos ng(in)| where
// shading and geometric normals differ [Veach 1997, 5.3]. Zero where the two disagree about a side.
// Capped: photons only train caches, and one photon at a grazing angle must not capture a cell.
float adjoint_correction(const Frame& shading, const Vec3& ng, const Vec3& in, const Vec3& out) {
  const float flipped = shading.n.dot(ng) >= 0 ? 1.0f : -1.0f;
  const float ng_in = in.dot(ng) * flipped, ng_out = out.dot(ng) * flipped;
  const float ns_in = in.dot(shading.n), ns_out = out.dot(shading.n);
  if (ng_in * ns_in <= 0 || ng_out * ns_out <= 0) return 0;
  return std::min(std::abs(ng_out * ns_in / (ng_in * ns_out)), kMaxCorrection);
}

std::optional<EmissionSample> plain_emission(const Scene& scene, Sampler& sampler) {
  const float u = sampler.next();
  const Vec2 u_position = sampler.next_2d();
  return scene.sample_emission(u, u_position, sampler.next_2d());
}

}  // namespace

PhotonTracer::PhotonTracer(const Scene& scene, const PhotonTracerOptions& options,
                           const GuideCacheView& importance)
    : scene_(scene), options_(options), guide_(nullptr, importance, scene.description().materials) {
  if (guide_.guided() && options_.quantity == Quantity::radiance) {
    emission_.emplace(scene, importance);
    expected_contribution_ = static_cast<float>(emission_->expected_image()) * options.power_scale;
    plain_power_ = static_cast<float>(emission_->emitted_power()) * options.power_scale;
  }
  if (options_.quantity == Quantity::radiance) {
    prepare_media();
    return;
  }
  camera_.emplace(scene);
  stores_escapes_ = scene.has_distant_light();
}

// By power, between media and emitters.
void PhotonTracer::prepare_media() {
  const std::vector<Medium>& media = scene_.description().media;
  if (std::none_of(media.begin(), media.end(),
                   [](const Medium& medium) { return emits(medium.emission); }))
    return;
  media_.emplace(scene_);
  const double power = media_->power(), all = power + scene_.emitter_power();
  media_prob_ = power > 0 ? static_cast<float>(power / all) : 0.0f;
  plain_power_ += static_cast<float>(media_->power_luminance()) * options_.power_scale;
}

void PhotonTracer::trace(Sampler& sampler, PhotonRecords* records) const {
  PhotonCounts& counts = records->counts;
  ++counts.emitted;
  std::optional<Particle> particle = start(sampler);
  if (!particle) {
    ++counts.absorbed;
    return;
  }
  for (bool alive = true; alive;) {
    const PathVertex vertex = next_vertex(*particle, records, sampler);
    const auto* surface = std::get_if<SurfacePoint>(&vertex);
    const auto* medium = std::get_if<MediumPoint>(&vertex);
    if (!surface && !medium) return store_escape(*particle, records);
    alive = surface ? visit(*particle, *surface, records, sampler)
                    : visit(*particle, *medium, records, sampler);
  }
}

bool PhotonTracer::visit(Particle& particle, const SurfacePoint& at, PhotonRecords* records,
                         Sampler& sampler) const {
  const TransportMode mode =
      options_.quantity == Quantity::radiance ? TransportMode::importance : TransportMode::radiance;
  const DirectionOptions guided{emission_ ? DirectionGuide::illumination : DirectionGuide::none,
                                kBsdfShare};
  const DirectionSampler directions(scene_, guide_, guided, at, -particle.ray.direction, mode);
  if (stores(particle, at, directions.resolved().bsdf)) store(particle, at, records);
  if (static_cast<int>(particle.depth) >= options_.max_depth) {
    ++records->counts.too_deep;
    return false;
  }
  const float importance = expected_contribution_ > 0 ? directions.reflected_estimate() : 0;
  if (survives_guided(particle, importance, sampler) &&
      scatter(particle, at, directions, importance > 0, sampler))
    return true;
  ++records->counts.absorbed;
  return false;
}

bool PhotonTracer::visit(Particle& particle, const MediumPoint& at, PhotonRecords* records,
                         Sampler& sampler) const {
  if (static_cast<int>(particle.depth) >= options_.max_depth) {
    ++records->counts.too_deep;
    return false;
  }
  const PhaseSampler directions(at.medium->phase(), -particle.ray.direction);
  const std::optional<DirectionSample> s = directions.sample(sampler);
  if (s) {
    particle.ray = {at.p, s->wi};
    if (go_on(particle, particle.power * at.albedo * s->weight, 1, false, sampler)) return true;
  }
  ++records->counts.absorbed;
  return false;
}

std::optional<PhotonTracer::Particle> PhotonTracer::start(Sampler& sampler) const {
  return camera_ ? leave_camera(sampler) : leave_emitter(sampler);
}

std::optional<PhotonTracer::Particle> PhotonTracer::leave_emitter(Sampler& sampler) const {
  if (media_prob_ > 0 && sampler.next() < media_prob_) return leave_medium(sampler);
  const std::optional<EmissionSample> emission =
      emission_ ? emission_->sample(sampler) : plain_emission(scene_, sampler);
  if (!emission || is_black(emission->power)) return std::nullopt;
  return Particle{emission->ray, emission->power * (options_.power_scale / (1 - media_prob_)), 0,
                  scene_.medium_at(emission->ray.origin)};
}

std::optional<PhotonTracer::Particle> PhotonTracer::leave_medium(Sampler& sampler) const {
  const std::optional<MediumLights::Sample> emission = media_->sample(sampler);
  if (!emission || is_black(emission->power)) return std::nullopt;
  return Particle{emission->ray, emission->power * (options_.power_scale / media_prob_), 1,
                  emission->medium};
}

PhotonTracer::Particle PhotonTracer::leave_camera(Sampler& sampler) const {
  return {camera_->ray(sampler), Color::Constant(options_.power_scale), 0, camera_->medium()};
}

PathVertex PhotonTracer::next_vertex(Particle& particle, PhotonRecords* records,
                                     Sampler& sampler) const {
  for (int i = 0; i < kMaxCrossings; ++i) {
    const std::optional<SurfacePoint> at = scene_.intersect(particle.ray);
    if (particle.medium != kNone)
      if (const auto event = fly(particle, at ? at->t : kInfinity, records, sampler)) return *event;
    if (!at) return {};
    const float opacity = scene_.opacity(*at);
    if (opacity >= 1 || (opacity > 0 && sampler.next() < opacity)) return *at;
    particle.medium = medium_beyond(*at, particle.ray.direction, particle.medium);
    particle.ray = scene_.spawn_ray(*at, particle.ray.direction);
  }
  return {};
}

// One flight leaves up to two estimates of the fluence, each for half: at a uniform point of its
// track the power times the length, which works where a medium is so thin that hardly anything
// collides, and at its collision the power over the extinction. What colour does to the power
// along the track is left out of the first.
std::optional<MediumPoint> PhotonTracer::fly(Particle& particle, float t_max,
                                             PhotonRecords* records, Sampler& sampler) const {
  const MediumTracker& medium = scene_.medium(particle.medium);
  const Flight flight = medium.fly(particle.ray, t_max, particle.power, sampler);
  if (flight.t < kInfinity)
    store_in_medium(particle, particle.ray(sampler.next() * flight.t),
                    0.5f * flight.t * particle.power, records);
  particle.power *= flight.weight;
  if (!flight.scattered) return std::nullopt;
  const MediumPoint at = medium_point(medium, particle.medium, particle.ray, flight, 0);
  const Color mean_free_path =
      (flight.here.sigma_t > 0).select(1 / flight.here.sigma_t, Color(0, 0, 0));
  store_in_medium(particle, at.p, 0.5f * particle.power * mean_free_path, records);
  return at;
}

bool PhotonTracer::stores(const Particle& particle, const SurfacePoint& at,
                          const Bsdf& bsdf) const {
  const bool emits = at.emitter != kNone && at.ng.dot(particle.ray.direction) < 0;
  return (bsdf.has_smooth() && !is_black(bsdf.mean_reflectance())) || (camera_ && emits);
}

void PhotonTracer::store(const Particle& particle, const SurfacePoint& at,
                         PhotonRecords* records) const {
  if (!is_finite(particle.power) || !at.p.allFinite()) {
    ++records->counts.invalid;
    return;
  }
  const Vec3 wi = -particle.ray.direction;
  const Vec3 normal = at.ns.dot(wi) < 0 ? Vec3(-at.ns) : at.ns;
  records->photons.push_back({at.p, wi, normal, particle.power, particle.depth});
  ++records->counts.stored;
}

void PhotonTracer::store_in_medium(const Particle& particle, const Vec3& position,
                                   const Color& weight, PhotonRecords* records) const {
  if (camera_ || is_black(weight)) return;
  if (!is_finite(weight) || !position.allFinite()) {
    ++records->counts.invalid;
    return;
  }
  records->in_media.push_back({position, -particle.ray.direction, weight, particle.depth});
  ++records->counts.in_media;
}

void PhotonTracer::store_escape(const Particle& particle, PhotonRecords* records) const {
  ++records->counts.left_scene;
  if (!stores_escapes_) return;
  if (!is_finite(particle.power) || !particle.ray.origin.allFinite()) {
    ++records->counts.invalid;
    return;
  }
  records->escapes.push_back(
      {particle.ray.origin, particle.ray.direction, particle.power, particle.depth});
  ++records->counts.escapes;
}

// Guided photons are many where they matter and of little power each. Roulette may raise the power
// of one that matters less up to what it would be without guiding, and not further, whatever the
// cache says; so no photon of a cell outweighs the others by more than the chances of its path did.
bool PhotonTracer::survives_guided(Particle& particle, float importance, Sampler& sampler) const {
  if (!(importance > 0)) return true;
  const float power = luminance(particle.power);
  const float promised = power * importance / expected_contribution_;
  const float prob = std::max({kWindow * promised, power / plain_power_, kMinSurvival});
  if (prob >= 1) return true;
  if (sampler.next() >= prob) return false;
  particle.power /= prob;
  return true;
}

bool PhotonTracer::scatter(Particle& particle, const SurfacePoint& at,
                           const DirectionSampler& directions, bool by_importance,
                           Sampler& sampler) const {
  const std::optional<DirectionSample> s = directions.sample(sampler);
  if (!s) return false;
  const float correction = camera_ ? 1.0f
                                   : adjoint_correction(directions.resolved().frame, at.ng,
                                                        -particle.ray.direction, s->wi);
  particle.medium = medium_beyond(at, s->wi, particle.medium);
  particle.ray = scene_.spawn_ray(at, s->wi);
  if (s->straight) {  // through a pane, as next-event estimation sees it: no scattering event
    particle.power *= s->weight;
    return !is_black(particle.power);
  }
  return go_on(particle, particle.power * s->weight * correction, camera_ ? sqr(s->eta) : 1.0f,
               by_importance, sampler);
}

// Roulette keeps the power of the survivors, so particles of one start stay about equal; what
// refraction makes of radiance does not count.
bool PhotonTracer::go_on(Particle& particle, const Color& power, float eta_scale,
                         bool by_importance, Sampler& sampler) const {
  const float survival_prob =
      std::min(1.0f, eta_scale * luminance(power) / luminance(particle.power));
  ++particle.depth;
  particle.power = power;
  if (!(survival_prob > 0)) return false;
  if (by_importance || static_cast<int>(particle.depth) <= options_.rr_depth) return true;
  if (sampler.next() >= survival_prob) return false;
  particle.power /= survival_prob;
  return true;
}

}  // namespace waylight
