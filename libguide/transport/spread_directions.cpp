#include "libguide/transport/spread_directions.h"

#include "libguide/math/warp.h"

namespace waylight {
namespace {

constexpr float kCosineShare = 0.5f;

}  // namespace

SpreadDirections::SpreadDirections(const DirectionSampler& path, const Vec3& wo)
    : path_(path), both_sides_(path.resolved().bsdf.smooth_transmissive()) {
  const ResolvedBsdf& r = path.resolved();
  const Vec3 local = r.frame.to_local(wo);
  side_ = local.z() < 0 ? -1.0f : 1.0f;
  smooth_prob_ = has_smooth() ? 1 - (1 - kCosineShare) * r.bsdf.delta_prob(local) : 0.0f;
}

Vec3 SpreadDirections::sample_cosine(float u, const Vec2& u2) const {
  Vec3 wi = square_to_cosine_hemisphere(u2);
  wi.z() *= both_sides_ && u < 0.5f ? -side_ : side_;
  return path_.resolved().frame.to_world(wi);
}

float SpreadDirections::cosine_pdf(const Vec3& wi) const {
  const float z = side_ * wi.dot(path_.resolved().frame.n);
  return kInvPi * (both_sides_ ? 0.5f * std::abs(z) : std::max(z, 0.0f));
}

float SpreadDirections::spread(const Vec3& wi, float path_pdf) const {
  return kCosineShare * cosine_pdf(wi) + (1 - kCosineShare) * path_pdf;
}

EvalPdf SpreadDirections::evaluate(const Vec3& wi) const {
  if (!path_.same_side(wi)) return {};
  const EvalPdf f = path_.evaluate(wi);
  return {f.value, spread(wi, f.pdf)};
}

std::optional<DirectionSample> SpreadDirections::sample(Sampler& sampler) const {
  if (!has_smooth()) return path_.sample(sampler);
  const float u = sampler.next(), u_side = sampler.next();
  const Vec2 u2 = sampler.next_2d();
  if (u < kCosineShare) {
    DirectionSample s;
    s.wi = sample_cosine(u_side, u2);
    const EvalPdf f = evaluate(s.wi);
    if (!(f.pdf > 0)) return std::nullopt;
    s.weight = f.value / f.pdf, s.pdf = f.pdf;
    return s;
  }
  std::optional<DirectionSample> s = path_.sample(sampler);
  if (!s) return std::nullopt;
  const float pdf = spread(s->wi, s->pdf);
  s->weight *= s->is_delta ? 1 / (1 - kCosineShare) : s->pdf / pdf;
  if (!s->is_delta) s->pdf = pdf;
  return s;
}

}  // namespace waylight
