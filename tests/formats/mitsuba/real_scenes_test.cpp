// Import of the scenes that the project ships, and of those made elsewhere where they are at hand.

#include <cstdlib>

#include "common/scenes_folder.h"
#include "formats/mitsuba/scene_texts.h"
#include "libguide/scene/scene_check.h"

namespace waylight {
namespace {

namespace fs = std::filesystem;
using testing::mentions;

struct Expected {
  const char* file;
  size_t shapes, emitters, media;
};

constexpr Expected kScenes[] = {
    {"cornell-box/scene.xml", 8, 1, 0},
    {"veach-ajar/scene_complete.xml", 22, 1, 0},
    {"veach-bidir/scene.xml", 14, 2, 0},
    {"living-room/scene.xml", 65, 1, 0},
    {"kitchenette/simple.xml", 88, 1, 0},
    {"kitchenette/scene.xml", 88, 1, 0},
    {"volumetric-caustic/scene.xml", 8, 1, 3},
    {"hetvol/hetvol.xml", 3, 1, 1},
    {"mitsuba-media/tests/scenes/participating_media/test_hetero_sigmat_volpath.xml", 3, 1, 1},
    {"mitsuba-media/tests/scenes/participating_media/test_homo_area_light_volpath.xml", 4, 1, 1},
    {"mitsuba-media/tests/scenes/participating_media/test_homo_dielectric_envmap_volpath.xml", 2, 1,
     1},
    {"mitsuba-media/tests/scenes/participating_media/test_homo_null_envmap_volpath.xml", 3, 1, 1},
    {"mitsuba-media/tests/scenes/participating_media/test_homo_obj_inside_medium_volpath.xml", 5, 1,
     1},
    {"mitsuba-media/tests/scenes/participating_media/test_surf_area_light_volpath.xml", 4, 2, 0}};

void PrintTo(const Expected& expected, std::ostream* out) { *out << expected.file; }

class RealScenes : public ::testing::TestWithParam<Expected> {};

TEST_P(RealScenes, AreImportedWithoutLeniency) {
  const fs::path file = waylight::testing::scenes_folder() / GetParam().file;
  if (!fs::exists(waylight::testing::scenes_folder()))
    GTEST_SKIP() << "no scenes: set WAYLIGHT_SCENES to their folder";
  SceneDescription scene = import_mitsuba(file.string(), {});
  EXPECT_EQ(scene.shapes.size(), GetParam().shapes);
  EXPECT_EQ(scene.emitters.size(), GetParam().emitters);
  EXPECT_EQ(scene.media.size(), GetParam().media);
  EXPECT_NO_THROW(prepare_scene(scene));
}

INSTANTIATE_TEST_SUITE_P(All, RealScenes, ::testing::ValuesIn(kScenes));

class ShippedScenes : public testing::MitsubaScenes {
 protected:
  SceneDescription shipped(const std::string& name) {
    options_.on_warning = [](const std::string& text) { ADD_FAILURE() << text; };
    const fs::path folder = fs::path(WAYLIGHT_SOURCE_DIR) / "pipelines" / "scenes";
    return import_mitsuba((folder / name).string(), options_);
  }
};

TEST_F(ShippedScenes, GapRoomIsImportedWithoutWarning) {
  SceneDescription scene = shipped("gap-room.xml");
  EXPECT_EQ(scene.shapes.size(), 17u);
  EXPECT_EQ(scene.integrator.max_depth, 24);
  EXPECT_NO_THROW(prepare_scene(scene));
}

TEST_F(ShippedScenes, JewelryFindsItsMeshesInAGivenFolder) {
  put("ring.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  options_.defines["meshes"] = fs::path(path("ring.obj")).parent_path().string();
  SceneDescription scene = shipped("jewelry.xml");
  EXPECT_EQ(scene.emitters.size(), 2u);
  EXPECT_NO_THROW(prepare_scene(scene));
}

TEST_F(ShippedScenes, HashIsThatOfTheContent) {
  const std::string text = "<shape type=\"cube\"/><sensor type=\"perspective\"/>";
  const SceneDescription one = import_mitsuba(put("a.xml", wrap(text)), {});
  const SceneDescription same = import_mitsuba(put("b.xml", wrap("\n" + text)), {});
  const SceneDescription other = import_mitsuba(put("c.xml", wrap("<shape type=\"disk\"/>")), {});
  EXPECT_TRUE(one.hash == same.hash);
  EXPECT_FALSE(one.hash == other.hash);
}

}  // namespace
}  // namespace waylight
