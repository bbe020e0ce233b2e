#pragma once
// Distant emitters with extent: seen by rays that leave the scene. Beside the contract of emitter.h
// they have radiance(direction), direction pointing to the light, and pdf(direction).

#include "libguide/math/distribution.h"
#include "libguide/scene/emitter.h"

namespace waylight {

struct ConstantEmitter {
  ConstantEnvironment light;
  SceneSphere sphere;

  double power() const { return 4 * kPi * sphere.cross_section() * mean(light.radiance); }
  Color radiance(const Vec3& /*direction*/) const { return light.radiance; }
  std::optional<LightSample> sample(const Vec3& from, float u, const Vec2& u2) const;
  float pdf(const Vec3& direction) const;
  std::optional<EmissionSample> emit(float u, const Vec2& u_position,
                                     const Vec2& u_direction) const;
};

// Bilinear between the centres of the pixels, sampled by the mean radiance of each cell between
// four centres, uniform in solid angle inside it: the density is positive wherever the radiance is,
// and at least a quarter of what would be proportional to it.
class MapEmitter {
 public:
  MapEmitter(const EnvironmentMap& map, const SceneSphere& sphere);

  double power() const { return power_; }
  Color radiance(const Vec3& direction) const;
  std::optional<LightSample> sample(const Vec3& from, float u, const Vec2& u2) const;
  float pdf(const Vec3& direction) const;
  std::optional<EmissionSample> emit(float u, const Vec2& u_position,
                                     const Vec2& u_direction) const;

 private:
  // Cell (column, row) lies between the centres of pixels column and column + 1 (around the seam)
  // and of rows row - 1 and row; the first and the last row of cells are half as high, or
  // have no height where rows are at the poles.
  struct Place {
    int column, row;
    float x, y;  // within the cell, for the interpolation
  };
  Place locate(const Vec3& direction) const;
  Color radiance(const Place& at) const;
  float pdf(const Place& at) const;
  const Color& pixel(int column, int row) const;
  Color cell_mean(int column, int row) const;
  double row_edge(int row) const;  // polar angle at which a row of cells begins
  float cell_solid_angle(int row) const;

  std::shared_ptr<const Bitmap> bitmap_;
  float scale_;
  Mat3 to_world_;
  SceneSphere sphere_;
  double row_scale_, row_offset_;  // of a polar angle of 1, and of the pole, in rows of cells
  PiecewiseConstant2d cells_;
  double power_;
};

// A uniform disk, such as the sun.
struct DiskEmitter {
  DistantDisk light;
  SceneSphere sphere;

  float height() const { return 1 - light.cos_angle; }
  double power() const {
    return 2 * kPi * height() * sphere.cross_section() * mean(light.radiance);
  }
  Color radiance(const Vec3& direction) const;
  std::optional<LightSample> sample(const Vec3& from, float u, const Vec2& u2) const;
  float pdf(const Vec3& direction) const;
  std::optional<EmissionSample> emit(float u, const Vec2& u_position,
                                     const Vec2& u_direction) const;
};

}  // namespace waylight
