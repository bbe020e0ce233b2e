#include "libguide/cache/medium_volume.h"

#include <gtest/gtest.h>

#include <functional>

#include "libguide/base/sampler.h"
#include "libguide/cache/position_moments.h"
#include "libguide/math/frame.h"
#include "libguide/math/warp.h"

namespace waylight {
namespace {

constexpr int kCount = 20'000;

// Of positions place(u), u uniform in [0, 1)^3, in a box.
MediumTraining cell_of(const std::function<Vec3(const Vec3&)>& place, const Bounds& box,
                       int count = kCount) {
  MediumTraining cell;
  PositionSums sums(Vec3::Zero());
  for (int i = 0; i < count; ++i) {
    Sampler sampler(4, 1, i);
    const Vec2 u = sampler.next_2d();
    const Vec3 position = place(Vec3(u.x(), u.y(), sampler.next()));
    sums.add(position);
    cell.occupied |= part_of_box(box, position);
  }
  cell.count = static_cast<float>(count);
  sums.merge_into(cell, cell.count, -cell.count, 1);
  return cell;
}

const Bounds kUnit = {Vec3::Zero(), Vec3::Ones()};

double relative_volume(const std::function<Vec3(const Vec3&)>& place, double truth) {
  return photon_volume(cell_of(place, kUnit)) / truth;
}

TEST(MediumVolume, OfBoxesInAnyOrientation) {
  const Vec3 sides(0.5f, 2, 0.25f);
  for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(1, 2, 2), Vec3(-0.3f, 0.1f, -0.9f)}) {
    const Frame frame(axis.normalized());
    const auto place = [&](const Vec3& u) -> Vec3 {
      return Vec3(3, -4, 1) + frame.to_world((u - Vec3::Constant(0.5f)).cwiseProduct(sides));
    };
    EXPECT_NEAR(relative_volume(place, 0.25), 1, 0.01);
  }
}

TEST(MediumVolume, OfABallIsElevenPercentLow) {
  const auto place = [](const Vec3& u) -> Vec3 {
    return std::cbrt(u.z()) * square_to_sphere({u.x(), u.y()});
  };
  EXPECT_NEAR(relative_volume(place, 4 * kPi / 3), 0.888, 0.01);
}

TEST(MediumVolume, OfABoxCutAlongItsDiagonalIsFifteenPercentHigh) {
  const auto place = [](const Vec3& u) -> Vec3 {
    return u.x() + u.y() < 1 ? u : Vec3(1 - u.x(), 1 - u.y(), u.z());
  };
  EXPECT_NEAR(relative_volume(place, 0.5), 1.155, 0.01);
}

Vec3 falling_off(const Vec3& u, float thickness) {
  return {-std::log1p(u.x() * std::expm1(-thickness)) / thickness, u.y(), u.z()};
}

TEST(MediumVolume, IsLowInLightThatFallsOffExponentially) {
  const auto low = [](float thickness) {
    return relative_volume([thickness](const Vec3& u) { return falling_off(u, thickness); }, 1);
  };
  EXPECT_NEAR(low(std::log(2.0f)), 0.98, 0.01);
  EXPECT_NEAR(low(2), 0.91, 0.01);
  EXPECT_NEAR(low(4), 0.72, 0.01);
}

TEST(MediumVolume, WhereTheMediumFillsItsBoxTheLightDoesNotMatter) {
  const auto falling = [](const Vec3& u) { return falling_off(u, 4); };
  EXPECT_TRUE(fills_box(cell_of(falling, kUnit)));
  EXPECT_EQ(medium_volume(cell_of(falling, kUnit), kUnit), 1);
  EXPECT_FALSE(fills_box(cell_of(falling, kUnit, 100)));
  EXPECT_LT(medium_volume(cell_of(falling, kUnit, 100), kUnit), 0.9);
}

TEST(MediumVolume, OfAPartOfTheBoxIsThatOfThePhotons) {
  const auto half = [](const Vec3& u) -> Vec3 { return {0.5f * u.x(), u.y(), u.z()}; };
  EXPECT_FALSE(fills_box(cell_of(half, kUnit)));
  EXPECT_NEAR(medium_volume(cell_of(half, kUnit), kUnit), 0.5, 0.01);
}

// Nine in ten photons are in a beam along x; of the others there are too few to fill all parts.
TEST(MediumVolume, AroundABeamIsAtLeastHalfOfTheBox) {
  const auto beam = [](const Vec3& u) -> Vec3 {
    return u.z() < 0.9f ? Vec3(u.x(), 0.6f, 0.6f) : Vec3(u.x(), u.y(), 10 * (u.z() - 0.9f));
  };
  const MediumTraining cell = cell_of(beam, kUnit, 900);
  EXPECT_FALSE(fills_box(cell));
  EXPECT_LT(photon_volume(cell), 0.2);
  EXPECT_EQ(medium_volume(cell, kUnit), 0.5);
  const auto sheet = [](const Vec3& u) -> Vec3 { return {u.x(), u.y(), 0.49f + 0.02f * u.z()}; };
  EXPECT_NEAR(medium_volume(cell_of(sheet, kUnit), kUnit), 0.02, 0.001);
}

TEST(MediumVolume, IsInheritedUntilThereArePhotonsEnough) {
  MediumTraining cell = cell_of([](const Vec3& u) { return u; }, kUnit, 20);
  EXPECT_EQ(medium_volume(cell, kUnit), 1);
  cell.inherited_volume = 0.125f;
  EXPECT_EQ(medium_volume(cell, kUnit), 0.125);
  cell.inherited_volume = 8;
  EXPECT_EQ(medium_volume(cell, kUnit), 1) << "no more than the box";
}

TEST(MediumVolume, EveryPartOfTheBoxHasABitAndEveryPositionAPart) {
  uint64_t all = 0;
  for (int i = 0; i < 64; ++i)
    all |= part_of_box(kUnit, (Vec3(i % 4, i / 4 % 4, i / 16) + Vec3::Constant(0.5f)) / 4);
  EXPECT_EQ(all, ~uint64_t{0});
  EXPECT_EQ(part_of_box(kUnit, Vec3(-9, -9, -9)), 1u);
  EXPECT_EQ(part_of_box(kUnit, Vec3(9, -9, -9)), 8u);
  EXPECT_EQ(part_of_box({Vec3::Ones(), Vec3::Ones()}, Vec3::Ones()), 1u);
}

TEST(MediumVolume, OfPhotonsInOnePlaceOrNoneIsZeroOrTheBox) {
  EXPECT_EQ(photon_volume(MediumTraining()), 0);
  const auto point = [](const Vec3&) -> Vec3 { return Vec3::Constant(0.3f); };
  EXPECT_NEAR(medium_volume(cell_of(point, kUnit), kUnit), 0, 1e-9);
  EXPECT_EQ(medium_volume(MediumTraining(), kUnit), 1);
}

}  // namespace
}  // namespace waylight
