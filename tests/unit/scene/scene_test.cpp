#include "libguide/scene/scene.h"

#include <gtest/gtest.h>

#include "libguide/base/error.h"
#include "unit/scene/scene_fixtures.h"

namespace waylight {
namespace {

using namespace fixtures;

void expect_near(const Vec3& a, const Vec3& b, float tolerance = 1e-5f) {
  EXPECT_LE((a - b).norm(), tolerance) << a.transpose() << " against " << b.transpose();
}

TEST(Scene, FindsTheNearestOfTwoSurfaces) {
  const Scene scene(scene_of({shape(square(1, 0)), shape(square(1, 2))}));
  const auto hit = scene.intersect({{0.2f, 0.3f, 5}, {0, 0, -1}});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->shape, 1u);
  EXPECT_FLOAT_EQ(hit->t, 3);
  expect_near(hit->p, {0.2f, 0.3f, 2});
  expect_near(hit->ng, Vec3::UnitZ());
  expect_near({hit->uv.x(), hit->uv.y(), 0}, {0.6f, 0.65f, 0});
}

TEST(Scene, MissesBeyondTheEndOfTheRay) {
  const Scene scene(scene_of({shape(square(1, 0))}));
  EXPECT_FALSE(scene.intersect({{0, 0, 5}, {0, 0, -1}, 4.9f}));
  EXPECT_TRUE(scene.intersect({{0, 0, 5}, {0, 0, -1}, 5.1f}));
}

TEST(Scene, TangentsFollowTheTextureCoordinates) {
  const Scene scene(scene_of({shape(square(1, 0))}));
  const auto hit = scene.intersect({{0, 0.5f, 5}, {0, 0, -1}});
  ASSERT_TRUE(hit);
  expect_near(hit->dpdu, {2, 0, 0});
  expect_near(hit->dpdv, {0, 2, 0});
}

TEST(Scene, FlipNormalsTurnsBothNormals) {
  Shape flipped = shape(square(1, 0));
  flipped.flip_normals = true;
  Shape sphere = shape({5, 0, 0}, 1);
  sphere.flip_normals = true;
  const Scene scene(scene_of({flipped, sphere}));
  expect_near(scene.intersect({{0, 0, 5}, {0, 0, -1}})->ng, -Vec3::UnitZ());
  expect_near(scene.intersect({{0, 0, 5}, {0, 0, -1}})->ns, -Vec3::UnitZ());
  expect_near(scene.intersect({{5, 0, 5}, {0, 0, -1}})->ng, -Vec3::UnitZ());
}

TEST(Scene, VertexNormalsAreInterpolatedAndDecideTheSide) {
  TriangleMesh mesh = square(1, 0);
  const Vec3 left = Vec3(-1, 0, -2).normalized(), right = Vec3(1, 0, -2).normalized();
  mesh.normals = {left, right, right, left};
  const Scene scene(scene_of({shape(mesh)}));
  const auto hit = scene.intersect({{0.5f, 0, 5}, {0, 0, -1}});
  expect_near(hit->ng, -Vec3::UnitZ());
  EXPECT_NEAR(hit->ns.norm(), 1, 1e-6);
  EXPECT_GT(hit->ns.x(), 0.1f);
  EXPECT_GT(hit->ns.dot(hit->ng), 0);
}

TEST(Scene, SphereHasOutwardNormalAndPolarCoordinates) {
  const Scene scene(scene_of({shape({1, 2, 3}, 2)}));
  const Vec3 n = Vec3(1, 1, 1).normalized();
  const auto hit = scene.intersect({Vec3(1, 2, 3) + 10 * n, -n});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t, 8, 1e-5);
  expect_near(hit->ng, n);
  EXPECT_NEAR(hit->uv.x(), 0.125f, 1e-5f);
  EXPECT_NEAR(hit->uv.y(), std::acos(n.z()) / kPi, 1e-5f);
  EXPECT_NEAR(hit->dpdu.dot(n), 0, 1e-4);
  expect_near(hit->dpdu.normalized(), Vec3(-1, 1, 0).normalized());
  EXPECT_LT(hit->dpdv.z(), 0);
}

