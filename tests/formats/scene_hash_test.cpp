#include "formats/scene_hash.h"

#include <gtest/gtest.h>

#include <functional>

#include "common/small_scenes.h"

namespace waylight {
namespace {

std::shared_ptr<Bitmap> checkers() {
  auto bitmap = std::make_shared<Bitmap>();
  bitmap->width = bitmap->height = 2;
  bitmap->pixels = {Color(1, 1, 1), Color(0, 0, 0), Color(0, 0, 0), Color(1, 1, 1)};
  return bitmap;
}

Medium smoke() {
  auto grid = std::make_shared<VolumeGrid>();
  grid->voxels = VoxelBricks({1, 1, 2}, 1, std::vector<float>{1, 2});
  HeterogeneousMedium medium{std::shared_ptr<const VolumeGrid>(grid), Color(0.5f, 0.5f, 0.5f)};
  return {"smoke", medium, HenyeyGreenstein{0.3f}};
}

SceneDescription scene() {
  SceneDescription s = testing::gap_box();
  Texture picture;
  picture.source = BitmapTexture{checkers()};
  testing::add_material(s, "picture", DiffuseMaterial{picture});
  s.media.push_back(smoke());
  s.group_shapes.push_back(s.shapes[0]);
  s.groups.push_back({{0}});
  s.instances.push_back({0, Mat4::Identity()});
  return s;
}

struct Change {
  const char* what;
  std::function<void(SceneDescription&)> apply;
  bool geometry = false, materials = false, emitters = false, media = false;
};

TriangleMesh& mesh(Shape& shape) { return std::get<TriangleMesh>(shape.geometry); }

std::vector<Change> changes() {
  return {
      {"vertex", [](auto& s) { mesh(s.shapes[2]).positions[1].x() += 1e-5f; }, true},
      {"uv", [](auto& s) { mesh(s.shapes[2]).uvs[1].x() += 1e-5f; }, true},
      {"triangle",
       [](auto& s) {
         std::swap(mesh(s.shapes[2]).triangles[0][0], mesh(s.shapes[2]).triangles[0][1]);
       },
       true},
      {"assigned material", [](auto& s) { s.shapes[2].material = 0; }, true},
      {"flip", [](auto& s) { s.shapes[2].flip_normals = true; }, true},
      {"sphere", [](auto& s) { s.shapes[2].geometry = Sphere(); }, true},
      {"shape of a group", [](auto& s) { mesh(s.group_shapes[0]).positions[0].y() = 9; }, true},
      {"instance", [](auto& s) { s.instances[0].to_world(0, 3) = 1; }, true},
      {"reflectance", [](auto& s) { s.materials[0].model = DiffuseMaterial{Texture(0.71f)}; },
       false, true},
      {"kind", [](auto& s) { s.materials[0].model = NullMaterial(); }, false, true},
      {"pixel",
       [](auto& s) {
         auto bitmap = checkers();
         bitmap->pixels[3].z() = 0.9f;
         Texture picture;
         picture.source = BitmapTexture{bitmap};
         s.materials.back().model = DiffuseMaterial{picture};
       },
       false, true},
      {"lamp",
       [](auto& s) {
         s.emitters[0] = AreaLight{Texture(Color(1, 2, 3)), 7};
       },
       false, false, true},
      {"new light", [](auto& s) { s.emitters.push_back(ConstantEnvironment{Color(1, 1, 1)}); },
       false, false, true},
      {"medium", [](auto& s) { s.media[0].phase = IsotropicPhase(); }, false, false, false, true},
      {"emission", [](auto& s) { s.media[0].emission.radiance = Color(1, 2, 3); }, false, false,
       false, true},
      {"inside", [](auto& s) { s.shapes[0].interior_medium = 0; }, false, false, false, true},
  };
}

TEST(SceneHash, EveryChangeShowsInItsPartAndInNoOther) {
  const SceneHash before = hash_scene(scene());
  for (const Change& change : changes()) {
    SceneDescription changed = scene();
    change.apply(changed);
    const SceneHash after = hash_scene(changed);
    EXPECT_EQ(after.geometry != before.geometry, change.geometry) << change.what;
    EXPECT_EQ(after.materials != before.materials, change.materials) << change.what;
    EXPECT_EQ(after.emitters != before.emitters, change.emitters) << change.what;
    EXPECT_EQ(after.media != before.media, change.media) << change.what;
  }
}

TEST(SceneHash, NamesCameraIntegratorAndAddressesDoNotMatter) {
  const SceneHash before = hash_scene(scene());
  SceneDescription other = scene();
  for (Shape& shape : other.shapes) shape.name += "x";
  for (Material& material : other.materials) material.name += "x";
  for (Medium& medium : other.media) medium.name += "x";
  other.sensor.to_world(0, 3) = 7;
  other.integrator.max_depth = 3;
  other.source = "elsewhere.xml";
  EXPECT_EQ(hash_scene(other), before);
}

TEST(SceneHash, SharedPictureHashesLikeItsCopies) {
  SceneDescription shared = scene(), copied = scene();
  const Material picture = shared.materials.back();
  shared.materials.push_back(picture);
  Texture copy;
  copy.source = BitmapTexture{checkers()};
  copied.materials.push_back({"copy", DiffuseMaterial{copy}});
  EXPECT_EQ(hash_scene(shared), hash_scene(copied));
}

TEST(SceneHash, EmptySceneHasOne) {
  EXPECT_EQ(hash_scene(SceneDescription()), hash_scene(SceneDescription()));
}

}  // namespace
}  // namespace waylight
