// F13 and F15 of the failure catalogue at the level of the scene: scale, displacement, degenerate
// input. What a ray tracer gets wrong here shows as leaks and as surfaces that shadow themselves.

#include <gtest/gtest.h>

#include "libguide/base/sampler.h"
#include "libguide/math/frame.h"
#include "libguide/math/warp.h"
#include "unit/scene/scene_fixtures.h"

namespace waylight {
namespace {

using namespace fixtures;

// Size and place of a closed surface around `center`.
struct Setting {
  float scale, offset;
  Vec3 center() const { return Vec3(offset, -0.7f * offset, 0.3f * offset); }
};

std::ostream& operator<<(std::ostream& out, const Setting& s) {
  return out << "scale " << s.scale << " moved by " << s.offset;
}

struct Walk {
  int leaks = 0;       // rays that left a closed surface
  int wrong_side = 0;  // hits from behind: the walk got through a wall
};

// Diffuse bounces inside a closed surface whose normals face inwards.
Walk walk_inside(const Scene& scene, const Vec3& start, int paths, int bounces) {
  Walk result;
  for (int path = 0; path < paths; ++path) {
    Sampler sampler(7, 0, path);
    Ray ray{start, square_to_sphere(sampler.next_2d())};
    for (int bounce = 0; bounce < bounces; ++bounce) {
      const auto hit = scene.intersect(ray);
      if (!hit) {
        ++result.leaks;
        break;
      }
      if (hit->ng.dot(ray.direction) > 0) {
        ++result.wrong_side;
        break;
      }
      const Vec3 local = square_to_cosine_hemisphere(sampler.next_2d());
      ray = scene.spawn_ray(*hit, Frame(hit->ng).to_world(local).normalized());
    }
  }
  return result;
}

// The box turned by an odd angle, so that no wall is parallel to an axis.
TriangleMesh turned_room(const Setting& s) {
  TriangleMesh mesh = room(s.scale);
  const Mat3 turn = Eigen::AngleAxisf(0.7f, Vec3(1, 2, -0.5f).normalized()).toRotationMatrix();
  for (Vec3& p : mesh.positions)
    p = ((turn * p).cast<double>() + s.center().cast<double>()).cast<float>();
  return mesh;
}

// A sphere of triangles, facing inwards.
TriangleMesh globe(const Setting& s, int rings) {
  TriangleMesh mesh;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < 2 * rings; ++j) {
      const double theta = std::numbers::pi * i / rings, phi = std::numbers::pi * j / rings;
      const Eigen::Vector3d n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                              std::cos(theta));
      mesh.positions.push_back(
          (s.center().cast<double>() + static_cast<double>(s.scale) * n).cast<float>());
    }
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < 2 * rings; ++j) {
      const auto at = [&](int ring, int k) -> uint32_t {
        const bool pole = ring == 0 || ring == rings;  // one vertex, or the sphere has slits
        return ring * 2 * rings + (pole ? 0 : k % (2 * rings));
      };
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  return mesh;
}

class ScaleTest : public testing::TestWithParam<Setting> {};

TEST_P(ScaleTest, ClosedBoxDoesNotLeak) {
  const Setting s = GetParam();
  const Scene scene(scene_of({shape(room(s.scale, s.center()))}));
  const Walk walk = walk_inside(scene, s.center(), 2000, 50);
  EXPECT_EQ(walk.leaks + walk.wrong_side, 0);
}

TEST_P(ScaleTest, TurnedBoxDoesNotLeak) {
  const Setting s = GetParam();
  const Scene scene(scene_of({shape(turned_room(s))}));
  const Walk walk = walk_inside(scene, s.center(), 2000, 50);
  EXPECT_EQ(walk.leaks + walk.wrong_side, 0);
}

TEST_P(ScaleTest, FineMeshDoesNotLeak) {
  const Setting s = GetParam();
  const Scene scene(scene_of({shape(globe(s, 24))}));
  const Walk walk = walk_inside(scene, s.center(), 2000, 50);
  EXPECT_EQ(walk.leaks + walk.wrong_side, 0);
}

TEST_P(ScaleTest, SphereDoesNotLeak) {
  const Setting s = GetParam();
  Shape sphere = shape(s.center(), s.scale);
  sphere.flip_normals = true;
  const Scene scene(scene_of({sphere}));
  const Walk walk = walk_inside(scene, s.center(), 2000, 50);
  EXPECT_EQ(walk.leaks + walk.wrong_side, 0);
}

