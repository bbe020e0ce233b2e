// Directions of sample_light follow the density that light_pdf and environment_pdf state for them.

#include "libguide/math/frame.h"
#include "statistical/density_assertions.h"
#include "unit/scene/emitter_fixtures.h"

namespace waylight {
namespace {

using namespace fixtures;
using testing::DensityCheck;
using testing::expect_valid_density;

// Density with which next-event estimation makes the direction, as a BSDF sample learns it. Lights
// must not stand before one another.
float density_along(const Scene& scene, const Vec3& from, const Vec3& w) {
  const auto hit = scene.intersect({from, w});
  if (!hit) return scene.environment_pdf(w);
  return hit->emitter == kNone ? 0.0f : scene.light_pdf(from, *hit, w);
}

std::optional<Vec3> sample_direction(const Scene& scene, const Vec3& from, Sampler& sampler) {
  const float u = sampler.next();
  const auto light = scene.sample_light(from, u, sampler.next_2d());
  return light ? std::optional<Vec3>(light->wi) : std::nullopt;
}

void expect_valid_lights(SceneDescription description, const std::string& name, const Vec3& from) {
  const Scene scene(std::move(description));
  DensityCheck check;
  check.tests = 10;
  expect_valid_density(
      testing::Sphere{}, name,
      [&](Sampler& sampler) { return sample_direction(scene, from, sampler); },
      [&](const Vec3& w) { return density_along(scene, from, w); }, check);
}

// The lights alone, with a far dot to give the scene its extent: nothing may hide a light.
SceneDescription lights_only(SceneDescription description) {
  description.shapes[0] = shape(Vec3(0, 0, -30), 0.01f);
  return description;
}

class LightDensity : public ::testing::TestWithParam<EmitterCase> {};

TEST_P(LightDensity, IsThatOfItsSamples) {
  expect_valid_lights(lights_only(GetParam().make()), GetParam().name, {0.05f, 0.02f, 0.01f});
}

// Disks have a test of their own: a k-d tree of directions cannot follow their rim.
std::vector<EmitterCase> cases_with_density() {
  std::vector<EmitterCase> cases;
  for (const EmitterCase& c : emitter_cases())
    if (const EmitterDescription light = c.make().emitters[0];
        !std::holds_alternative<PointLight>(light) && !std::holds_alternative<SpotLight>(light) &&
        !std::holds_alternative<DirectionalLight>(light) &&
        !std::holds_alternative<DistantDisk>(light))
      cases.push_back(c);
  return cases;
}

INSTANTIATE_TEST_SUITE_P(EmittersWithExtent, LightDensity,
                         ::testing::ValuesIn(cases_with_density()));

class DiskDensity : public ::testing::TestWithParam<float> {};

// In coordinates ((1 - cos) / height, azimuth / 2 pi) of its cone a disk is the unit square.
TEST_P(DiskDensity, IsUniformOverTheCone) {
  const DistantDisk disk{Vec3(0.2f, 0.5f, 0.7f).normalized(), std::cos(GetParam()), Color::Ones()};
  const Scene scene(lights_only(patch_under(disk)));
  const float height = 1 - disk.cos_angle;
  const Frame frame(disk.to_light);
  DensityCheck check;
  check.tests = 10;
  expect_valid_density(
      testing::Rectangle{}, "disk",
      [&](Sampler& sampler) -> std::optional<Vec2> {
        const std::optional<Vec3> w = sample_direction(scene, Vec3::Zero(), sampler);
        const Vec3 local = frame.to_local(*w - disk.to_light);
        const float phi = std::atan2(local.y(), local.x());
        return Vec2(0.5f * local.squaredNorm() / height,
                    (phi < 0 ? phi + 2 * kPi : phi) / (2 * kPi));
      },
      [&](const Vec2& y) {
        const float h = y.x() * height, phi = 2 * kPi * y.y(), r = std::sqrt(h * (2 - h));
        const Vec3 w = frame.to_world({r * std::cos(phi), r * std::sin(phi), 1 - h});
        return scene.environment_pdf(w.normalized()) * 2 * kPi * height;
      },
      check);
}

INSTANTIATE_TEST_SUITE_P(AngularRadii, DiskDensity, ::testing::Values(0.00465f, 0.2f, 2.5f));

TEST(LightDensity, OfManyLightsIsTheMixture) {
  SceneDescription scene = lights_only(patch_under(uneven_map()));
  scene.emitters.push_back(DistantDisk{Vec3(-1, 0.5f, 0.3f).normalized(), 0.95f, Color::Ones()});
  scene.shapes.push_back(shape(square(0.3f, 1, false)));
  make_light(scene, 1, Texture(100.0f));
  scene.shapes.push_back(shape(Vec3(2, 0, -1), 0.3f));
  make_light(scene, 2, Texture(1.0f));
  const Scene built{SceneDescription(scene)};
  // A distant direction behind a near light is sampled in vain: it counts as failed on both sides.
  const Vec3 from(0.05f, 0.02f, 0.01f);
  expect_valid_density(
      testing::Sphere{}, "many lights",
      [&](Sampler& sampler) -> std::optional<Vec3> {
        const float u = sampler.next();
        const auto light = built.sample_light(from, u, sampler.next_2d());
        if (!light) return std::nullopt;
        const auto hit = built.intersect({from, light->wi});
        const bool hidden = hit && light->distance == kInfinity;
        return hidden ? std::nullopt : std::optional<Vec3>(light->wi);
      },
      [&](const Vec3& w) { return density_along(built, from, w); });
}

}  // namespace
}  // namespace waylight
