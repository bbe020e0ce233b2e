#pragma once
// Rays that leave the scene as places of a table: by direction, then by where they pierce the disk
// through the middle of the scene that is perpendicular to it. Equal steps in the table are equal
// solid angles and equal areas.

#include <cstdint>

#include "libguide/math/types.h"

namespace waylight {

// Of the sphere around the scene to that around its bounds: room for rounding.
inline constexpr float kSceneMargin = 1.0001f;

class EscapeMap {
 public:
  // Direction bins along each axis of the square that one hemisphere is mapped to, 4.5 degrees; and
  // position cells along each axis of the square that the disk is mapped to.
  static constexpr uint32_t kDirections = 32, kPositions = 32;
  static constexpr uint32_t kBins = 2 * kDirections * kDirections;
  static constexpr uint32_t kCells = kPositions * kPositions;
  static constexpr float kBinSolidAngle = 4 * kPi / kBins;

  EscapeMap() = default;
  explicit EscapeMap(const Bounds& scene);  // the disk is that of the sphere around it

  static uint32_t bin(const Vec3& to_light);
  // Place of the ray on the disk, in [0, 1)^2: the random numbers with which distant emitters send
  // a particle the other way along it.
  Vec2 position(const Vec3& origin, const Vec3& to_light) const;
  static uint32_t cell(const Vec2& position);

  float disk_area() const { return kPi * radius_ * radius_; }

 private:
  Vec3 center_ = Vec3::Zero();
  float radius_ = 0;
};

}  // namespace waylight
