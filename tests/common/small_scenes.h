#pragma once
// Scenes of a few triangles for tests, built without a file.

#include "libguide/scene/scene_description.h"

namespace waylight::testing {

// A rectangle from corner over edges a and b; its normal is a x b.
inline TriangleMesh rectangle(const Vec3& corner, const Vec3& a, const Vec3& b) {
  TriangleMesh mesh;
  mesh.positions = {corner, corner + a, corner + a + b, corner + b};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

inline int add_material(SceneDescription& scene, const std::string& name, MaterialModel model) {
  scene.materials.push_back({name, std::move(model)});
  return static_cast<int>(scene.materials.size()) - 1;
}

inline int add_two_sided(SceneDescription& scene, const std::string& name, MaterialModel model) {
  const int nested = add_material(scene, name + ".nested", std::move(model));
  return add_material(scene, name, TwoSidedMaterial{nested, nested});
}

inline uint32_t add_shape(SceneDescription& scene, std::variant<TriangleMesh, Sphere> geometry,
                          int material) {
  Shape shape;
  shape.name = "shape" + std::to_string(scene.shapes.size());
  shape.geometry = std::move(geometry);
  shape.material = material;
  scene.shapes.push_back(std::move(shape));
  return static_cast<uint32_t>(scene.shapes.size()) - 1;
}

inline void make_light(SceneDescription& scene, uint32_t shape, const Color& radiance) {
  scene.shapes[shape].emitter = static_cast<int>(scene.emitters.size());
  scene.emitters.push_back(AreaLight{Texture(radiance), shape});
}

inline void look_along_z(SceneDescription& scene, const Vec3& from, int width, int height) {
  scene.sensor.to_world = Mat4::Identity();
  scene.sensor.to_world.block<3, 1>(0, 3) = from;
  scene.sensor.fov = 1.2f;
  scene.sensor.film.width = width;
  scene.sensor.film.height = height;
  scene.sensor.film.filter = FilterType::box;
}

// A unit box [-1, 1]^3 with a wall across it (z = 0.5) that leaves a gap; a lamp behind the wall
// faces away from it, so the front room sees only light that came through the gap. The floor is a
// rough conductor.
inline SceneDescription gap_box(int width = 24, int height = 16) {
  SceneDescription scene;
  const int white = add_two_sided(scene, "white", DiffuseMaterial{Texture(0.7f)});
  RoughConductorMaterial metal;
  metal.eta = Color(1.66f, 0.88f, 0.52f);
  metal.k = Color(9.2f, 6.3f, 4.8f);
  metal.alpha_u = metal.alpha_v = Texture(0.2f);
  metal.distribution = MicrofacetDistribution::ggx;
  const int floor = add_two_sided(scene, "floor", metal);
  const Vec3 x(2, 0, 0), y(0, 2, 0), z(0, 0, 3);
  const Vec3 corner(-1, -1, -1);
  add_shape(scene, rectangle(corner, z, x), floor);
  add_shape(scene, rectangle(corner + y, x, z), white);
  add_shape(scene, rectangle(corner, y, z), white);
  add_shape(scene, rectangle(corner + x, z, y), white);
  add_shape(scene, rectangle(corner, x, y), white);
  add_shape(scene, rectangle(corner + z, y, x), white);
  add_shape(scene, rectangle({-1, -1, 0.5f}, {1.5f, 0, 0}, y), white);  // gap for x > 0.5
  const uint32_t lamp =
      add_shape(scene, rectangle({-0.6f, -0.3f, 0.8f}, {0.6f, 0, 0}, {0, 0.6f, 0}), white);
  make_light(scene, lamp, Color(40, 35, 30));
  look_along_z(scene, {0, 0, -0.95f}, width, height);
  scene.integrator.max_depth = 10;
  return scene;
}

// A room [-1, 1]^3 with a window of half a unit in its wall at x = 1, seen from the wall z = -1.
// The environment is uniform but for a sun of 10 degrees, which shines through the window at 45.
inline SceneDescription window_box(int width = 24, int height = 16) {
  SceneDescription scene;
  const int white =
      add_two_sided(scene, "white", DiffuseMaterial{Texture(Color(0.7f, 0.6f, 0.5f))});
  const Vec3 x(2, 0, 0), y(0, 2, 0), z(0, 0, 2);
  const Vec3 corner(-1, -1, -1);
  add_shape(scene, rectangle(corner, z, x), white);
  add_shape(scene, rectangle(corner + y, x, z), white);
  add_shape(scene, rectangle(corner, y, z), white);
  add_shape(scene, rectangle(corner, x, y), white);
  add_shape(scene, rectangle(corner + z, y, x), white);
  // The wall with the window 0 < y < 0.5, 0 < z < 0.5: below, above, before and behind it.
  add_shape(scene, rectangle({1, -1, -1}, {0, 0, 2}, {0, 1, 0}), white);
  add_shape(scene, rectangle({1, 0.5f, -1}, {0, 0, 2}, {0, 0.5f, 0}), white);
  add_shape(scene, rectangle({1, 0, -1}, {0, 0, 1}, {0, 0.5f, 0}), white);
  add_shape(scene, rectangle({1, 0, 0.5f}, {0, 0, 0.5f}, {0, 0.5f, 0}), white);
  scene.emitters.push_back(ConstantEnvironment{Color(0.5f, 0.7f, 1)});
  scene.emitters.push_back(
      DistantDisk{Vec3(1, 1, 0).normalized(), std::cos(5 * kPi / 180), Color(60, 50, 40)});
  look_along_z(scene, {0, 0, -0.95f}, width, height);
  scene.integrator.max_depth = 10;
  return scene;
}

}  // namespace waylight::testing
