#pragma once
// The BSDF at one shading point: what `resolve` makes of a material.

#include <array>
#include <optional>
#include <span>

#include "libguide/bsdf/bsdf_sample.h"
#include "libguide/bsdf/choice.h"
#include "libguide/bsdf/lobe.h"
#include "libguide/bsdf/material.h"
#include "libguide/math/frame.h"

namespace waylight {

// A weighted sum of at most four lobes (four only under nested blends), with the contract of
// bsdf_sample.h. Directions are local to the frame that `resolve` returns beside it. Of several
// lobes one is chosen by its weight times the luminance of its mean_reflectance().
class Bsdf {
 public:
  static constexpr int kMaxLobes = 4;

  Color eval(const Vec3& wo, const Vec3& wi) const;
  std::optional<BsdfSample> sample(const Vec3& wo, float u, const Vec2& u2) const;
  float pdf(const Vec3& wo, const Vec3& wi) const;
  EvalPdf evaluate(const Vec3& wo, const Vec3& wi) const;  // eval and pdf for the price of one
  float delta_prob(const Vec3& wo) const;
  std::optional<BsdfSample> sample_delta(const Vec3& wo, float u) const;
  Color mean_reflectance() const;
  Color straight_transmission(const Vec3& wo) const;  // what goes through on a straight line

  bool has_smooth() const;           // some lobe has a density
  bool smooth_transmissive() const;  // some lobe with a density sends light to the other side
  // How the smooth part divides light that is equal on both sides, for wo; rough.
  SideShares side_shares(const Vec3& wo) const;
  // n(side of wi) / n(side of wo) for a direction of the smooth part; 1 on the side of wo.
  float relative_eta(const Vec3& wo, const Vec3& wi) const;
  // A concrete lobe spares the copy of a variant. A weight of zero adds nothing.
  template <typename L>
  void add(const L& lobe, float weight) {
    if (!(weight > 0)) return;
    lobes_[next()] = lobe;
    finish(weight);
  }
  void scale(float factor);  // of all weights
  int count() const { return count_; }

 private:
  struct Choice;

  int next() const;           // index of a free slot; an error when there is none
  void finish(float weight);  // counts the lobe just stored there
  Choice choose(const Vec3& wo) const;
  EvalPdf evaluate(const Choice& choice, const Vec3& wo, const Vec3& wi) const;

  std::array<Lobe, kMaxLobes> lobes_;
  std::array<float, kMaxLobes> weights_;     // weights of a blend; they sum to at most 1
  std::array<float, kMaxLobes> importance_;  // set where there are two lobes or more
  int count_ = 0;
};

// Where a material is looked up. `dpdu`, `dpdv` are needed by bump and normal maps and anisotropy.
struct ShadingPoint {
  Vec2 uv = Vec2::Zero();
  Vec3 ng = Vec3::UnitZ(), ns = Vec3::UnitZ();  // same side
  Vec3 dpdu = Vec3::UnitX(), dpdv = Vec3::UnitY();
};

struct ResolvedBsdf {
  Bsdf bsdf;
  Frame frame;  // shading frame: s along dpdu; flipped towards wo where the material is two-sided
};

// wo: unit, world space, away from the surface. Walks the wrappers (two-sided, mask, blend, bump,
// normal map) and evaluates the textures once. `null` parts are left out: they are `opacity`, and
// the weights are those given that the ray met the surface.
// wo lies on the same side of the frame as of ng: where shading, bump or normal map would put it on
// the other, the normal is bent just so far that it does not. Parts of a blend share one frame,
// the weighted mean of theirs. Behind a two-sided part, one-sided parts beside it are black.
ResolvedBsdf resolve(std::span<const Material> materials, int material, const ShadingPoint& point,
                     const Vec3& wo, TransportMode mode);

// The same with every texture at its mean, uv and curvature ignored: for fitting. Local frame,
// front.
Bsdf resolve_mean(std::span<const Material> materials, int material);

// Refractive indices whose ratio differs from 1 by less are one medium: nothing is refracted.
inline constexpr float kMatchedEta = 1e-4f;

// Probability that a ray meets the surface at all: 0 for `null`, the opacity of a mask, 1
// otherwise.
float opacity(std::span<const Material> materials, int material, const Vec2& uv);
// Whether light can go straight through anywhere: where opacity is below 1, and through panes.
bool may_be_transparent(std::span<const Material> materials, int material);

}  // namespace waylight
