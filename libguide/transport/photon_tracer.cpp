#include "libguide/transport/photon_tracer.h"

namespace waylight {
namespace {

constexpr int kMaxCrossings = 1000;  // transparent surfaces in a row before a particle is given up

constexpr float kMaxCorrection = 10;

std::optional<BsdfSample> sample_bsdf(const Bsdf& bsdf, const Vec3& wo, Sampler& sampler) {
  const float delta_prob = bsdf.delta_prob(wo), u = sampler.next(), u_lobe = sampler.next();
  const Vec2 u2 = sampler.next_2d();
  const bool delta = u < delta_prob;
  std::optional<BsdfSample> s = delta ? bsdf.sample_delta(wo, u_lobe) : bsdf.sample(wo, u_lobe, u2);
  if (s) s->weight /= delta ? delta_prob : 1 - delta_prob;
  return s;
}

}  // namespace

void PhotonTracer::trace(Sampler& sampler, std::vector<Photon>* photons,
                         PhotonCounts* counts) const {
  ++counts->emitted;
  const float u = sampler.next();
  const Vec2 u_position = sampler.next_2d();
  const std::optional<EmissionSample> emission =
      scene_.sample_emission(u, u_position, sampler.next_2d());
  if (!emission || is_black(emission->power)) {
    ++counts->absorbed;
    return;
  }
  Particle particle{emission->ray, emission->power * power_scale_};
  for (;;) {
    const std::optional<SurfacePoint> at = next_surface(particle, sampler);
    if (!at) {
      ++counts->left_scene;
      return;
    }
    const ResolvedBsdf resolved =
        scene_.bsdf(*at, -particle.ray.direction, TransportMode::importance);
    if (resolved.bsdf.has_smooth() && !is_black(resolved.bsdf.mean_reflectance()))
      store(particle, *at, photons, counts);
    if (static_cast<int>(particle.depth) + 1 >= max_depth_) {
      ++counts->too_deep;
      return;
    }
    if (!scatter(particle, *at, resolved, sampler)) {
      ++counts->absorbed;
      return;
    }
  }
}

std::optional<SurfacePoint> PhotonTracer::next_surface(Particle& particle, Sampler& sampler) const {
  for (int i = 0; i < kMaxCrossings; ++i) {
    const std::optional<SurfacePoint> at = scene_.intersect(particle.ray);
    if (!at) return std::nullopt;
    const float opacity = scene_.opacity(*at);
    if (opacity >= 1 || (opacity > 0 && sampler.next() < opacity)) return at;
    particle.ray = scene_.spawn_ray(*at, particle.ray.direction);
  }
  return std::nullopt;
}

void PhotonTracer::store(const Particle& particle, const SurfacePoint& at,
                         std::vector<Photon>* photons, PhotonCounts* counts) const {
  if (!is_finite(particle.power) || !at.p.allFinite()) {
    ++counts->invalid;
    return;
  }
  const Vec3 wi = -particle.ray.direction;
  const Vec3 normal = at.ns.dot(wi) < 0 ? Vec3(-at.ns) : at.ns;
  photons->push_back({at.p, wi, normal, particle.power, particle.depth});
  ++counts->stored;
}

// Scatters with the adjoint BSDF: f |cos ns(out)| becomes f |cos ng(out)| |cos ns(in)| / |cos
// ng(in)| where shading and geometric normals differ [Veach 1997, 5.3]. Roulette keeps the power of
// the survivors, so photons of one emitter stay about equal. The correction is capped: photons only
// train caches, and one photon at a grazing angle must not capture a cell.
bool PhotonTracer::scatter(Particle& particle, const SurfacePoint& at, const ResolvedBsdf& resolved,
                           Sampler& sampler) const {
  const Vec3 in = -particle.ray.direction;
  const Vec3 in_local = resolved.frame.to_local(in);
  const std::optional<BsdfSample> s = sample_bsdf(resolved.bsdf, in_local, sampler);
  if (!s) return false;
  const Vec3 out = resolved.frame.to_world(s->wi);
  const float flipped = resolved.frame.n.dot(at.ng) >= 0 ? 1.0f : -1.0f;
  const float ng_in = in.dot(at.ng) * flipped, ng_out = out.dot(at.ng) * flipped;
  if (ng_in * in_local.z() <= 0 || ng_out * s->wi.z() <= 0) return false;
  const float correction = ng_out * in_local.z() / (ng_in * s->wi.z());
  const Color power = particle.power * s->weight * std::min(std::abs(correction), kMaxCorrection);
  const float survival_prob = std::min(1.0f, luminance(power) / luminance(particle.power));
  ++particle.depth;
  particle.power = power;
  particle.ray = scene_.spawn_ray(at, out);
  if (!(survival_prob > 0)) return false;
  if (static_cast<int>(particle.depth) <= rr_depth_) return true;
  if (sampler.next() >= survival_prob) return false;
  particle.power /= survival_prob;
  return true;
}

}  // namespace waylight
