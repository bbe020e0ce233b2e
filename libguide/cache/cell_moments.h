#pragma once
// Running moments of the photons of a cell of surfaces, kept in its CellTraining.

#include "libguide/cache/position_moments.h"
#include "libguide/records/guide_cache.h"
#include "libguide/records/photon.h"

namespace waylight {

// Sums over one batch; see PositionSums.
class MomentBatch {
 public:
  MomentBatch(const CellTraining& cell, const Photon& first)
      : positions_(cell.count > 0 ? cell.position_mean : first.position),
        normal_shift_(cell.count > 0 ? cell.normal_mean : first.normal) {}

  void add(const Photon& photon, float weight) {
    positions_.add(photon.position);
    const Vec3 n = photon.normal - normal_shift_;
    normal_ += n;
    normal2_ += n.cwiseProduct(n);
    flux_ += weight;
    count_ += 1;
  }
  void merge_into(CellTraining& cell) const;

 private:
  PositionSums positions_;
  Vec3 normal_shift_, normal_ = Vec3::Zero(), normal2_ = Vec3::Zero();
  double flux_ = 0;
  float count_ = 0;
};

// Adds the moments of the photons of another cell, and their number. Not the flux.
void add_moments(CellTraining& cell, const CellTraining& other);

// Surface area that the photons of a cell cover: that of the rectangle whose uniform density has
// their covariance in the plane of the mean normal, 12 sqrt(det) [a side of length l has variance
// l^2 / 12]. Exact for rectangles in any orientation that are lit evenly. A disk comes out 5 % low,
// a triangle 15 % high, an L of three squares 14 % high, light that falls to half from one side to
// the other 2 % low. Layers behind each other count once.
double photon_area(const CellTraining& cell);

// The unit mean normal of the photons, or `fallback` where they cancel out.
Vec3 mean_normal(const CellTraining& cell, const Vec3& fallback);

}  // namespace waylight
