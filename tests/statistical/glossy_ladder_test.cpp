// From glossy to all but a mirror: product guiding has the mean of path tracing and does no harm.

#include <gtest/gtest.h>

#include "common/lent_fits.h"
#include "common/small_scenes.h"
#include "libguide/brdf_fit.h"
#include "libguide/cache_train.h"
#include "libguide/photon_trace.h"
#include "libguide/render.h"

namespace waylight {
namespace {

// A box with a rough metal floor and a metal back wall under a lamp that path tracing finds easily:
// there is little to win, so what a bad fit costs shows.
SceneDescription metal_room(float alpha) {
  SceneDescription scene;
  const int white = testing::add_two_sided(scene, "white", DiffuseMaterial{Texture(0.6f)});
  RoughConductorMaterial metal;
  metal.eta = Color(1.66f, 0.88f, 0.52f);
  metal.k = Color(9.2f, 6.3f, 4.8f);
  metal.alpha_u = metal.alpha_v = Texture(alpha);
  metal.distribution = MicrofacetDistribution::ggx;
  const int shiny = testing::add_two_sided(scene, "shiny", metal);
  const Vec3 x(2, 0, 0), y(0, 2, 0), z(0, 0, 3), corner(-1, -1, -1);
  testing::add_shape(scene, testing::rectangle(corner, z, x), shiny);
  testing::add_shape(scene, testing::rectangle(corner + y, x, z), white);
  testing::add_shape(scene, testing::rectangle(corner, y, z), white);
  testing::add_shape(scene, testing::rectangle(corner + x, z, y), white);
  testing::add_shape(scene, testing::rectangle(corner, x, y), white);
  testing::add_shape(scene, testing::rectangle(corner + z, y, x), shiny);
  const uint32_t lamp =
      testing::add_shape(scene, testing::rectangle({-0.5f, 0.98f, 0}, {1, 0, 0}, {0, 0, 1}), white);
  testing::make_light(scene, lamp, Color(4, 3.5f, 3));
  testing::look_along_z(scene, {0, 0, -0.95f}, 24, 16);
  scene.integrator.max_depth = 8;
  return scene;
}

struct Renders {
  RenderSummary summary;
  double mean = 0, variance = 0;  // of the picture's green
};

Renders render_with(const Scene& scene, const RenderCaches& caches, RenderMode mode, float share,
                    uint64_t seed) {
  RenderOptions options;
  options.mode = mode;
  options.spp = 256;
  options.seed = seed;
  options.roulette = RouletteMode::throughput;  // alike in both
  options.aovs.variance = true;
  if (share > 0) options.share_rule = ShareRule::fixed, options.bsdf_share = share;
  Renders r;
  const Image image = render(scene, caches, options, &r.summary, {});
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      r.mean += image.at(x, y, 1), r.variance += image.at(x, y, 4);
  return r;
}

TEST(SlowGlossyLadder, ProductGuidingDoesNoHarmFromGlossyToNearSpecular) {
  for (const float alpha : {0.5f, 0.2f, 0.1f, 0.05f, 0.02f, 0.01f, 0.005f, 0.002f, 0.001f}) {
    const Scene scene(metal_room(alpha));
    PhotonTraceOptions trace;
    trace.count = 100'000;
    CacheTrainOptions train;
    train.direct = DirectLight::drop;
    CacheTrainer trainer(train, {scene.bounds(), trace.count, 0});
    trace_photons(scene, trace, [&](std::span<const Photon> b) { trainer.consume(b); }, {});
    const GuideCache guide = trainer.finish(nullptr);
    const BrdfCache brdf = fit_brdfs(scene.description(), {}, {}).cache;
    const RenderCaches caches{testing::lend(brdf), GuideCacheView(guide)};
    const Renders bsdf = render_with(scene, caches, RenderMode::bsdf, 0, 1);
    for (const float share : {0.3f, 0.0f}) {  // the default, and learned
      const Renders product = render_with(scene, caches, RenderMode::product, share, 2);
      const double z = (product.mean - bsdf.mean) / std::sqrt(product.variance + bsdf.variance);
      EXPECT_LT(std::abs(z), 3.5) << "alpha " << alpha << " share " << share;
      const double ratio = product.summary.estimated_relmse / bsdf.summary.estimated_relmse;
      EXPECT_LT(ratio, 1.1) << "alpha " << alpha << " share " << share;
    }
  }
}

}  // namespace
}  // namespace waylight
