#pragma once
// What a cache knows of light in media, prepared for lookup at points and along rays.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "libguide/cache/medium_cache_view.h"
#include "libguide/directional/vmf_convolution.h"
#include "libguide/math/octahedral.h"
#include "libguide/medium/medium.h"
#include "libguide/spatial/leaf_walk.h"

namespace waylight {

// The directions in which a ray may look at a cell, in bins of about 13 degrees: flights ask every
// cell along them for what it scatters, and a table is ten times as fast as two convolutions. A bin
// has the value at its centre; it tells where flights end more often, which biases nothing.
struct ScatteredBins {
  static constexpr int kSide = 16, kCount = kSide * kSide;

  static int of(const Vec3& w) {
    const Vec2 p = direction_to_octahedral(w);
    return bin(p.y()) * kSide + bin(p.x());
  }
  static Vec3 centre(int i) {
    const auto at = [](int k) { return (2 * k + 1) / float(kSide) - 1; };
    return octahedral_to_direction({at(i % kSide), at(i / kSide)});
  }

 private:
  static int bin(float v) {
    return std::clamp(static_cast<int>((v + 1) * (0.5f * kSide)), 0, kSide - 1);
  }
};

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
  // int f(w, w') L(x, w') dw' of the indirect light.
  float scattered_indirect(const Vec3& w) const {
    return indirect_fluence_ * scattered_indirect_.pdf(w);
  }
  // The same of all light, for each of the ScatteredBins; negative where it is not known.
  std::array<float, ScatteredBins::kCount> scattered(const PhaseLobes& phase) const;

 private:
  VmfMixture indirect_, direct_;
  VmfConvolution scattered_indirect_;
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
    return guides_[number(medium, cell)];
  }
  // int f(w, w') L(x, w') dw' of all light, `bin` that of w; negative where the cell is not known.
  float scattered(int medium, uint32_t cell, int bin) const {
    return scattered_[bin * guides_.size() + number(medium, cell)];
  }

 private:
  size_t number(int medium, uint32_t cell) const {
    return phase_of_medium_[medium] * cells_ + cell;
  }

  std::span<const CacheNode> nodes_;
  size_t cells_ = 0;
  std::vector<int> phase_of_medium_;
  std::vector<PhaseLobes> phases_;
  std::vector<MediumGuide> guides_;  // phase by phase, cell by cell
  std::vector<float> scattered_;     // bin by bin, as guides_: a ray stays within one bin
};

}  // namespace waylight
