#include "libguide/medium/cell_noise.h"

#include "libguide/base/sampler.h"

namespace waylight {
namespace {

// The point of a cell: 21 bits of the hash for each coordinate.
Vec3 feature_point(const Eigen::Vector3i& cell, uint64_t seed) {
  uint64_t bits = seed;
  for (const int i : cell) bits = hash_combine(bits, static_cast<uint32_t>(i));
  constexpr uint64_t kMask = (1 << 21) - 1;
  const Vec3 inside = Vec3(static_cast<float>(bits & kMask), static_cast<float>(bits >> 21 & kMask),
                           static_cast<float>(bits >> 42 & kMask)) *
                      0x1p-21f;
  return cell.cast<float>() + inside;
}

}  // namespace

float cell_noise(const Vec3& p, uint64_t seed) {
  const Eigen::Vector3i middle = p.array().floor().cast<int>();
  float nearest = 1;  // squared; what is beyond a cell away does not count
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3i cell = middle + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    nearest = std::min(nearest, (feature_point(cell, seed) - p).squaredNorm());
  }
  return 1 - std::sqrt(nearest);
}

float billow_noise(const Vec3& p, int octaves, uint64_t seed) {
  float sum = 0, weights = 0, weight = 1, frequency = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += weight * cell_noise(frequency * p, hash_combine(seed, octave));
    weights += weight;
    weight /= 2;
    frequency *= 2;
  }
  return weights > 0 ? sum / weights : 0;
}

}  // namespace waylight
