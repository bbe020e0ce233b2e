// Importance is the adjoint of radiance: what importons say of emitters is what photons would say
// of the camera.

#include <gtest/gtest.h>

#include "common/small_scenes.h"
#include "libguide/photon_trace.h"
#include "libguide/render.h"

namespace waylight {
namespace {

struct Estimate {
  double mean = 0, variance = 0;  // of the mean
};

Estimate estimate_of(const std::vector<double>& values) {
  Estimate e;
  double sum2 = 0;
  for (const double v : values) e.mean += v / values.size(), sum2 += v * v;
  const double n = double(values.size());
  e.variance = (sum2 / n - e.mean * e.mean) / (n - 1);
  return e;
}

double z_score(const Estimate& a, const Estimate& b) {
  return (a.mean - b.mean) / std::sqrt(a.variance + b.variance);
}

// Green channel of the mean of the image, by path tracing.
Estimate image_mean(const Scene& scene, int spp) {
  RenderOptions options;
  options.spp = spp;
  options.seed = 5;
  options.aovs.variance = true;
  const Image image = render(scene, {}, options, nullptr, {});
  Estimate e;
  const double pixels = double(image.width) * image.height;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      e.mean += image.at(x, y, 1) / pixels;
      e.variance += image.at(x, y, 4) / (pixels * pixels);
    }
  return e;
}

// Sum of power times emitted radiance over the importons that hit emitters or leave the scene.
double emission_met(const Scene& scene, uint32_t pass, uint64_t count) {
  PhotonTraceOptions options;
  options.quantity = Quantity::importance;
  options.count = count;
  options.pass = pass;
  options.max_depth = scene.description().integrator.max_depth - 1;  // edges less the first
  double sum = 0;
  trace_photons(
      scene, options,
      [&](std::span<const Photon> photons) {
        for (const Photon& p : photons) {
          const Vec3 back = p.position + 1e-3f * p.direction;
          const auto at = scene.intersect({back, -p.direction});
          if (at && at->t < 2e-3f) sum += p.power.y() * scene.emitted(*at, p.direction).y();
        }
      },
      {},
      [&](std::span<const Escape> escapes) {
        for (const Escape& e : escapes) sum += e.power.y() * scene.environment(e.direction).y();
      });
  return sum;
}

void expect_dual(const SceneDescription& description, uint64_t count, int spp) {
  const Scene scene(description);
  std::vector<double> batches;
  for (uint32_t pass = 0; pass < 16; ++pass) batches.push_back(emission_met(scene, pass, count));
  const Estimate importons = estimate_of(batches), image = image_mean(scene, spp);
  EXPECT_LT(std::abs(z_score(importons, image)), 3.5) << importons.mean << " and " << image.mean;
  EXPECT_LT(std::sqrt(importons.variance), 0.03 * image.mean) << "the test sees little";
}

TEST(Importance, MetEmittersGiveTheMeanOfTheImage) { expect_dual(testing::gap_box(), 40000, 512); }

TEST(Importance, EscapesGiveTheMeanOfTheImage) { expect_dual(testing::window_box(), 20000, 512); }

// Refraction scales radiance, and importons with it; roulette must not undo that.
TEST(Importance, PassesGlassAsRadianceDoes) {
  SceneDescription scene = testing::window_box();
  const int glass = testing::add_material(scene, "glass", DielectricMaterial{});
  testing::add_shape(scene, Sphere{Vec3(0.2f, 0, 0), 0.5f}, glass);
  scene.integrator.max_depth = 16;
  expect_dual(scene, 20000, 512);
}

TEST(Importance, SeesTheCropWindowOnly) {
  SceneDescription scene = testing::gap_box();
  FilmDescription& film = scene.sensor.film;
  film.crop_x = 16, film.crop_width = 8, film.crop_y = 4, film.crop_height = 8;
  expect_dual(scene, 40000, 1024);
}

TEST(Importance, LeavesNoEscapesWhereNoLightIsDistant) {
  const Scene scene(testing::gap_box());
  PhotonTraceOptions options;
  options.quantity = Quantity::importance;
  options.count = 1000;
  const PhotonTraceSummary summary = trace_photons(scene, options, [](auto) {}, {});
  EXPECT_GT(summary.stored, 1000u);
  EXPECT_EQ(summary.escapes, 0u);
}

}  // namespace
}  // namespace waylight
