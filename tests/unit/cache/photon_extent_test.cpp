#include "libguide/cache/photon_extent.h"

#include <gtest/gtest.h>

#include "libguide/base/sampler.h"

namespace waylight {
namespace {

Vec3 in_unit_cube(uint64_t i) {
  Sampler sampler(1, 2, i);
  const Vec2 xy = sampler.next_2d();
  return {xy.x(), xy.y(), sampler.next()};
}

PhotonExtent of_unit_cube(int count) {
  PhotonExtent extent;
  for (int i = 0; i < count; ++i) extent.add(in_unit_cube(i));
  return extent;
}

TEST(PhotonExtent, IsThatOfPhotonsSpreadEvenly) {
  for (const int count : {64, 1024, 16384}) {
    const Bounds box = of_unit_cube(count).box();
    EXPECT_LT(box.min.maxCoeff(), 16.0f / count);
    EXPECT_GT(box.max.minCoeff(), 1 - 16.0f / count);
    EXPECT_GE(box.min.minCoeff(), 0);
    EXPECT_LE(box.max.maxCoeff(), 1);
  }
}

TEST(PhotonExtent, LeavesOutTwoStrayPhotonsOnEachSideAndNoMore) {
  PhotonExtent extent = of_unit_cube(1024);
  for (int stray = 0; stray < 2; ++stray) {
    extent.add({5, 0.5f, 0.5f});
    extent.add({0.5f, -5, 0.5f});
  }
  EXPECT_LE(extent.box().max.x(), 1);
  EXPECT_GE(extent.box().min.y(), 0);
  extent.add({5, 0.5f, 0.5f});
  EXPECT_EQ(extent.box().max.x(), 5);
  EXPECT_GE(extent.box().min.y(), 0);
  extent.add({0.5f, -5, 0.5f});
  EXPECT_EQ(extent.box().min.y(), -5);
}

TEST(PhotonExtent, IsEmptyBeforeEachGroupHasAPhoton) {
  EXPECT_TRUE(of_unit_cube(7).box().empty());
  EXPECT_FALSE(of_unit_cube(8).box().empty());
}

}  // namespace
}  // namespace waylight
