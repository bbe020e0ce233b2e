#include "libguide/guiding/direction_sampler.h"

#include "libguide/directional/frame_carry.h"
#include "libguide/math/warp.h"

namespace waylight {
namespace {

constexpr float kMinMeanCosine = 0.05f;

// Mean of cos = 1 - |y|^2 over lobes on the disk, about the normal that their frame stands on.
float mean_cosine(std::span<const GaussianComponent> lobes) {
  float cosine = 1;
  for (const GaussianComponent& g : lobes)
    cosine -= g.weight * (sqr(g.mean_x) + sqr(g.mean_y) + g.cov_xx + g.cov_yy);
  return std::max(cosine, kMinMeanCosine);
}

}  // namespace

DirectionSampler::DirectionSampler(const Scene& scene, const GuidingCaches& caches,
                                   DirectionGuide guide, float guiding_prob, const SurfacePoint& at,
                                   const Vec3& wo, TransportMode mode)
    : resolved_(scene.bsdf(at, wo, mode)),
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
  guiding_prob_ *= guiding_trust(*cell);
  irradiance_ = cell->irradiance;
  cell_frame_ = Frame(cell->normal);
  light_ = caches.guide().mixture(*cell);
  if (light_.count() == 0 || (guide == DirectionGuide::product && !prepare_product(caches, at)))
    guiding_prob_ = 0;
}

// False when the fitted BSDF and the light do not overlap: BSDF sampling is left alone then.
// A material without fit keeps the light's mixture as its guide.
bool DirectionSampler::prepare_product(const GuidingCaches& caches, const SurfacePoint& at) {
  const FittedLobe lobe = caches.brdf_lobe(at.material, ng_side_ < 0, wo_local_, at.uv);
  if (lobe.components.empty()) return true;
  const Frame& shading = resolved_.frame;
  Mat3 to_cell;
  to_cell << cell_frame_.to_local(shading.s), cell_frame_.to_local(shading.t),
      cell_frame_.to_local(shading.n);
  brdf_ = GaussianMixture(lobe.components).carried(to_cell * lobe.to_shading);
  product_.emplace(brdf_, light_);
  reflected_per_irradiance_ = product_->z() / (2 * mean_cosine(lobe.components));
  return product_->valid();
}

bool DirectionSampler::same_side(const Vec3& wi, const Vec3& wi_local) const {
  return wi.dot(ng_) * wi_local.z() * ng_side_ > 0;
}

EvalPdf DirectionSampler::evaluate(const Vec3& wi) const {
  const Vec3 local = resolved_.frame.to_local(wi);
  if (!same_side(wi, local)) return {};
  const EvalPdf e = resolved_.bsdf.evaluate(wo_local_, local);
  if (is_black(e.value)) return {};
  return {e.value, density(e.pdf, wi)};
}

float DirectionSampler::density(float bsdf_pdf, const Vec3& wi) const {
  const float guided = guiding_prob_ > 0 ? guiding_prob_ * guide_pdf(wi) : 0.0f;
  return (1 - delta_prob_) * ((1 - guiding_prob_) * bsdf_pdf + guided);
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
  if (u >= guiding_prob_) {
    const std::optional<BsdfSample> s = resolved_.bsdf.sample(wo_local_, u_lobe, u2);
    if (!s) return std::nullopt;
    return weighted(resolved_.frame.to_world(s->wi), s->wi, {s->weight * s->pdf, s->pdf}, s->eta);
  }
  const std::optional<Vec3> wi = sample_guide(u_lobe, u2);
  if (!wi) return std::nullopt;
  const Vec3 local = resolved_.frame.to_local(*wi);
  return weighted(*wi, local, resolved_.bsdf.evaluate(wo_local_, local), 1);
}

// bsdf: value and density of BSDF sampling for the direction.
std::optional<DirectionSample> DirectionSampler::weighted(const Vec3& wi, const Vec3& local,
                                                          const EvalPdf& bsdf, float eta) const {
  if (!same_side(wi, local)) return std::nullopt;
  const float pdf = density(bsdf.pdf, wi);
  if (!(pdf > 0) || is_black(bsdf.value)) return std::nullopt;
  const float bsdf_pdf = (1 - delta_prob_) * bsdf.pdf;
  const Color bsdf_weight = bsdf_pdf > 0 ? Color(bsdf.value / bsdf_pdf) : Color(Color::Ones());
  return DirectionSample{wi, bsdf.value / pdf, pdf, false, eta, bsdf_weight};
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
