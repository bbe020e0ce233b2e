#pragma once
// Small scenes for the tests of every layer from the scene up.

#include "libguide/scene/scene.h"

namespace waylight::fixtures {

// Corners in counter-clockwise order seen from the side of the normal; uv (0,0), (1,0), (1,1),
// (0,1).
inline TriangleMesh quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  TriangleMesh mesh;
  mesh.positions = {a, b, c, d};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

// A square of side 2 half in the plane z = height, facing +z or -z.
inline TriangleMesh square(float half, float height, bool up = true) {
  const Vec3 a(-half, -half, height), b(half, -half, height), c(half, half, height),
      d(-half, half, height);
  return up ? quad(a, b, c, d) : quad(a, d, c, b);
}

// A closed box whose normals face inwards.
inline TriangleMesh room(float half, const Vec3& center = Vec3::Zero()) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back(center + half * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  constexpr uint32_t kFaces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                     {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  for (const auto& f : kFaces) {
    mesh.triangles.push_back({f[0], f[1], f[2]});
    mesh.triangles.push_back({f[0], f[2], f[3]});
  }
  return mesh;
}

inline Shape shape(TriangleMesh mesh, int material = kNone) {
  return {"mesh", std::move(mesh), material};
}
inline Shape shape(const Vec3& center, float radius, int material = kNone) {
  return {"sphere", Sphere{center, radius}, material};
}

inline SceneDescription scene_of(std::vector<Shape> shapes) {
  SceneDescription scene;
  scene.shapes = std::move(shapes);
  return scene;
}

// Makes the shape an area light.
inline void make_light(SceneDescription& scene, uint32_t shape, const Texture& radiance) {
  scene.shapes[shape].emitter = static_cast<int>(scene.emitters.size());
  scene.emitters.push_back(AreaLight{radiance, shape});
}

inline std::shared_ptr<Bitmap> bitmap(int width, int height, const Color& fill) {
  auto result = std::make_shared<Bitmap>();
  result->width = width;
  result->height = height;
  result->pixels.assign(static_cast<size_t>(width) * height, fill);
  return result;
}

}  // namespace waylight::fixtures
