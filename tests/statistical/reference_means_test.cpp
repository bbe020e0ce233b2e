// Means of image regions against renders of other programs, of scenes made elsewhere.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "common/lent_fits.h"
#include "common/scenes_folder.h"
#include "formats/image_io.h"
#include "formats/mitsuba.h"
#include "libguide/brdf_fit.h"
#include "libguide/cache_train.h"
#include "libguide/image/picture.h"
#include "libguide/photon_trace.h"
#include "libguide/render.h"

namespace waylight {
namespace {

namespace fs = std::filesystem;

// Fractions of the image.
struct Region {
  float left = 0, top = 0, right = 1, bottom = 1;
};

struct Case {
  const char *scene, *reference;
  int width, height, spp;
  uint64_t photons;  // 0: plain path tracing
  Region region;
  double agreement;  // between two programs, on top of the noise
  bool two_sided = false;
  int max_depth = 0;  // 0: that of the file
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.scene; }

// The reference has the lamp of 500 W, 523.258 = 500 / (pi 0.30416); the file was edited later.
void restore_lamp(SceneDescription& scene) {
  for (EmitterDescription& emitter : scene.emitters)
    if (AreaLight* light = std::get_if<AreaLight>(&emitter))
      if (std::abs(light->radiance.mean().x() - 156.3258f) < 1e-2f)
        light->radiance = Texture(523.258f);
}

Scene load(const Case& c) {
  ImportOptions options;
  options.two_sided = c.two_sided;
  SceneDescription description =
      import_mitsuba((testing::scenes_folder() / c.scene).string(), options);
  if (c.two_sided) restore_lamp(description);
  return Scene(std::move(description));
}

GuideCache train(const Scene& scene, uint64_t photons) {
  PhotonTraceOptions trace;
  trace.count = photons;
  CacheTrainOptions options;
  options.direct = DirectLight::drop;
  CacheTrainer trainer(options, {scene.bounds(), photons, 0});
  trace_photons(scene, trace, [&](std::span<const Photon> batch) { trainer.consume(batch); }, {});
  return trainer.finish(nullptr);
}

Image rendered(const Scene& scene, const Case& c) {
  RenderOptions options;
  options.spp = c.spp;
  options.width = c.width, options.height = c.height;
  if (c.max_depth > 0) options.max_depth = c.max_depth;
  options.aovs.variance = true;
  if (c.photons == 0) return render(scene, {}, options, nullptr, {});
  const GuideCache guide = train(scene, c.photons);
  BrdfFitOptions fit;
  fit.elevations = 32;
  const BrdfCache brdf = fit_brdfs(scene.description(), fit, {}).cache;
  options.mode = RenderMode::product;
  return render(scene, {testing::lend(brdf), GuideCacheView(guide)}, options, nullptr, {});
}

PixelWindow window(const Region& region, const Case& c) {
  const int x = static_cast<int>(region.left * c.width),
            y = static_cast<int>(region.top * c.height);
  return {x, y, static_cast<int>(region.right * c.width) - x,
          static_cast<int>(region.bottom * c.height) - y};
}

double sum(const Bitmap& picture) {
  double total = 0;
  for (const Color& pixel : picture.pixels) total += pixel.mean();
  return total;
}

// The channels of a pixel go together: the deviation of their mean is at most that of the largest.
double deviation_of_sum(const Bitmap& variance) {
  double total = 0;
  for (const Color& pixel : variance.pixels) total += pixel.maxCoeff();
  return std::sqrt(total);
}

class SlowReferenceMeans : public ::testing::TestWithParam<Case> {};

TEST_P(SlowReferenceMeans, AgreeWithinTheNoise) {
  const Case& c = GetParam();
  if (!fs::exists(testing::scenes_folder()))
    GTEST_SKIP() << "no scenes: set WAYLIGHT_SCENES to their folder";
  const Image image = rendered(load(c), c);
  const Bitmap whole = color_of(read_image((testing::scenes_folder() / c.reference).string()));
  const PixelWindow part = window(c.region, c);
  const double reference = sum(crop(downsample(whole, c.width, c.height), part));
  const double noise = deviation_of_sum(crop(color_of(image, "variance."), part)) / reference;
  const double ratio = sum(crop(color_of(image), part)) / reference;
  EXPECT_LT(noise, 0.02);
  EXPECT_NEAR(ratio, 1, 3 * noise + c.agreement) << "noise " << noise;
  RecordProperty("ratio", std::to_string(ratio));
}

// The windows were chosen after looking at whole images, where the programs agree: this guards what
// agrees and is no proof for the rest. Left out, with ratios of larger renders:
//   living room   leaves cut out by an alpha channel that Mitsuba does not read there, a hearth
//                 that is a mirror in the file and black in the reference; panels and ceiling by
//                 the windows at 0.82 to 0.92: rough plastics with the transmittance of smooth ones
// The kitchen's paths end where those of its reference do; the file says 32 edges.
//   veach-ajar    the glass teapot at 1.15, which absorbs in the reference; left wall and floor at
//                 0.94 to 1.07, where the reference has correlated noise
constexpr Case kCases[] = {
    {"cornell-box/scene.xml", "cornell-box/TungstenRender.exr", 64, 64, 256, 0, {}, 0.005},
    {"veach-ajar/scene_complete.xml",
     "veach-ajar/TungstenRender.exr",
     96,
     54,
     96,
     400'000,
     {0.5f, 0, 1, 0.6f},
     0.02},
    {"veach-bidir/scene.xml",
     "veach-bidir/TungstenRender.exr",
     64,
     64,
     256,
     0,
     {0, 0, 1, 0.5f},
     0.015,
     true},
    {"living-room/scene.xml",
     "living-room/TungstenRender.exr",
     96,
     54,
     128,
     0,
     {0.375f, 0.3f, 0.75f, 1},
     0.02},
    {"kitchenette/simple.xml",
     "kitchenette/kitchenette_ref.exr",
     96,
     72,
     96,
     400'000,
     {},
     0.02,
     false,
     21}};

INSTANTIATE_TEST_SUITE_P(All, SlowReferenceMeans, ::testing::ValuesIn(kCases));

}  // namespace
}  // namespace waylight
