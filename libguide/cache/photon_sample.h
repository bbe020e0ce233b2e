#pragma once
// A bounded random part of a stream of photons.

#include <cstdint>
#include <vector>

#include "libguide/base/sampler.h"

namespace waylight {

// Reservoir sampling [Vitter 1985, algorithm R]: all of the first `most`, then each of those seen
// with the same probability, by their number in the stream alone.
template <typename Point>
class PhotonSample {
 public:
  explicit PhotonSample(size_t most) : most_(most) {}

  void add(const Point& point) {
    if (kept_.size() < most_) {
      kept_.push_back(point);
    } else if (const uint64_t slot = mix_bits(seen_) % (seen_ + 1); slot < most_) {
      kept_[slot] = point;
    }
    ++seen_;
  }
  const std::vector<Point>& kept() const { return kept_; }
  double seen() const { return static_cast<double>(seen_); }

 private:
  size_t most_;
  std::vector<Point> kept_;
  uint64_t seen_ = 0;
};

}  // namespace waylight
