#pragma once
// Media and scenes of them for tests, built without a file.

#include <memory>

#include "common/small_scenes.h"
#include "libguide/math/warp.h"

namespace waylight::testing {

inline Medium homogeneous(const Color& sigma_t, const Color& albedo, float g = 0) {
  return {"fog", HomogeneousMedium{sigma_t, albedo}, HenyeyGreenstein{g}};
}

// A density over [0, 1]^3: a bright core in thin haze, with an empty half.
inline std::shared_ptr<const VolumeGrid> lumpy_grid(int channels = 1, int side = 20) {
  std::vector<float> values;
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        for (int c = 0; c < channels; ++c) {
          const Vec3 p = (Vec3(x, y, z).array() + 0.5f).matrix() / side;
          const float core = std::exp(-20 * (p - Vec3(0.3f, 0.5f, 0.5f)).squaredNorm());
          values.push_back(p.x() > 0.7f ? 0 : 0.1f + core * (1 + 0.3f * c));
        }
  auto grid = std::make_shared<VolumeGrid>();
  grid->voxels = VoxelBricks(Eigen::Vector3i::Constant(side), channels, values);
  return grid;
}

// All values of a grid, x fastest.
inline std::vector<float> dense_values(const VoxelBricks& voxels) {
  std::vector<float> values;
  for_each_voxel({Eigen::Vector3i::Zero(), (voxels.size().array() - 1).matrix()},
                 [&](const Eigen::Vector3i& i) {
                   const float* value = voxels.at(i);
                   values.insert(values.end(), value, value + voxels.channels());
                 });
  return values;
}

inline Medium cloud(std::shared_ptr<const VolumeGrid> density, float scale, float albedo = 0.9f) {
  return {"cloud", HeterogeneousMedium{density, Color(Color::Constant(albedo)), scale},
          HenyeyGreenstein{}};
}

// The box [lo, hi] with normals outwards.
inline TriangleMesh box(const Vec3& lo, const Vec3& hi) {
  TriangleMesh mesh;
  const Vec3 d = hi - lo, x(d.x(), 0, 0), y(0, d.y(), 0), z(0, 0, d.z());
  const auto add = [&](const Vec3& corner, const Vec3& a, const Vec3& b) {
    const uint32_t first = static_cast<uint32_t>(mesh.positions.size());
    for (const Vec3& p : {corner, Vec3(corner + a), Vec3(corner + a + b), Vec3(corner + b)})
      mesh.positions.push_back(p);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  };
  add(lo, y, x);
  add(lo, x, z);
  add(lo, z, y);
  add(hi, -x, -y);
  add(hi, -z, -x);
  add(hi, -y, -z);
  return mesh;
}

// An index-matched box of a medium, looked at along +z from in front of it.
inline SceneDescription box_of(const Medium& medium, const Vec3& lo, const Vec3& hi, int width = 8,
                               int height = 8) {
  SceneDescription scene;
  scene.media.push_back(medium);
  const uint32_t shape = add_shape(scene, box(lo, hi), add_material(scene, "null", NullMaterial{}));
  scene.shapes[shape].interior_medium = 0;
  look_along_z(scene, {0, 0, -4}, width, height);
  return scene;
}

}  // namespace waylight::testing
