#pragma once
// Running first and second moments of the positions of a cell's photons, kept in its training.

#include "libguide/math/types.h"

namespace waylight {

// Sums over one batch, taken about the running mean so that a cell far from the origin loses no
// digits, then merged by the pairwise update of Chan, Golub and LeVeque [1983].
class PositionSums {
 public:
  explicit PositionSums(const Vec3& shift) : shift_(shift) {}

  void add(const Vec3& position) {
    const Vec3 p = position - shift_;
    sum_ += p;
    square_ += p.cwiseProduct(p);
    cross_ += Vec3(p.x() * p.y(), p.x() * p.z(), p.y() * p.z());
  }

  // M2 = M2_a + M2_b + delta^2 n_a n_b / n with delta the difference of the means; likewise
  // products. between = -n_b^2 / n, as the sums of the batch are about the shift and not their
  // mean. count: of the batch; share: n_b / n. Leaves t.count as it is.
  template <typename Training>
  void merge_into(Training& t, float count, float between, float share) const {
    const Vec3 d = sum_ / count;
    t.position_m2 += square_ + between * d.cwiseProduct(d);
    t.position_cross += cross_ + between * Vec3(d.x() * d.y(), d.x() * d.z(), d.y() * d.z());
    t.position_m2 = t.position_m2.cwiseMax(0);
    t.position_mean = shift_ + d * share;
  }

 private:
  Vec3 shift_, sum_ = Vec3::Zero(), square_ = Vec3::Zero(), cross_ = Vec3::Zero();
};

// Adds those of the positions of another cell, whose count is not 0; leaves t.count as it is.
template <typename Training>
void add_position_moments(Training& t, const Training& other) {
  const float share = other.count / (t.count + other.count), between = t.count * share;
  const Vec3 d = other.position_mean - t.position_mean;
  t.position_m2 += other.position_m2 + between * d.cwiseProduct(d);
  t.position_cross +=
      other.position_cross + between * Vec3(d.x() * d.y(), d.x() * d.z(), d.y() * d.z());
  t.position_mean += share * d;
}

// Integers up to it are exact in float; beyond, the moments become a window over the last photons.
inline constexpr float kMaxMomentCount = 0x1p24f;

template <typename Training>
void forget_half(Training& t) {
  t.count *= 0.5f;
  t.position_m2 *= 0.5f;
  t.position_cross *= 0.5f;
}

}  // namespace waylight
