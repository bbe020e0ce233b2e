#pragma once
// The directional decision of one vertex in a medium.

#include "libguide/guiding/direction_sampler.h"

namespace waylight {

// The counterpart of DirectionSampler: the same questions, so that the path loop need not know
// where a vertex is. The albedo is not in it: the weight of the flight that ended here has it.
class PhaseSampler {
 public:
  PhaseSampler(const PhaseFunction& phase, const Vec3& wo) : phase_(phase), forward_(-wo) {}

  Color eval(const Vec3& wi) const { return evaluate(wi).value; }
  std::optional<DirectionSample> sample(Sampler& sampler) const;
  float pdf(const Vec3& wi) const { return evaluate(wi).pdf; }
  EvalPdf evaluate(const Vec3& wi) const;

  bool has_smooth() const { return true; }
  bool guided() const { return false; }
  float bsdf_share() const { return 1; }
  float reflected_estimate() const { return 0; }

 private:
  const PhaseFunction& phase_;
  Vec3 forward_;
};

}  // namespace waylight
