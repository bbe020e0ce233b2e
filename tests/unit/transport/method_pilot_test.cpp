// What a small render says of ways to trace paths, and where it looks.

#include "libguide/transport/method_pilot.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "common/small_scenes.h"

namespace waylight {
namespace {

const std::function<bool()> kNever = [] { return false; };

struct Box {
  Scene scene{testing::gap_box(64, 48)};
  GuidingCaches caches;
  PathTracerOptions options;
  PathTracer tracer{scene, caches, options};
  PilotFrame frame{scene.description().sensor, 1};
};

TEST(PilotFrame, EveryRoundVisitsEveryTileOnce) {
  for (const int tiles : {1, 31, 32, 33, 1000}) {
    const FrameTurns turns(tiles, 32, 2, 1e9);
    std::array<std::multiset<int>, 2> visited;
    for (int turn = 0; turn < turns.count(); ++turn)
      for (int i = 0; i < turns.tiles(turn); ++i)
        visited[turns.round(turn)].insert(turns.tile(turn, i));
    for (const auto& round : visited) {
      EXPECT_EQ(round.size(), size_t(tiles));
      EXPECT_EQ(std::set<int>(round.begin(), round.end()).size(), size_t(tiles));
      EXPECT_EQ(*round.rbegin(), tiles - 1);
    }
  }
}

TEST(PilotFrame, NoMoreTurnsThanCanBeAfforded) {
  EXPECT_EQ(FrameTurns(1000, 32, 8, 10).count(), 0);
  EXPECT_EQ(FrameTurns(1000, 32, 8, 100).count(), 3);
}

TEST(PilotFrame, TilesHoldEveryPlaceOnce) {
  SensorDescription sensor;
  sensor.film.width = 333;
  sensor.film.height = 217;
  const PilotFrame frame(sensor, 1);
  std::set<int> places;
  for (int tile = 0; tile < frame.tiles(); ++tile)
    frame.for_places(tile, [&](int place) { EXPECT_TRUE(places.insert(place).second); });
  EXPECT_EQ(places.size(), size_t(frame.places()));
  EXPECT_EQ(*places.rbegin(), frame.places() - 1);
}

TEST(MethodPilot, EqualArmsHaveEqualFigures) {
  const Box box;
  std::vector<PilotArm> arms(3, {{"same"}, box.options});
  MethodPilotOptions options;
  options.max_paths = 100'000;
  ASSERT_TRUE(measure(box.tracer, arms, box.frame, options, kNever));
  for (const PilotArm& arm : arms) {
    EXPECT_EQ(arm.figures.inefficiency(), arms[0].figures.inefficiency());
    EXPECT_EQ(arm.figures.uncertainty, 0);
    EXPECT_GT(arm.figures.inefficiency(), 0);
  }
}

// One that ends every path at its first surface finds no light behind the gap: its own variance is
// next to nothing.
TEST(MethodPilot, WhatAnArmMissesCountsAgainstIt) {
  const Box box;
  PathTracerOptions blind = box.options;
  blind.max_depth = 1;
  std::vector<PilotArm> arms = {{{"sees"}, box.options}, {{"blind"}, blind}};
  MethodPilotOptions options;
  options.max_paths = 2'000'000;
  ASSERT_TRUE(measure(box.tracer, arms, box.frame, options, kNever));
  EXPECT_GT(arms[1].figures.variance, arms[0].figures.variance);
}

// In 32 tiles none that is held has more than twice the mean; some have, behind the gap. The first
// arm, which ends every path at its first surface, has none of that.
TEST(MethodPilot, BrightPathsCountInFullWhereTheyAreNotHeld) {
  const Box box;
  PathTracerOptions blind = box.options;
  blind.max_depth = 1;
  std::vector<PilotArm> arms = {
      {{"blind"}, blind}, {{"held"}, box.options}, {{"in full"}, box.options, false}};
  MethodPilotOptions options;
  options.max_paths = 3072;
  ASSERT_TRUE(measure(box.tracer, arms, box.frame, options, kNever));
  EXPECT_GT(arms[2].figures.variance, arms[1].figures.variance);
}

TEST(MethodPilot, BrightPathsThatTheFirstArmHasTooAreNotHeldAgainstAnother) {
  const Box box;
  std::vector<PilotArm> arms = {{{"held"}, box.options}, {{"in full"}, box.options, false}};
  MethodPilotOptions options;
  options.max_paths = 2048;
  ASSERT_TRUE(measure(box.tracer, arms, box.frame, options, kNever));
  EXPECT_NEAR(arms[1].figures.variance, arms[0].figures.variance, 1e-9 * arms[0].figures.variance);
}

TEST(MethodPilot, TooFewPathsSayNothing) {
  const Box box;
  std::vector<PilotArm> arms(2, {{"same"}, box.options});
  MethodPilotOptions options;
  options.max_paths = 100;
  EXPECT_FALSE(measure(box.tracer, arms, box.frame, options, kNever));
}

// 192 tiles of 16 places, 32 a turn and two paths a place: 1024 for one arm.
TEST(MethodPilot, FewPathsDropTheLastArms) {
  const Box box;
  MethodPilotOptions options;
  for (const auto& [paths, left] : {std::pair{1024, 0}, {2048, 2}, {4000, 3}, {100'000, 6}}) {
    std::vector<PilotArm> arms;
    for (const char* name : {"a", "b", "c", "d", "e", "f"}) arms.push_back({{name}, box.options});
    options.max_paths = paths;
    EXPECT_EQ(measure(box.tracer, arms, box.frame, options, kNever), left > 0) << paths;
    if (left > 0) {
      ASSERT_EQ(arms.size(), size_t(left)) << paths;
      EXPECT_EQ(arms.back().figures.name, std::string(1, char('a' + left - 1)));
      EXPECT_GT(arms.back().figures.inefficiency(), 0);
    }
  }
}

}  // namespace
}  // namespace waylight
