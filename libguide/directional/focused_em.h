#pragma once
// EM for lobes that turn with the place, all lobes of a mixture at once.

#include <span>
#include <vector>

#include "libguide/directional/focused_fit.h"
#include "libguide/math/lanes.h"

namespace waylight {

struct LaneVectors {
  Lanes x{}, y{}, z{};
};

// Lobes as their own centre sees them, the mean place of their photons: mean and concentration, and
// the inverse of the distance of the focus, 0 where it is infinitely far. From x a lobe points
// along
//   mean - inverse_distance (x - centre)
// whose length is the distance of the focus over that from the centre.
class FocusedEm {
 public:
  FocusedEm(std::span<const PlacedDirection> photons, std::span<const VmfComponent> start,
            const VmfPrior& prior);

  // Lobes have foci from the first iteration in which the photons say so, if they may.
  void iterate(int iterations, bool with_foci);
  // In nats, of all samples; effective ones, whose weights are not equal.
  double log_likelihood() const;
  double samples() const { return samples_; }
  int foci() const;
  // far: what stands for an infinite distance.
  std::vector<FocusedLobe> lobes(float far) const;

 private:
  struct Point {
    Vec3 position, direction;  // positions from origin_
    float weight;              // they sum to one
  };

  void take(std::span<const PlacedDirection> photons);
  Lanes densities(const Point& point) const;
  void share_out();
  void move_centres();
  void find_foci();
  void fit_lobes();
  LaneVectors at_centre(const Point& point) const;

  std::vector<Point> points_;
  std::vector<Lanes> shares_;  // of each point's weight, by lobe
  VmfPrior prior_;
  Vec3 origin_ = Vec3::Zero();
  float spread_ = 0;
  double samples_ = 0;
  int count_ = 0;
  Lanes weight_{}, kappa_{}, inverse_distance_{};
  Lanes support_{};  // sums of the shares
  LaneVectors mean_, centre_;
};

}  // namespace waylight
