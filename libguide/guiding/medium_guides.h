#pragma once
// What a cache knows of light in media, prepared for lookup at points and along rays.

#include <span>
#include <vector>

#include "libguide/cache/medium_cache_view.h"
#include "libguide/directional/vmf_convolution.h"
#include "libguide/medium/medium.h"
#include "libguide/spatial/leaf_walk.h"

namespace waylight {

// One cell, in media of one phase function. Luminances; `w` points away from the camera side, along
// the path.
class MediumGuide {
 public:
  MediumGuide(const MediumCacheView& cache, const MediumCell& cell, const PhaseLobes& phase);

  const VmfMixture& indirect() const { return indirect_; }
  bool known() const { return known_; }   // whether the indirect light is
  float trust() const { return trust_; }  // see guiding_trust()

  // L(x, w), radiance that comes from direction w: indirect light and, where asked for, that
  // straight from emitters.
  float incident(const Vec3& w, bool with_direct) const {
    const float indirect = indirect_fluence_ * indirect_.pdf(w);
    return with_direct ? indirect + direct_fluence_ * direct_.pdf(w) : indirect;
  }
  // int f(w, w') L(x, w') dw': of the indirect light alone, and of all.
  float scattered_indirect(const Vec3& w) const {
    return indirect_fluence_ * scattered_indirect_.pdf(w);
  }
  float scattered(const Vec3& w) const {
    return scattered_indirect(w) + direct_fluence_ * scattered_direct_.pdf(w);
  }

 private:
  VmfMixture indirect_, direct_;
  VmfConvolution scattered_indirect_, scattered_direct_;
  float indirect_fluence_, direct_fluence_;
  bool known_;
  float trust_;
};

class MediumGuides {
 public:
  MediumGuides() = default;
  // cache must outlive this; media: of the scene.
  MediumGuides(const MediumCacheView& cache, std::span<const Medium> media);

  bool empty() const { return guides_.empty(); }
  const PhaseLobes& phase(int medium) const { return phases_[phase_of_medium_[medium]]; }
  const MediumGuide& at(int medium, const Vec3& p) const {
    return guide(medium, find_leaf(nodes_, p, Vec3::UnitZ()));
  }
  LeafWalk walk(const Ray& ray, float t_max) const { return LeafWalk(nodes_, ray, t_max); }
  const MediumGuide& guide(int medium, uint32_t cell) const {
    return guides_[phase_of_medium_[medium] * cells_ + cell];
  }

 private:
  std::span<const CacheNode> nodes_;
  size_t cells_ = 0;
  std::vector<int> phase_of_medium_;
  std::vector<PhaseLobes> phases_;
  std::vector<MediumGuide> guides_;  // phase by phase, cell by cell
};

}  // namespace waylight
