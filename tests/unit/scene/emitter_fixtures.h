#pragma once
// One scene per kind of emitter around a patch at the origin: a square of side 0.5 facing +z.

#include <functional>
#include <ostream>

#include "unit/scene/scene_fixtures.h"

namespace waylight::fixtures {

struct EmitterCase {
  const char* name;
  std::function<SceneDescription()> make;
  double power;  // W, mean of the channels; 0: depends on the scene's sphere
};

inline std::ostream& operator<<(std::ostream& out, const EmitterCase& c) { return out << c.name; }

inline SceneDescription patch() { return scene_of({shape(square(0.25f, 0))}); }

inline SceneDescription patch_under(const EmitterDescription& emitter) {
  SceneDescription scene = patch();
  scene.emitters = {emitter};
  return scene;
}

inline SceneDescription patch_under(Shape light, const Texture& radiance) {
  SceneDescription scene = patch();
  scene.shapes.push_back(std::move(light));
  make_light(scene, 1, radiance);
  return scene;
}

inline Texture checkerboard() {
  Texture texture;
  texture.source = CheckerboardTexture{Color(1, 2, 3), Color(0, 0, 6)};
  return texture;
}

// A gradient with a strong pixel next to the seam and one at the pole.
inline EnvironmentMap uneven_map() {
  const std::shared_ptr<Bitmap> picture = bitmap(16, 8, Color::Zero());
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 16; ++x) picture->pixels[y * 16 + x] = Color(0.1f * x, 0.2f * y, 1);
  picture->pixels[2 * 16] = Color::Constant(50);
  picture->pixels[5] = Color::Constant(30);
  EnvironmentMap map{picture, 0.5f};
  map.to_world = Eigen::AngleAxisf(1.1f, Vec3(1, 0.2f, 0.4f).normalized()).toRotationMatrix();
  return map;
}

inline std::vector<EmitterCase> emitter_cases() {
  const double pi = std::numbers::pi;
  const Vec3 down = Vec3(0.1f, -0.2f, -1).normalized();
  const Color rgb(1, 2, 3);
  Shape globe = shape({0.3f, -0.2f, 1}, 0.4f);
  Shape dome = shape(Vec3::Zero(), 1);
  dome.flip_normals = true;
  return {
      {"mesh", [=] { return patch_under(shape(square(0.5f, 1, false)), Texture(rgb)); }, 2 * pi},
      {"textured mesh", [=] { return patch_under(shape(square(0.5f, 1, false)), checkerboard()); },
       2 * pi},
      {"sphere", [=] { return patch_under(globe, Texture(rgb)); }, 2 * pi * 4 * pi * 0.16},
      {"textured sphere", [=] { return patch_under(globe, checkerboard()); },
       2 * pi * 4 * pi * 0.16},
      {"inside of a sphere", [=] { return patch_under(dome, Texture(rgb)); }, 2 * pi * 4 * pi},
      {"point",
       [=] {
         return patch_under(PointLight{{0.2f, 0, 1}, rgb});
       },
       2 * 4 * pi},
      {"spot",
       [=] {
         return patch_under(SpotLight{{0, 0.1f, 1}, down, rgb, 0.6f, 0.2f});
       },
       2 * 2 * pi * (1 - (std::sin(0.6) - std::sin(0.2)) / 0.4)},
      {"directional",
       [=] {
         return patch_under(DirectionalLight{down, rgb});
       },
       0},
      {"constant", [=] { return patch_under(ConstantEnvironment{rgb}); }, 0},
      {"map", [=] { return patch_under(uneven_map()); }, 0},
      {"disk",
       [=] {
         return patch_under(DistantDisk{-down, std::cos(0.2f), rgb});
       },
       0},
      {"sun",
       [=] {
         return patch_under(DistantDisk{-down, std::cos(0.00465f), rgb});
       },
       0},
  };
}

}  // namespace waylight::fixtures
