#include "libguide/guiding/direction_sampler.h"

namespace waylight {
namespace {

// Of either side's chance where both are known: irradiance tells little of what a lobe meets.
constexpr float kMinSideProb = 0.1f;
// A guide for less than this share of the BSDF is not worth its price.
constexpr float kMinKnown = 0.02f;

void open(std::optional<CellGuide>& guide, const GuideCacheView& cache, const CacheCell* cell) {
  if (!cell) return;
  guide.emplace(cache, *cell);
  if (!guide->valid()) guide.reset();
}

bool asks_cache(const DirectionOptions& options, const GuidingCaches& caches, int material) {
  return (options.guide != DirectionGuide::none || options.estimates) && caches.guided() &&
         caches.may_guide(material);
}

// The shading normal on the side of wo.
Vec3 facing(const SurfacePoint& at, const Vec3& wo) {
  return at.ns.dot(wo) < 0 ? Vec3(-at.ns) : at.ns;
}

float irradiance(const std::optional<CellGuide>& guide) {
  return guide ? guide->cell().irradiance : 0;
}

}  // namespace

DirectionSampler::DirectionSampler(const Scene& scene, const GuidingCaches& caches,
                                   const DirectionOptions& options, const SurfacePoint& at,
                                   const Vec3& wo, TransportMode mode)
    : options_(options),
      here_(asks_cache(options, caches, at.material) ? caches.locate(at.p, facing(at, wo)) : 0),
      resolved_(scene.bsdf(at, wo, mode)),
      ng_(at.ng),
      wo_local_(resolved_.frame.to_local(wo)),
      ng_side_(resolved_.frame.n.dot(at.ng) >= 0 ? 1.0f : -1.0f),
      has_smooth_(resolved_.bsdf.has_smooth()),
      delta_prob_(resolved_.bsdf.delta_prob(wo_local_)) {
  if (!asks_cache(options, caches, at.material) || !has_smooth_ || !(delta_prob_ < 1)) return;
  if (options.guide == DirectionGuide::none)
    estimate(caches, at, facing(at, wo));
  else
    prepare_guide(caches, at, facing(at, wo));
}

// The light that the cells know of, without a guide.
void DirectionSampler::estimate(const GuidingCaches& caches, const SurfacePoint& at,
                                const Vec3& normal) {
  const GuideCacheView& cache = caches.guide();
  const CacheCell* near = cache.guide_at(here_, at.p, normal);
  if (!resolved_.bsdf.smooth_transmissive()) {
    irradiance_ = near && wo_local_.z() > 0 ? near->irradiance : 0;
    return;
  }
  const CacheCell* far = cache.guide_at(caches.locate(at.p, -normal), at.p, -normal);
  const SideShares shares = resolved_.bsdf.side_shares(wo_local_);
  if (near && far)
    irradiance_ = shares.reflected * near->irradiance + shares.transmitted * far->irradiance;
}

void DirectionSampler::prepare_guide(const GuidingCaches& caches, const SurfacePoint& at,
                                     const Vec3& normal) {
  if (resolved_.bsdf.smooth_transmissive()) {
    known_ = prepare_sides(caches, at, normal);
    choose(caches, cell());
  } else if (wo_local_.z() > 0) {
    const CacheCell* here = caches.guide().guide_at(here_, at.p, normal);
    irradiance_ = here ? here->irradiance : 0;
    open(near_, caches.guide(), choose(caches, here));
    if (near_ &&
        (options_.guide == DirectionGuide::product || options_.guide == DirectionGuide::mixture))
      known_ = prepare_fit(caches, at);
    if (known_ < kMinKnown) near_.reset();
  }
  if (!cell()) return;
  guided_ = known_ * guiding_trust(*cell());
  bsdf_share_ = 1 - guided_ * (1 - options_.bsdf_share);
}

// What was learned of the cell holds from now on. Null where that is to leave it to the BSDF.
const CacheCell* DirectionSampler::choose(const GuidingCaches& caches, const CacheCell* cell) {
  if (!cell || !options_.learned) return cell;
  const CellChoice choice = caches.choice(*cell, {options_.guide, options_.bsdf_share});
  options_.guide = choice.guide;
  if (options_.light_alone && choice.guide == DirectionGuide::product)
    options_.guide = DirectionGuide::illumination;
  options_.bsdf_share = choice.bsdf_share;
  return choice.guide == DirectionGuide::none ? nullptr : cell;
}

// The side is chosen by what it should add: the BSDF's share of reflection or transmission times
// the cell's irradiance. A side without cell is left to BSDF sampling. Returns the share of the
// BSDF on the sides that are known.
float DirectionSampler::prepare_sides(const GuidingCaches& caches, const SurfacePoint& at,
                                      const Vec3& normal) {
  const uint32_t there = caches.locate(at.p, -normal);
  open(near_, caches.guide(), caches.guide().guide_at(here_, at.p, normal));
  open(far_, caches.guide(), caches.guide().guide_at(there, at.p, -normal));
  const SideShares shares = resolved_.bsdf.side_shares(wo_local_);
  const float near = shares.reflected * irradiance(near_);
  const float far = shares.transmitted * irradiance(far_);
  if (near_ && far_) {
    near_prob_ = near + far > 0 ? near / (near + far) : 0.5f;
    near_prob_ = std::clamp(near_prob_, kMinSideProb, 1 - kMinSideProb);
    irradiance_ = near + far;
    return 1;
  }
  near_prob_ = near_ ? 1.0f : 0.0f;
  const float total = shares.reflected + shares.transmitted;
  return total > 0 ? (near_ ? shares.reflected : shares.transmitted) / total : 0;
}

// The share of the BSDF that the guide is for. A material without fit keeps the light's mixture as
// its guide, and so does a uniform one, whose product it is.
float DirectionSampler::prepare_fit(const GuidingCaches& caches, const SurfacePoint& at) {
  const bool product = options_.guide == DirectionGuide::product, from_behind = ng_side_ < 0;
  if (product && caches.uniform(at.material, from_behind)) return 1;
  const FittedLobe fit = caches.brdf_lobe(at.material, from_behind, wo_local_, at.uv);
  if (!fit.lobe) return 1;
  Mat3 to_world;
  to_world << resolved_.frame.s, resolved_.frame.t, resolved_.frame.n;
  to_world *= fit.to_shading;
  if (!product) {
    near_->mix(fit.lobe->mixture, to_world);
    return 1;
  }
  const float resolved = near_->multiply(fit.lobe->mixture, to_world);
  reflected_per_irradiance_ = near_->product_z() / (2 * fit.lobe->mean_cosine);
  return resolved;
}

bool DirectionSampler::same_side(const Vec3& wi, const Vec3& wi_local) const {
  return wi.dot(ng_) * wi_local.z() * ng_side_ > 0;
}

EvalPdf DirectionSampler::evaluate(const Vec3& wi) const {
  const Vec3 local = resolved_.frame.to_local(wi);
  if (!same_side(wi, local)) return {};
  const EvalPdf e = resolved_.bsdf.evaluate(wo_local_, local);
  if (is_black(e.value)) return {};
  return {e.value, density(e.pdf, guide_pdf(wi))};
}

float DirectionSampler::density(float bsdf_pdf, float guide_pdf) const {
  return (1 - delta_prob_) * (bsdf_share_ * bsdf_pdf + (1 - bsdf_share_) * guide_pdf);
}

std::optional<DirectionSample> DirectionSampler::sample(Sampler& sampler) const {
  const float u = sampler.next(), u_lobe = sampler.next();
  const Vec2 u2 = sampler.next_2d();
  if (u < delta_prob_) return sample_delta(u / delta_prob_);
  if (!has_smooth_) return std::nullopt;
  const float rescaled = std::min((u - delta_prob_) / (1 - delta_prob_), kOneMinusEpsilon);
  if (guided() && options_.guide == DirectionGuide::resampled) return resample(rescaled, sampler);
  const std::optional<Candidate> c = sample_smooth(rescaled, u_lobe, u2);
  if (!c) return std::nullopt;
  return finish(*c);
}

std::optional<DirectionSample> DirectionSampler::sample_delta(float u) const {
  const std::optional<BsdfSample> s = resolved_.bsdf.sample_delta(wo_local_, u);
  if (!s) return std::nullopt;
  const Color weight = s->weight / delta_prob_;
  const Vec3 wi = resolved_.frame.to_world(s->wi);
  if (!same_side(wi, s->wi)) return std::nullopt;
  return DirectionSample{wi, weight, 0, true, s->eta, weight, 0, 0, 0, s->straight};
}

std::optional<DirectionSampler::Candidate> DirectionSampler::sample_smooth(float u, float u_lobe,
                                                                           const Vec2& u2) const {
  if (u >= 1 - bsdf_share_) {
    const std::optional<BsdfSample> s = resolved_.bsdf.sample(wo_local_, u_lobe, u2);
    if (!s) return std::nullopt;
    return candidate(resolved_.frame.to_world(s->wi), s->wi, {s->weight * s->pdf, s->pdf}, s->eta);
  }
  const std::optional<Vec3> wi = sample_guide(u_lobe, u2);
  if (!wi) return std::nullopt;
  const Vec3 local = resolved_.frame.to_local(*wi);
  return candidate(*wi, local, resolved_.bsdf.evaluate(wo_local_, local), 0);
}

// eta: 0 where it is not known.
std::optional<DirectionSampler::Candidate> DirectionSampler::candidate(const Vec3& wi,
                                                                       const Vec3& local,
                                                                       const EvalPdf& bsdf,
                                                                       float eta) const {
  if (!same_side(wi, local) || is_black(bsdf.value)) return std::nullopt;
  const float guide = guided() ? guide_pdf(wi) : 0.0f, pdf = density(bsdf.pdf, guide);
  if (!(pdf > 0)) return std::nullopt;
  if (eta == 0) eta = resolved_.bsdf.relative_eta(wo_local_, local);
  return Candidate{wi, bsdf, std::abs(local.z()), guide, pdf, eta};
}

DirectionSample DirectionSampler::finish(const Candidate& c) const {
  const float bsdf_pdf = (1 - delta_prob_) * c.bsdf.pdf;
  const Color bsdf_weight = bsdf_pdf > 0 ? Color(c.bsdf.value / bsdf_pdf) : Color(Color::Ones());
  const float guide_pdf = guided_ * c.guide_pdf + (1 - guided_) * c.bsdf.pdf;
  return {c.wi,        c.bsdf.value / c.pdf, c.pdf,     false,       c.eta,
          bsdf_weight, c.bsdf.pdf,           guide_pdf, light_pdf(c)};
}

std::optional<Vec3> DirectionSampler::sample_guide(float u, const Vec2& u2) const {
  if (u < near_prob_) return near_->sample(u / near_prob_, u2);
  return far_->sample((u - near_prob_) / (1 - near_prob_), u2);
}

float DirectionSampler::light_pdf(const Candidate& c) const {
  if (!options_.compares || !guided()) return 0;
  const float light = near_ && !far_ ? near_->light_pdf(c.wi) : c.guide_pdf;
  const float trust = guiding_trust(*cell());
  return trust * light + (1 - trust) * c.bsdf.pdf;
}

float DirectionSampler::guide_pdf(const Vec3& wi) const {
  const float near = near_ ? near_prob_ * near_->pdf(wi) : 0.0f;
  return far_ ? near + (1 - near_prob_) * far_->pdf(wi) : near;
}

}  // namespace waylight