TEST(Scene, SphereIsHitFromInside) {
  const Scene scene(scene_of({shape({1, 2, 3}, 2)}));
  const auto hit = scene.intersect({{1, 2, 3}, Vec3::UnitX()});
  ASSERT_TRUE(hit);
  EXPECT_FLOAT_EQ(hit->t, 2);
  expect_near(hit->ng, Vec3::UnitX());
}

SceneDescription instanced(const Mat4& to_world) {
  SceneDescription scene;
  scene.group_shapes = {shape(square(1, 0)), shape({0, 0, 3}, 0.5f)};
  scene.groups = {{{1}}, {{0, 1}}};
  scene.instances = {{1, to_world}};
  return scene;
}

TEST(Scene, InstanceIsScaledTurnedAndMoved) {
  Mat4 to_world = Mat4::Identity();  // z to x, twice as large
  to_world.topLeftCorner<3, 3>() = 2 * Eigen::AngleAxisf(kPi / 2, Vec3::UnitY()).toRotationMatrix();
  to_world.topRightCorner<3, 1>() = Vec3(10, 0, 0);
  const Scene scene(instanced(to_world));
  const auto square_hit = scene.intersect({{20, 1.5f, 1.5f}, -Vec3::UnitX()});
  ASSERT_TRUE(square_hit);
  EXPECT_EQ(square_hit->shape, 0u);
  expect_near(square_hit->p, {10, 1.5f, 1.5f});
  expect_near(square_hit->ng, Vec3::UnitX());
  EXPECT_NEAR(square_hit->dpdu.norm(), 4, 1e-4);
  const auto sphere_hit = scene.intersect({{20, 0, 0}, -Vec3::UnitX()});
  ASSERT_TRUE(sphere_hit);
  EXPECT_EQ(sphere_hit->shape, 1u);
  expect_near(sphere_hit->p, {17, 0, 0}, 1e-4f);
  expect_near(sphere_hit->ng, Vec3::UnitX());
  EXPECT_NEAR(scene.bounds().max.x(), 17, 1e-4);
  EXPECT_NEAR(scene.bounds().min.x(), 10, 1e-4);
}

TEST(Scene, MirroringInstanceKeepsTheNormalsSide) {
  Mat4 to_world = Mat4::Identity();
  to_world(0, 0) = -1;
  const Scene scene(instanced(to_world));
  expect_near(scene.intersect({{0.9f, 0.3f, 1}, {0, 0, -1}})->ng, Vec3::UnitZ());
}

SceneDescription with_panes(int panes, const MaterialModel& model) {
  SceneDescription scene = scene_of({shape(square(1, 0))});
  for (int i = 0; i < panes; ++i) scene.shapes.push_back(shape(square(1, 1.0f + i), 0));
  scene.materials = {{"pane", model}};
  return scene;
}

TEST(Scene, VisibilityIsBlockedByAnOpaqueSurfaceAndNotByTheTarget) {
  const Scene scene(scene_of({shape(square(1, 0)), shape(square(1, 2)), shape(square(1, 5))}));
  const auto from = scene.intersect({{0, 0.1f, 1}, {0, 0, -1}});
  EXPECT_EQ(scene.visibility(*from, Vec3::UnitZ(), 2).x(), 1);
  EXPECT_EQ(scene.visibility(*from, Vec3::UnitZ(), 5).x(), 0);
  EXPECT_EQ(scene.visibility(*from, Vec3::UnitZ(), kInfinity).x(), 0);
  EXPECT_EQ(scene.visibility(*from, Vec3(2, 0, 1).normalized(), kInfinity).x(), 1);
}

