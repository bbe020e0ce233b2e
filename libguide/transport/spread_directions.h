#pragma once
// The directional decision of a path that trains: that of a DirectionSampler, spread by a cosine.

#include "libguide/guiding/direction_sampler.h"

namespace waylight {

// At a surface that is not purely specular
//   p(wi) = c cos / pi + (1 - c) p_path(wi),   c = 1/2,
// half as much on either side where light scatters through. cos / p is then at most 2 pi (4 pi),
// however narrow the BSDF and however wrong a cache: no sample of Li cos / p is large for its pdf.
// Directions in which the BSDF scatters nothing are sampled too, with weight 0: light comes from
// them all the same.
class SpreadDirections {
 public:
  // path must outlive this.
  SpreadDirections(const DirectionSampler& path, const Vec3& wo);

  bool has_smooth() const { return path_.has_smooth(); }
  EvalPdf evaluate(const Vec3& wi) const;  // f |cos| and p
  std::optional<DirectionSample> sample(Sampler& sampler) const;
  // Probability of a direction that is not of a delta lobe; p / smooth_prob() is the density then.
  float smooth_prob() const { return smooth_prob_; }

 private:
  Vec3 sample_cosine(float u, const Vec2& u2) const;
  float cosine_pdf(const Vec3& wi) const;
  float spread(const Vec3& wi, float path_pdf) const;

  const DirectionSampler& path_;
  float side_;  // of wo in the shading frame
  bool both_sides_;
  float smooth_prob_;
};

}  // namespace waylight
