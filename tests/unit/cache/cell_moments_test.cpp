#include "libguide/cache/cell_moments.h"

#include <gtest/gtest.h>

#include "libguide/base/sampler.h"
#include "libguide/cache/cell_split.h"
#include "libguide/math/frame.h"

namespace waylight {
namespace {

Photon photon_at(const Vec3& position, const Vec3& normal = Vec3::UnitZ()) {
  return {position, normal, normal, Color::Ones(), 0};
}

CellTraining moments_of(std::span<const Photon> photons, size_t batch) {
  CellTraining cell;
  for (size_t begin = 0; begin < photons.size(); begin += batch) {
    MomentBatch moments(cell, photons[begin]);
    for (const Photon& p : photons.subspan(begin, std::min(batch, photons.size() - begin)))
      moments.add(p, 2);
    moments.merge_into(cell);
  }
  return cell;
}

// An evenly lit rectangle of sides a and b in the plane of a normal.
std::vector<Photon> rectangle(float a, float b, const Vec3& normal, const Vec3& center, int count) {
  const Frame frame(normal);
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    const Vec2 u = Sampler(1, 2, i).next_2d();
    photons.push_back(photon_at(
        center + frame.to_world(Vec3((u.x() - 0.5f) * a, (u.y() - 0.5f) * b, 0)), normal));
  }
  return photons;
}

TEST(CellMoments, AgreeWithTheDefinition) {
  const std::vector<Photon> photons = rectangle(3, 1, Vec3(1, 2, 2) / 3, Vec3(4, 5, 6), 1000);
  const CellTraining cell = moments_of(photons, 77);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero(), m2 = mean;
  for (const Photon& p : photons) mean += p.position.cast<double>() / 1000;
  double xy = 0;
  for (const Photon& p : photons) {
    const Eigen::Vector3d d = p.position.cast<double>() - mean;
    m2 += d.cwiseProduct(d);
    xy += d.x() * d.y();
  }
  EXPECT_EQ(cell.count, 1000);
  EXPECT_EQ(cell.flux, 2000);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(cell.position_mean[i], mean[i], 1e-5);
    EXPECT_NEAR(cell.position_m2[i], m2[i], 1e-4 * m2[i]);
  }
  EXPECT_NEAR(cell.position_cross.x(), xy, 1e-3 * std::abs(xy));
}

TEST(CellMoments, HoldFarFromTheOrigin) {
  const Vec3 far = Vec3::Constant(1e5f);  // floats are 0.008 apart there
  const CellTraining near_cell =
      moments_of(rectangle(40, 20, Vec3::UnitZ(), Vec3::Zero(), 4000), 64);
  const CellTraining far_cell = moments_of(rectangle(40, 20, Vec3::UnitZ(), far, 4000), 64);
  EXPECT_NEAR(far_cell.position_m2.x(), near_cell.position_m2.x(),
              1e-3 * near_cell.position_m2.x());
  EXPECT_NEAR(photon_area(far_cell), photon_area(near_cell), 1);
}

TEST(CellMoments, AreaOfALitRectangleInAnyPlane) {
  for (const Vec3& normal :
       {Vec3(0, 0, 1), Vec3(0, -1, 0), Vec3(1, 2, 2), Vec3(-0.3f, 0.1f, -0.9f)}) {
    const CellTraining cell =
        moments_of(rectangle(0.3f, 0.07f, normal.normalized(), Vec3(-7, 3, 2), 4096), 500);
    EXPECT_NEAR(photon_area(cell), 0.021, 0.02 * 0.021);
  }
}

TEST(CellMoments, PhotonsInOnePlaceCoverNoArea) {
  EXPECT_EQ(photon_area(CellTraining()), 0);
  EXPECT_EQ(photon_area(moments_of(std::vector<Photon>(100, photon_at(Vec3(1, 2, 3))), 7)), 0);
}

TEST(CellMoments, MeanNormalFallsBackWhenNormalsCancel) {
  const std::vector<Photon> wall = {photon_at(Vec3::Zero(), Vec3::UnitX()),
                                    photon_at(Vec3::Zero(), -Vec3::UnitX())};
  EXPECT_EQ(mean_normal(moments_of(wall, 2), Vec3::UnitY()), Vec3::UnitY());
}

TEST(CellMoments, CountsNeverStickAtTheLastExactFloat) {
  CellTraining cell = moments_of(rectangle(2, 2, Vec3::UnitZ(), Vec3::Zero(), 64), 64);
  const float variance = cell.position_m2.x() / cell.count;
  cell.position_m2 *= 0x1p18f, cell.normal_m2 *= 0x1p18f, cell.position_cross *= 0x1p18f;
  cell.count *= 0x1p18f;
  MomentBatch one(cell, photon_at(Vec3::Zero()));
  one.add(photon_at(Vec3::Zero()), 1);
  one.add(photon_at(Vec3::Zero()), 1);
  one.merge_into(cell);
  EXPECT_LT(cell.count, 0x1p24f);
  EXPECT_NEAR(cell.position_m2.x() / cell.count, variance, 1e-3f * variance);
}

TEST(CellSplit, TakesTheWidestPositionAxisAtTheMean) {
  const auto split = choose_split(
      moments_of(rectangle(1, 4, Vec3::UnitZ(), Vec3(9, 5, 2), 1024), 64), 0.9f, 1e-6f);
  ASSERT_TRUE(split);
  EXPECT_EQ(split->axis, 1u);
  EXPECT_NEAR(split->value, 5, 0.02f);
  EXPECT_FALSE(split->by_normal());
}

TEST(CellSplit, SeparatesTheSidesOfAThinWallFirst) {
  std::vector<Photon> wall = rectangle(1, 4, Vec3::UnitX(), Vec3::Zero(), 500);
  const std::vector<Photon> back = rectangle(1, 4, -Vec3::UnitX(), Vec3::Zero(), 100);
  wall.insert(wall.end(), back.begin(), back.end());
  const auto split = choose_split(moments_of(wall, 64), 0.9f, 1e-6f);
  ASSERT_TRUE(split);
  EXPECT_EQ(split->axis, kNormalAxis);
  EXPECT_GT(split->value, -1);
  EXPECT_LT(split->value, 1);
}

TEST(CellSplit, LeavesCoincidentPhotonsTogether) {
  const std::vector<Photon> same(1000, photon_at(Vec3(0.1f, 0.2f, 0.3f)));
  EXPECT_FALSE(choose_split(moments_of(same, 64), 0.9f, 0));
  EXPECT_FALSE(choose_split(
      moments_of(rectangle(1e-4f, 1e-4f, Vec3::UnitZ(), Vec3::Zero(), 1000), 64), 0.9f, 1e-3f));
  EXPECT_FALSE(choose_split(CellTraining(), 0.9f, 0));
}

}  // namespace
}  // namespace waylight
