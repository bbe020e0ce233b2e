#pragma once
// What a cache knows of light in media, prepared for lookup at points and along rays.

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "libguide/cache/medium_cache_view.h"
#include "libguide/directional/focused_mixture.h"
#include "libguide/directional/vmf_convolution.h"
#include "libguide/guiding/flight_cells.h"
#include "libguide/math/octahedral.h"
#include "libguide/medium/medium.h"
#include "libguide/spatial/leaf_finder.h"
#include "libguide/spatial/leaf_walk.h"

namespace waylight {

// The directions in which a ray may look at a cell, in bins: flights ask every cell along them for
// what it scatters, and a table is ten times as fast as two convolutions. A bin has the value at
// its centre; it tells where flights end more often, which biases nothing. The tables of thousands
// of cells have to stay close to the processor, so bins are as fine as the phase function asks for:
// one where it is even, of about 26 degrees up to |g| = 1/2, else of about 13.
class ScatteredBins {
 public:
  explicit ScatteredBins(float mean_cosine)
      : side_(mean_cosine == 0                ? 1
              : std::abs(mean_cosine) <= 0.5f ? 8
                                              : 16) {}

  int count() const { return side_ * side_; }
  int of(const Vec3& w) const {
    const Vec2 p = direction_to_octahedral(w);
    return bin(p.y()) * side_ + bin(p.x());
  }
  Vec3 centre(int i) const {
    const auto at = [&](int k) { return static_cast<float>(2 * k + 1) / side_ - 1; };
    return octahedral_to_direction({at(i % side_), at(i / side_)});
  }

 private:
  int bin(float v) const {
    return std::clamp(static_cast<int>((v + 1) * 0.5f * side_), 0, side_ - 1);
  }

  int side_;
};

// One cell, in media of one phase function. Luminances; `w` points away from the camera side, along
// the path.
class MediumGuide {
 public:
  MediumGuide(const MediumCacheView& cache, uint32_t cell, const PhaseLobes& phase);

  const VmfMixture& indirect() const { return indirect_; }
  // The indirect light as lobes that point to places, where the cell knows of any.
  const std::optional<FocusedMixture>& focused() const { return focused_; }
  bool known() const { return known_; }   // whether the indirect light is
  float trust() const { return trust_; }  // see guiding_trust()
  // How narrow the phase function is beside the indirect light, in [0, 1]: the part of int f^2 dw
  // in its sum with int l^2 dw.
  float phase_narrowness() const { return phase_narrowness_; }

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
  // The same of light that comes as in `mixture`.
  float scattered_indirect(const VmfMixture& mixture, const PhaseLobes& phase,
                           const Vec3& w) const {
    return indirect_fluence_ * VmfConvolution(mixture, phase).pdf(w);
  }
  // The same of all light, for each bin; negative where it is not known.
  std::vector<float> scattered(const PhaseLobes& phase, const ScatteredBins& bins) const;
  // Of the fluence, what comes straight from emitters, in [0, 1].
  float direct_share() const {
    return direct_fluence_ > 0 ? direct_fluence_ / (direct_fluence_ + indirect_fluence_) : 0;
  }

 private:
  VmfMixture indirect_, direct_;
  std::optional<FocusedMixture> focused_;
  VmfConvolution scattered_indirect_;
  float indirect_fluence_, direct_fluence_;
  bool known_;
  float trust_, phase_narrowness_;
};

class MediumGuides {
 public:
  MediumGuides() = default;
  // cache must outlive this; media: of the scene.
  MediumGuides(const MediumCacheView& cache, std::span<const Medium> media);

  bool empty() const { return flight_nodes_.empty(); }
  const PhaseLobes& phase(int medium) const { return phases_[phase_of_medium_[medium]].lobes; }
  const ScatteredBins& bins(int medium) const { return phases_[phase_of_medium_[medium]].bins; }
  const MediumGuide& at(int medium, const Vec3& p) const {
    return guide(medium, finder_.find(p, Vec3::UnitZ()));
  }
  const MediumGuide& guide(int medium, uint32_t cell) const {
    return phases_[phase_of_medium_[medium]].guides[cell];
  }

  // The cells along a ray, as flights see them: see FlightCells.
  LeafWalk walk(const Ray& ray, float t_max) const { return LeafWalk(flight_nodes_, ray, t_max); }
  // Of these, int f(w, w') L(x, w') dw' of all light, `bin` that of w; negative where the cell is
  // not known.
  float scattered(int medium, uint32_t flight_cell, int bin) const {
    return phases_[phase_of_medium_[medium]].scattered[bin * direct_shares_.size() + flight_cell];
  }
  float direct_share(uint32_t flight_cell) const { return direct_shares_[flight_cell]; }
  size_t flight_cells() const { return direct_shares_.size(); }

 private:
  // The cells for media of one phase function.
  struct PhaseGuides {
    PhaseLobes lobes;
    ScatteredBins bins;
    std::vector<MediumGuide> guides;
    std::vector<float> scattered;  // bin by bin, cell by cell: a ray stays within one bin

    PhaseGuides(const MediumCacheView& cache, float mean_cosine);
  };

  std::vector<ScatteredLight> scattered_light() const;
  void set_tables(const std::vector<ScatteredLight>& light);

  LeafFinder finder_;
  std::vector<int> phase_of_medium_;
  std::vector<PhaseGuides> phases_;
  std::vector<CacheNode> flight_nodes_;
  std::vector<float> direct_shares_;  // by flight cell
};

}  // namespace waylight
