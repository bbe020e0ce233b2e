// From wo to the entry that stands for it, and back to the lobe in the shading frame.

#include "libguide/directional/entry_layout.h"

#include <gtest/gtest.h>

#include "libguide/base/sampler.h"
#include "libguide/math/warp.h"

namespace waylight {
namespace {

constexpr EntryLayout kLayouts[] = {EntryLayout::elevations, EntryLayout::fibonacci};

Vec3 mirrored(const Vec3& w) { return {-w.x(), -w.y(), w.z()}; }

// Over the hemisphere, and at its pole and its horizon.
std::vector<Vec3> directions() {
  std::vector<Vec3> all = {Vec3::UnitZ(), Vec3::UnitX(), Vec3(0, -1, 0)};
  for (int i = 0; i < 200; ++i)
    all.push_back(disk_to_direction(square_to_disk(Sampler(4, 4, i).next_2d())));
  return all;
}

TEST(EntryLayout, TheMirrorDirectionOfTheEntryGoesToThatOfWo) {
  for (const EntryLayout layout : kLayouts)
    for (const int n : {2, 7, 64})
      for (const Vec3& wo : directions()) {
        const int i = nearest_entry(layout, wo, n);
        const Mat3 rotation = entry_rotation(layout, wo, i, n);
        EXPECT_LT((rotation * mirrored(entry_wo(layout, i, n)) - mirrored(wo)).norm(), 1e-5f);
        EXPECT_LT((rotation * rotation.transpose() - Mat3::Identity()).norm(), 1e-5f);
        EXPECT_NEAR(rotation.determinant(), 1, 1e-5f);
      }
}

TEST(EntryLayout, TheRotationIsNoneAtTheEntryItself) {
  for (const EntryLayout layout : kLayouts)
    for (int i = 0; i < 32; ++i) {
      const Vec3 wo = entry_wo(layout, i, 32);
      EXPECT_EQ(nearest_entry(layout, wo, 32), i);
      EXPECT_LT((entry_rotation(layout, wo, i, 32) - Mat3::Identity()).norm(), 1e-5f);
    }
}

TEST(EntryLayout, TheRotationIsNoLargerThanTheWayToTheEntry) {
  for (const Vec3& wo : directions()) {
    const int i = nearest_entry(EntryLayout::fibonacci, wo, 256);
    const Vec3 entry = entry_wo(EntryLayout::fibonacci, i, 256);
    const Mat3 rotation = entry_rotation(EntryLayout::fibonacci, wo, i, 256);
    EXPECT_LT((rotation.col(2) - Vec3::UnitZ()).norm(), (wo - entry).norm() + 1e-5f);
  }
}

TEST(EntryLayout, ASingleEntryByElevationTurnsAboutTheNormalOnly) {
  for (const Vec3& wo : directions()) {
    const Mat3 rotation = entry_rotation(EntryLayout::elevations, wo, 0, 1);
    EXPECT_EQ(rotation.col(2), Vec3::UnitZ());
    const Vec3 x = rotation.col(0);
    EXPECT_GE(x.dot(wo), Vec2(wo.x(), wo.y()).norm() - 1e-6f);
  }
}

}  // namespace
}  // namespace waylight