TEST_P(ScaleTest, InstancedBoxDoesNotLeak) {
  const Setting s = GetParam();
  SceneDescription description;
  description.group_shapes = {shape(room(1))};
  description.groups = {{{0}}};
  Mat4 to_world = Mat4::Identity();
  to_world.topLeftCorner<3, 3>() =
      s.scale * Eigen::AngleAxisf(0.7f, Vec3(1, 2, -0.5f).normalized()).toRotationMatrix();
  to_world.topRightCorner<3, 1>() = s.center();
  description.instances = {{0, to_world}};
  const Scene scene(std::move(description));
  const Walk walk = walk_inside(scene, s.center(), 2000, 50);
  EXPECT_EQ(walk.leaks + walk.wrong_side, 0);
}

// From every point of the floor the lamp overhead is visible, and hidden from below it.
TEST_P(ScaleTest, ShadowRaysReachTheLampAndNothingBehindIt) {
  const Setting s = GetParam();
  const auto moved = [&](TriangleMesh mesh) {
    for (Vec3& p : mesh.positions)
      p = (p.cast<double>() * s.scale + s.center().cast<double>()).cast<float>();
    return mesh;
  };
  SceneDescription description =
      scene_of({shape(moved(square(1, 0))), shape(moved(square(0.5f, 1, false)))});
  make_light(description, 1, Texture(1.0f));
  const Scene scene(std::move(description));
  Sampler sampler(3, 0, 0);
  int blocked = 0, leaked = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec2 at = 1.8f * (sampler.next_2d() - Vec2(0.5f, 0.5f));
    const Vec3 above = s.center() + s.scale * Vec3(at.x(), at.y(), 0.5f);
    const auto floor = scene.intersect({above, -Vec3::UnitZ()});
    ASSERT_TRUE(floor);
    const auto light = scene.sample_light(floor->p, sampler.next(), sampler.next_2d());
    ASSERT_TRUE(light);
    blocked += scene.visibility(*floor, light->wi, light->distance).x() < 1;
    leaked += scene.visibility(*floor, light->wi, 1.2f * light->distance).x() > 0;
  }
  EXPECT_EQ(blocked, 0);
  EXPECT_EQ(leaked, 0);
}

INSTANTIATE_TEST_SUITE_P(ScalesAndPlaces, ScaleTest,
                         testing::Values(Setting{1, 0}, Setting{1e-4f, 0}, Setting{1e4f, 0},
                                         Setting{1, 1e5f}, Setting{1e4f, 1e5f}, Setting{1e-4f, 1},
                                         Setting{1e-4f, 10}));

TEST(DegenerateGeometry, IsCountedAndLeftOut) {
  TriangleMesh mesh = square(1, 0);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  mesh.positions.push_back({nan, 0, 0});
  mesh.positions.push_back({kInfinity, 0, 0});
  mesh.uvs.resize(6, Vec2(nan, 0));
  mesh.triangles.push_back({0, 0, 1});  // no area
  mesh.triangles.push_back({0, 1, 4});
  mesh.triangles.push_back({0, 1, 5});
  const Scene scene(scene_of({shape(mesh)}));
  ASSERT_EQ(scene.build_warnings().size(), 1u);
  EXPECT_NE(scene.build_warnings()[0].find("3 of 5"), std::string::npos)
      << scene.build_warnings()[0];
  EXPECT_TRUE(scene.bounds().max.allFinite());
  const auto hit = scene.intersect({{0.3f, 0.2f, 1}, {0, 0, -1}});
  ASSERT_TRUE(hit);
  EXPECT_TRUE(hit->p.allFinite() && hit->ns.allFinite() && hit->uv.allFinite());
}

TEST(DegenerateGeometry, BadVertexNormalsFallBackToTheFace) {
  TriangleMesh mesh = square(1, 0);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  mesh.normals = {Vec3::Zero(), Vec3(nan, 0, 1), Vec3::Zero(), Vec3::Zero()};
  const Scene scene(scene_of({shape(mesh)}));
  EXPECT_EQ(scene.build_warnings().size(), 1u);
  const auto hit = scene.intersect({{0.3f, 0.2f, 1}, {0, 0, -1}});
  EXPECT_EQ(hit->ns, hit->ng);
}

