#pragma once
// The weight window of guided Russian roulette and splitting, for surfaces and media alike.

#include <algorithm>
#include <cmath>

namespace waylight {

// How many copies of a path go on, and the factor of each one's weight.
struct Population {
  int copies = 1;
  float weight = 1;
};

// q = E[X] / I: what a path is expected to add to its pixel, over what the pixel is expected to be.
// Inside [2 / (1 + s), 2 s / (1 + s)], s the ratio of its ends, a path goes on alone. Below, it
// survives with q over the lower end; above, it is split into q over the upper end copies on
// average, so that the weight of a survivor or copy stands at the nearer end [Vorba, Krivanek 2016,
// section 4.2].
class WeightWindow {
 public:
  static constexpr float kDefaultRatio = 5, kMaxRatio = 1000;
  static constexpr float kMinSurvival = 0.1f;  // estimates may be off by far

  // ratio: in [1, kMaxRatio]; 1 decides at every vertex.
  explicit WeightWindow(float ratio = kDefaultRatio) : low_(2 / (1 + ratio)), high_(ratio * low_) {}

  float low() const { return low_; }
  float high() const { return high_; }

  // Whether a decision is needed; false for q that is NaN.
  bool leaves(float q, int max_copies) const { return q < low_ || (q > high_ && max_copies > 1); }

  // q >= 0. u: uniform in [0, 1). max_copies >= 1, which may depend on all that happened before.
  // The mean over u of copies * weight is 1 for every q, infinite ones included.
  Population decide(float q, int max_copies, float u) const {
    if (!leaves(q, max_copies)) return {};
    const float wanted = q < low_ ? std::max(q / low_, kMinSurvival)
                                  : std::min(q / high_, static_cast<float>(max_copies));
    const float whole = std::floor(wanted);
    return {static_cast<int>(whole) + (u < wanted - whole), 1 / wanted};
  }

 private:
  float low_, high_;
};

}  // namespace waylight
