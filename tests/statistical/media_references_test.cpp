// Mitsuba's regression scenes of media against its own means, plain and with every decision guided.

#include <gtest/gtest.h>

#include "common/scenes_folder.h"
#include "common/trained.h"
#include "formats/image_io.h"
#include "formats/mitsuba.h"
#include "libguide/image/picture.h"
#include "libguide/image/z_scores.h"

namespace waylight {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path("mitsuba-media") / "tests/scenes/participating_media";

// The variance of the references is a thousandth of that of these renders, and left out. Noise is
// far from normal where light comes by caustics: the shares beyond 3 sigma allow for that.
void expect_agreement(const Image& image, const Bitmap& reference, const std::string& what) {
  const ZScores z = z_scores(color_of(image), reference, color_of(image, "variance."));
  EXPECT_LT(std::abs(z.tiles.mean), 0.8) << what;
  EXPECT_LT(z.tiles.stddev, 1.5) << what;
  EXPECT_LE(z.tiles.beyond3, 8u) << what << " of " << z.tiles.count;
}

class SlowMediaReferences : public ::testing::TestWithParam<const char*> {};

TEST_P(SlowMediaReferences, AgreeWithMitsubaPlainAndGuided) {
  const fs::path folder = testing::scenes_folder() / kFolder;
  if (!fs::exists(folder)) GTEST_SKIP() << "no scenes at " << folder;
  const std::string name = GetParam();
  const Scene scene(import_mitsuba((folder / ("test_" + name + "_volpath.xml")).string(), {}));
  const Bitmap reference = read_bitmap(
      (folder / "refs" / ("test_" + name + "_ref_rgb.exr")).string(), ColorSpace::linear);
  RenderOptions options;
  options.spp = 256;
  options.aovs.variance = true;
  expect_agreement(render(scene, {}, options, nullptr, {}), reference, name + " plain");
  const testing::Trained trained = testing::train(scene, 200'000);
  options.mode = RenderMode::product;
  options.split = 4;
  expect_agreement(render(scene, trained.caches(), options, nullptr, {}), reference,
                   name + " guided");
}

INSTANTIATE_TEST_SUITE_P(Scenes, SlowMediaReferences,
                         ::testing::Values("homo_null_envmap", "homo_area_light",
                                           "homo_dielectric_envmap", "homo_obj_inside_medium",
                                           "hetero_sigmat", "surf_area_light"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace waylight
