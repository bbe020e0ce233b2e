#include "libguide/guiding/direction_sampler.h"

#include "libguide/directional/frame_carry.h"
#include "libguide/math/warp.h"

namespace waylight {

DirectionSampler::DirectionSampler(const Scene& scene, const GuidingCaches& caches,
                                   DirectionGuide guide, float guiding_prob, const SurfacePoint& at,
                                   const Vec3& wo)
    : resolved_(scene.bsdf(at, wo, TransportMode::radiance)),
      ng_(at.ng),
      wo_local_(resolved_.frame.to_local(wo)),
      ng_side_(resolved_.frame.n.dot(at.ng) >= 0 ? 1.0f : -1.0f),
      has_smooth_(resolved_.bsdf.has_smooth()),
      delta_prob_(resolved_.bsdf.delta_prob(wo_local_)),
      guiding_prob_(guiding_prob) {
  if (guide == DirectionGuide::none || !has_smooth_ || delta_prob_ >= 1 || wo_local_.z() <= 0 ||
      resolved_.bsdf.smooth_transmissive())
    guiding_prob_ = 0;
  if (guiding_prob_ > 0) prepare_guide(caches, guide, at, wo);
}

void DirectionSampler::prepare_guide(const GuidingCaches& caches, DirectionGuide guide,
                                     const SurfacePoint& at, const Vec3& wo) {
  const Vec3 normal = at.ns.dot(wo) < 0 ? Vec3(-at.ns) : at.ns;
  const CacheCell* cell = caches.guide().query(at.p, normal);
  if (!cell) {
    guiding_prob_ = 0;
    return;
  }
  cell_frame_ = Frame(cell->normal);
  light_ = caches.guide().mixture(*cell);
  if (light_.count() == 0 ||
      (guide == DirectionGuide::product && !prepare_product(caches, at.material)))
    guiding_prob_ = 0;
}

// False when the fitted BSDF and the light do not overlap: BSDF sampling is left alone then.
// A material without fit keeps the light's mixture as its guide.
bool DirectionSampler::prepare_product(const GuidingCaches& caches, int material) {
  const std::span<const GaussianComponent> lobes = caches.brdf_lobes(material, wo_local_.z());
  if (lobes.empty()) return true;
  // The fit's frame: z the shading normal, x the horizontal part of wo.
  const Frame& shading = resolved_.frame;
  const Vec3 horizontal = shading.to_world({wo_local_.x(), wo_local_.y(), 0});
  const Frame fit = Frame::from_tangent(shading.n, horizontal);
  Mat3 rotation;
  rotation.col(0) = cell_frame_.to_local(fit.s);
  rotation.col(1) = cell_frame_.to_local(fit.t);
  rotation.col(2) = cell_frame_.to_local(fit.n);
  std::array<GaussianComponent, GaussianMixture::kMaxComponents> carried;
  for (size_t i = 0; i < lobes.size(); ++i) carried[i] = carry(lobes[i], rotation);
  brdf_ = GaussianMixture(std::span<const GaussianComponent>(carried.data(), lobes.size()));
  product_.emplace(brdf_, light_);
  return product_->valid();
}

bool DirectionSampler::same_side(const Vec3& wi, const Vec3& wi_local) const {
  return wi.dot(ng_) * wi_local.z() * ng_side_ > 0;
}

Color DirectionSampler::eval(const Vec3& wi) const {
  const Vec3 local = resolved_.frame.to_local(wi);
  return same_side(wi, local) ? resolved_.bsdf.eval(wo_local_, local) : Color(Color::Zero());
}

std::optional<DirectionSample> DirectionSampler::sample(float u, float u_lobe,
                                                        const Vec2& u2) const {
  if (u < delta_prob_) return sample_delta(u / delta_prob_);
  if (!has_smooth_) return std::nullopt;
  const float rescaled = (u - delta_prob_) / (1 - delta_prob_);
  return sample_smooth(std::min(rescaled, kOneMinusEpsilon), u_lobe, u2);
}

std::optional<DirectionSample> DirectionSampler::sample_delta(float u) const {
  const std::optional<BsdfSample> s = resolved_.bsdf.sample_delta(wo_local_, u);
  if (!s) return std::nullopt;
  const Color weight = s->weight / delta_prob_;
  const Vec3 wi = resolved_.frame.to_world(s->wi);
  if (!same_side(wi, s->wi)) return std::nullopt;
  return DirectionSample{wi, weight, 0, true, s->eta, weight};
}

std::optional<DirectionSample> DirectionSampler::sample_smooth(float u, float u_lobe,
                                                               const Vec2& u2) const {
  Vec3 wi;
  float eta = 1;
  if (u < guiding_prob_) {
    const std::optional<Vec3> guided = sample_guide(u_lobe, u2);
    if (!guided) return std::nullopt;
    wi = *guided;
  } else {
    const std::optional<BsdfSample> s = resolved_.bsdf.sample(wo_local_, u_lobe, u2);
    if (!s) return std::nullopt;
    wi = resolved_.frame.to_world(s->wi);
    eta = s->eta;
  }
  const Vec3 local = resolved_.frame.to_local(wi);
  if (!same_side(wi, local)) return std::nullopt;
  const Color value = resolved_.bsdf.eval(wo_local_, local);
  const float bsdf_pdf = (1 - delta_prob_) * resolved_.bsdf.pdf(wo_local_, local);
  const float density = guiding_prob_ > 0 ? (1 - guiding_prob_) * bsdf_pdf +
                                                guiding_prob_ * (1 - delta_prob_) * guide_pdf(wi)
                                          : bsdf_pdf;
  if (!(density > 0) || is_black(value)) return std::nullopt;
  return DirectionSample{wi,      value / density,
                         density, false,
                         eta,     bsdf_pdf > 0 ? Color(value / bsdf_pdf) : Color(Color::Ones())};
}

float DirectionSampler::pdf(const Vec3& wi) const {
  const Vec3 local = resolved_.frame.to_local(wi);
  if (!same_side(wi, local)) return 0;
  const float bsdf_pdf = resolved_.bsdf.pdf(wo_local_, local);
  if (guiding_prob_ <= 0) return (1 - delta_prob_) * bsdf_pdf;
  return (1 - delta_prob_) * ((1 - guiding_prob_) * bsdf_pdf + guiding_prob_ * guide_pdf(wi));
}

std::optional<Vec3> DirectionSampler::sample_guide(float u, const Vec2& u2) const {
  const std::optional<Vec2> y = product_ ? product_->sample(u, u2) : light_.sample(u, u2);
  if (!y) return std::nullopt;
  return cell_frame_.to_world(disk_to_direction(*y));
}

float DirectionSampler::guide_pdf(const Vec3& wi) const {
  const Vec2 y = direction_to_disk(cell_frame_.to_local(wi));
  return (product_ ? product_->pdf(y) : light_.pdf(y)) / kSteradianPerDiskArea;
}

}  // namespace waylight