TEST(DegenerateGeometry, CollapsedTextureCoordinatesStillGiveTangents) {
  TriangleMesh mesh = square(1, 0);
  mesh.uvs.assign(4, Vec2(0.5f, 0.5f));
  const Scene scene(scene_of({shape(mesh)}));
  const auto hit = scene.intersect({{0.3f, 0.2f, 1}, {0, 0, -1}});
  EXPECT_NEAR(hit->dpdu.norm(), 1, 1e-5);
  EXPECT_NEAR(hit->dpdu.dot(hit->ng), 0, 1e-5);
}

// Needles 1000 times longer than wide, upon which rays must not meet the needle itself.
TEST(DegenerateGeometry, NeedlesDoNotShadowThemselves) {
  constexpr int kNeedles = 100;
  TriangleMesh mesh;
  const Mat3 turn = Eigen::AngleAxisf(0.9f, Vec3(3, 1, 2).normalized()).toRotationMatrix();
  for (int i = 0; i <= kNeedles; ++i)
    for (const float y : {-1.0f, 1.0f}) mesh.positions.push_back(turn * Vec3(0.002f * i, y, 0));
  for (uint32_t i = 0; i < kNeedles; ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  const Scene scene(scene_of({shape(mesh)}));
  int found = 0, shadowed = 0;
  for (int i = 0; i < 10000; ++i) {
    Sampler sampler(11, 0, i);
    const Vec2 at = sampler.next_2d();
    const Vec3 above = turn * Vec3(0.2f * at.x(), 2 * at.y() - 1, 1);
    const auto hit = scene.intersect({above, turn * -Vec3::UnitZ()});
    if (!hit) continue;
    ++found;
    const Vec3 wi = turn * square_to_cosine_hemisphere(sampler.next_2d());
    shadowed += scene.visibility(*hit, wi, kInfinity).x() < 1;
  }
  EXPECT_GT(found, 9900);
  EXPECT_EQ(shadowed, 0);
}

TEST(DegenerateGeometry, DuplicateFacesAreASurfaceLikeAnyOther) {
  const Scene scene(scene_of({shape(square(1, 0)), shape(square(1, 0))}));
  const auto hit = scene.intersect({{0.3f, 0.2f, 1}, {0, 0, -1}});
  ASSERT_TRUE(hit);
  EXPECT_EQ(scene.visibility(*hit, Vec3::UnitZ(), kInfinity).x(), 1);
  EXPECT_EQ(scene.visibility(*hit, -Vec3::UnitZ(), kInfinity).x(), 1);
}

TEST(EmptyScene, AnswersEveryQuestion) {
  const Scene scene{SceneDescription{}};
  EXPECT_FALSE(scene.intersect({Vec3::Zero(), Vec3::UnitX()}));
  EXPECT_FALSE(scene.has_lights());
  EXPECT_FALSE(scene.sample_light(Vec3::Zero(), 0.5f, {0.5f, 0.5f}));
  EXPECT_FALSE(scene.sample_emission(0.5f, {0.5f, 0.5f}, {0.5f, 0.5f}));
  EXPECT_EQ(scene.environment(Vec3::UnitX()).maxCoeff(), 0);
  EXPECT_EQ(scene.environment_pdf(Vec3::UnitX()), 0);
}

TEST(EmptyScene, HasAnEnvironmentThatIsSeenAndLightsNothing) {
  SceneDescription description;
  description.emitters.push_back(ConstantEnvironment{Color::Zero()});
  EXPECT_FALSE(Scene(description).has_environment());
  description.emitters.push_back(ConstantEnvironment{Color::Ones()});
  const Scene scene(std::move(description));
  EXPECT_TRUE(scene.has_environment());
  EXPECT_FALSE(scene.has_lights());
  EXPECT_EQ(scene.environment(Vec3::UnitX()).x(), 1);
}

TEST(EmptyScene, MeshWithoutTrianglesIsAllowed) {
  const Scene scene(scene_of({shape(TriangleMesh{}), shape(square(1, 0))}));
  EXPECT_EQ(scene.intersect({{0.3f, 0.2f, 1}, {0, 0, -1}})->shape, 1u);
}

TEST(Instances, OneWithoutInverseIsCountedAndLeftOut) {
  SceneDescription description;
  description.group_shapes = {shape(square(1, 0))};
  description.groups = {{{0}}};
  description.instances = {{0, Mat4::Zero()}, {0, Mat4::Identity()}};
  const Scene scene(std::move(description));
  EXPECT_EQ(scene.build_warnings().size(), 1u);
  EXPECT_TRUE(scene.intersect({{0.3f, 0.2f, 1}, {0, 0, -1}}));
}

}  // namespace
}  // namespace waylight
