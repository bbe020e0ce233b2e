#include "libguide/base/stopwatch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace waylight {
namespace {

TEST(Stopwatch, CpuClockCountsProcessorSecondsOverProcessors) {
  const Stopwatch two(2);
  while (two.cpu_seconds() < 0.02) {
  }
  EXPECT_NEAR(two.seconds(), two.cpu_seconds() / 2, 1e-3);
}

TEST(Stopwatch, CpuClockStandsStillWhileTheProcessSleeps) {
  const Stopwatch wall, cpu(1);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_GE(wall.seconds(), 0.05);
  EXPECT_LT(cpu.seconds(), 0.03);
}

}  // namespace
}  // namespace waylight
