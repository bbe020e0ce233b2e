#pragma once
// Media as sources of particles. Next-event estimation does not know them.

#include "libguide/base/sampler.h"
#include "libguide/math/distribution.h"
#include "libguide/scene/scene.h"

namespace waylight {

// Around the shapes that name the medium on either side, of the whole scene where shapes of a group
// do; empty where none does.
Bounds medium_bounds(const Scene& scene, int medium);

// Particles start where a medium emits, in any direction: medium by power, then one of the cells of
// its region by power, then evenly within the cell. A region is the box of the medium's density
// grid, or else the bounds of the shapes that name it; places in it that are not in the medium
// after all start nothing. Power is 4 pi int sigma_a Le dV.
class MediumLights {
 public:
  // The scene must outlive this.
  explicit MediumLights(const Scene& scene);

  // W, mean of the colour channels and luminance, as if the regions were full; 0: nothing emits.
  double power() const { return chosen_.empty() ? 0 : chosen_.total(); }
  double power_luminance() const { return luminance_; }

  struct Sample {
    Ray ray;
    Color power;  // 4 pi sigma_a Le / density of the place, W; its mean is the power of the media
    int medium = kNone;
  };
  std::optional<Sample> sample(Sampler& sampler) const;

 private:
  struct Region {
    int medium;
    Mat4 to_world;         // of the unit cube
    double volume;         // of the region, in the world
    Eigen::Vector3i side;  // cells along each axis
    Discrete cells;

    Vec3 place(int cell, const Vec3& inside) const;
  };
  void add(int medium);
  Color emitted(const Region& region, int cell) const;

  const Scene& scene_;
  std::vector<Region> regions_;
  Discrete chosen_;  // among the regions
  double luminance_ = 0;
};

}  // namespace waylight
