#include "libguide/cache/training_cell.h"

#include <gtest/gtest.h>

#include <numeric>

namespace waylight {
namespace {

// Spread over the unit square of the plane z = 0 that begins at x.
std::vector<Photon> photons_at(float x, int count, float power = 1) {
  std::vector<Photon> photons(count);
  for (int i = 0; i < count; ++i) {
    photons[i].position = Vec3(x + 0.01f * (i % 100), 0.01f * (i / 100 % 100), 0);
    photons[i].direction = photons[i].normal = Vec3::UnitZ();
    photons[i].power = Color::Constant(power);
    photons[i].path_depth = 1;
  }
  return photons;
}

void absorb(TrainingCell& cell, std::span<const Photon> photons) {
  std::vector<uint32_t> indices(photons.size());
  std::iota(indices.begin(), indices.end(), 0);
  cell.absorb(photons, indices, 1000, {});
}

// As a training that goes on has it.
TrainingCell continued(const TrainingCell& cell) {
  return TrainingCell(cell.cell(), cell.training(), cell.components(), cell.statistics(),
                      cell.reach(), cell.evidence());
}

TEST(TrainingCell, ReachesWherePhotonsOfALaterStreamLieApartFromThoseBefore) {
  TrainingCell before;
  absorb(before, photons_at(0, 10'000));
  TrainingCell cell = continued(before);
  absorb(cell, photons_at(100, 100));
  const CellReach reach = cell.reach();
  EXPECT_TRUE((reach.min.array() <= reach.max.array()).all());
  EXPECT_TRUE(reach.holds(Vec3(100.5f, 0, 0)));
}

TEST(TrainingCell, OfOneStreamReachesNoFurtherThanThreeDeviations) {
  std::vector<Photon> photons = photons_at(0, 10'000);
  for (size_t i = 0; i < 8; ++i) photons[i].position.x() = 100;
  TrainingCell cell;
  absorb(cell, photons);
  EXPECT_FALSE(cell.reach().holds(Vec3(50, 0.5f, 0)));
}

// One has its evidence in weights of the stream before, the other in those of its own photons.
TEST(TrainingCell, EvidenceAddsUpWhicheverOfTwoHasSeenPhotonsOfTheLaterStream) {
  TrainingCell before;
  absorb(before, photons_at(0, 10'048));
  TrainingCell dark = continued(before), lit = dark;
  absorb(lit, photons_at(0, 10'048, 1e-5f));
  for (const auto& [first, second] : {std::pair(dark, lit), std::pair(lit, dark)}) {
    TrainingCell both = first;
    both.unite(second, {}, 1e5, 1e-6);
    EXPECT_NEAR(both.cell().effective_samples, 30'144, 1);
  }
}

}  // namespace
}  // namespace waylight
