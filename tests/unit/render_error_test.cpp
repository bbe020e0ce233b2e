// Where a render ends that is given an error.

#include <gtest/gtest.h>

#include <cmath>

#include "common/small_scenes.h"
#include "libguide/render.h"

namespace waylight {
namespace {

RenderSummary rendered(const Scene& scene, const RenderOptions& options) {
  RenderSummary summary;
  render(scene, {}, options, &summary, {}, [](double, const Image&, const RenderSummary&) {});
  return summary;
}

TEST(RenderToAnError, EndsAtTheSameSampleWhereverCheckpointsCutPasses) {
  const Scene scene(testing::gap_box(8, 8));
  RenderOptions options;
  options.mode = RenderMode::bsdf;
  options.spp = 32;
  options.error = 1.2 * rendered(scene, options).estimated_relmse;
  options.spp = 1000;
  const double samples = rendered(scene, options).mean_spp;
  EXPECT_EQ(std::fmod(samples, 16), 0);
  for (int i = 1; i <= 2000; ++i) options.checkpoints.push_back(1e-4 * i);  // after every sample
  EXPECT_EQ(rendered(scene, options).mean_spp, samples);
}

}  // namespace
}  // namespace waylight
