#include "libguide/guiding/flight_cells.h"

#include <gtest/gtest.h>

#include "libguide/spatial/tree_check.h"

namespace waylight {
namespace {

// Four cells along x, at -1, 0 and 1.
const std::vector<CacheNode> kAlongX = {{0, 1, 0},         {-1, 3, 0},        {1, 5, 0},
                                        {0, 0, kLeafAxis}, {0, 1, kLeafAxis}, {0, 2, kLeafAxis},
                                        {0, 3, kLeafAxis}};

ScatteredLight light(float radiance, float direct_share = 0) {
  return {{radiance, 2 * radiance}, direct_share};
}

const ScatteredLight& at(const FlightCells& cells, float x) {
  return cells.light[find_leaf(cells.nodes, {x, 0, 0}, Vec3::UnitZ())];
}

TEST(FlightCells, SiblingsThatScatterAlikeAreOneWithTheirMean) {
  const FlightCells cells =
      merge_for_flights(kAlongX, {light(1, 0.2f), light(1.2f, 0.4f), light(10), light(20)});
  EXPECT_EQ(check_tree(cells.nodes, cells.light.size()), "");
  ASSERT_EQ(cells.light.size(), 3u);
  EXPECT_EQ(&at(cells, -2), &at(cells, -0.5f));
  EXPECT_FLOAT_EQ(at(cells, -2).radiance[1], 2.2f);
  EXPECT_FLOAT_EQ(at(cells, -2).direct_share, 0.3f);
  EXPECT_FLOAT_EQ(at(cells, 0.5f).radiance[0], 10);
  EXPECT_FLOAT_EQ(at(cells, 2).radiance[0], 20);
}

TEST(FlightCells, AllThatAreAlikeAreOneCellThatIsTheMeanOfEach) {
  const FlightCells cells =
      merge_for_flights(kAlongX, {light(1), light(1.1f), light(1.2f), light(1.3f)});
  ASSERT_EQ(cells.light.size(), 1u);
  EXPECT_EQ(check_tree(cells.nodes, 1), "");
  EXPECT_FLOAT_EQ(cells.light[0].radiance[0], 1.15f);
}

TEST(FlightCells, WhatIsNotKnownIsNoneOfWhatIs) {
  const FlightCells cells = merge_for_flights(kAlongX, {light(-1), light(1), light(-1), light(-1)});
  ASSERT_EQ(cells.light.size(), 3u);
  EXPECT_LT(at(cells, -2).radiance[0], 0);
  EXPECT_FLOAT_EQ(at(cells, -0.5f).radiance[0], 1);
  EXPECT_LT(at(cells, 3).radiance[0], 0);
}

TEST(FlightCells, LightOfLampsAndOfTheMediumAreNotAlike) {
  const FlightCells cells =
      merge_for_flights(kAlongX, {light(1, 0), light(1, 1), light(0), light(0)});
  EXPECT_EQ(cells.light.size(), 3u);
}

}  // namespace
}  // namespace waylight