TEST(Scene, VisibilityPassesNullSurfaces) {
  const Scene scene(with_panes(3, NullMaterial{}));
  const auto from = scene.intersect({{0, 0.1f, 0.5f}, {0, 0, -1}});
  EXPECT_EQ(scene.visibility(*from, Vec3::UnitZ(), kInfinity).x(), 1);
}

TEST(Scene, VisibilityMultipliesWhatEachMaskLetsPass) {
  SceneDescription description = with_panes(3, MaskMaterial{1, Texture(0.25f)});
  description.materials.push_back({"nested", DiffuseMaterial{}});
  const Scene scene(std::move(description));
  const auto from = scene.intersect({{0, 0.1f, 0.5f}, {0, 0, -1}});
  EXPECT_NEAR(scene.visibility(*from, Vec3::UnitZ(), kInfinity).x(), 0.75f * 0.75f * 0.75f, 1e-6);
  EXPECT_NEAR(scene.visibility(*from, Vec3::UnitZ(), 2.5f).x(), 0.75f * 0.75f, 1e-6);
}

TEST(Scene, VisibilitySeesAnOpaqueSurfaceBehindTransparentOnes) {
  SceneDescription description = with_panes(3, NullMaterial{});
  description.shapes.push_back(shape(square(1, 9)));
  const Scene scene(std::move(description));
  const auto from = scene.intersect({{0, 0.1f, 0.5f}, {0, 0, -1}});
  EXPECT_EQ(scene.visibility(*from, Vec3::UnitZ(), kInfinity).x(), 0);
  EXPECT_EQ(scene.visibility(*from, Vec3::UnitZ(), 8).x(), 1);
}

TEST(Scene, InstancedMasksAreCrossedToo) {
  SceneDescription description = with_panes(0, MaskMaterial{1, Texture(0.25f)});
  description.materials.push_back({"nested", DiffuseMaterial{}});
  description.group_shapes = {shape(square(1, 0), 0)};
  description.groups = {{{0}}};
  Mat4 up = Mat4::Identity();
  up(2, 3) = 2;
  description.instances = {{0, up}};
  const Scene scene(std::move(description));
  const auto from = scene.intersect({{0, 0.1f, 0.5f}, {0, 0, -1}});
  EXPECT_NEAR(scene.visibility(*from, Vec3::UnitZ(), kInfinity).x(), 0.75f, 1e-6);
}

TEST(Scene, AreaLightShinesOnItsNormalsSideOnly) {
  SceneDescription description = scene_of({shape(square(1, 0))});
  make_light(description, 0, Texture(Color(1, 2, 3)));
  const Scene scene(std::move(description));
  const auto above = scene.intersect({{0, 0.1f, 1}, {0, 0, -1}});
  const auto below = scene.intersect({{0, 0.1f, -1}, {0, 0, 1}});
  EXPECT_EQ(scene.emitted(*above, Vec3::UnitZ()).y(), 2);
  EXPECT_EQ(scene.emitted(*below, -Vec3::UnitZ()).maxCoeff(), 0);
  EXPECT_TRUE(scene.sample_light({0, 0, 1}, 0.5f, {0.3f, 0.4f}));
  EXPECT_FALSE(scene.sample_light({0, 0, -1}, 0.5f, {0.3f, 0.4f}));
}

TEST(Scene, RefusesAnAreaLightInAShapeGroup) {
  SceneDescription description = instanced(Mat4::Identity());
  description.emitters = {AreaLight{Texture(1.0f), 0}};
  description.group_shapes[0].emitter = 0;
  EXPECT_THROW(Scene{std::move(description)}, Error);
}

TEST(Scene, RefusesIndicesThatLeadNowhere) {
  SceneDescription bad_vertex = scene_of({shape(square(1, 0))});
  std::get<TriangleMesh>(bad_vertex.shapes[0].geometry).triangles[0][2] = 4;
  EXPECT_THROW(Scene{std::move(bad_vertex)}, Error);
  EXPECT_THROW(Scene{scene_of({shape(square(1, 0), 7)})}, Error);
}

}  // namespace
}  // namespace waylight
