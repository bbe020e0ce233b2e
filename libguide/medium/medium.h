#pragma once
// Participating media as imported. Coefficients are per unit length of the world.

#include <memory>
#include <string>
#include <variant>

#include "libguide/medium/voxel_bricks.h"

namespace waylight {

struct IsotropicPhase {};
struct HenyeyGreenstein {
  float g = 0;  // mean cosine, (-1, 1); positive is forward
};
using PhaseFunction = std::variant<IsotropicPhase, HenyeyGreenstein>;

// [0,1]^3 to the box between two corners.
inline Mat4 box_between(const Vec3& low, const Vec3& high) {
  Mat4 box = Mat4::Identity();
  box.diagonal().head<3>() = high - low;
  box.topRightCorner<3, 1>() = low;
  return box;
}

struct VolumeGrid {
  VoxelBricks voxels;                     // of 1 or 3 channels
  bool nearest = false;                   // the voxel's value, instead of trilinear interpolation
  Mat4 grid_to_world = Mat4::Identity();  // [0,1]^3 of the grid to the world
  // The outermost values stand on the sides of the grid, instead of half a voxel within.
  bool values_on_sides = false;

  const Eigen::Vector3i& size() const { return voxels.size(); }
  // What of the outer voxels lies beyond the sides, in voxels; 0 along an axis with one value.
  Vec3 margin() const {
    if (!values_on_sides) return Vec3::Zero();
    return (size().array() > 1).select(Vec3::Constant(0.5f), Vec3::Zero());
  }
};
using VolumeTexture = std::variant<Color, std::shared_ptr<const VolumeGrid>>;

struct HomogeneousMedium {
  Color sigma_t, albedo;
};
// sigma_t(x) = scale * density(x).
struct HeterogeneousMedium {
  VolumeTexture density;
  VolumeTexture albedo;
  float scale = 1;
};

// Le(x) = scale * radiance(x), W/(m^2 sr): what the medium adds to a ray per unit length is
// sigma_a Le = (1 - albedo) sigma_t Le, so that Le is the radiance of a thick medium that does not
// scatter, and of any that is in equilibrium with its surroundings [Fong et al. 2017, 2.2].
struct MediumEmission {
  VolumeTexture radiance = Color(Color::Zero());
  Color scale = Color::Ones();
};
// Whether anything is emitted as far as Le tells; media of albedo one emit nothing all the same.
bool emits(const MediumEmission& emission);

struct Medium {
  std::string name;
  std::variant<HomogeneousMedium, HeterogeneousMedium> coefficients;
  PhaseFunction phase;
  MediumEmission emission = {};
};

}  // namespace waylight
