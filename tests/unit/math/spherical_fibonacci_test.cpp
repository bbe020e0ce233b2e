// The nearest point by the inverse mapping is the nearest of all.

#include "libguide/math/spherical_fibonacci.h"

#include <gtest/gtest.h>

#include "libguide/base/sampler.h"
#include "libguide/math/warp.h"

namespace waylight {
namespace {

std::vector<Vec3> all_points(int count) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.push_back(hemisphere_fibonacci(i, count));
  return points;
}

// The nearest in angle, up to what floats tell apart.
void expect_nearest(const std::vector<Vec3>& points, const Vec3& w) {
  const int count = static_cast<int>(points.size());
  float best = -2;
  for (const Vec3& p : points) best = std::max(best, p.dot(w));
  const int found = nearest_hemisphere_fibonacci(w, count);
  ASSERT_GE(found, 0);
  ASSERT_LT(found, count);
  ASSERT_GE(points[found].dot(w), best - 2e-7f)
      << "of " << count << " points, from " << w.transpose() << " found " << found;
}

Vec3 at(float z, float azimuth) {
  const float r = safe_sqrt(1 - z * z);
  return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

// Uniform over the hemisphere, then close to the horizon and to the pole.
Vec3 probe(int i, Sampler& sampler) {
  const Vec2 u = sampler.next_2d();
  const float z[] = {u.x(), u.x() * u.x() * u.x() * 0.01f, 1 - u.x() * u.x() * 0.01f};
  return at(z[i % 3], 2 * kPi * u.y());
}

void expect_nearest_everywhere(int count, int probes) {
  const std::vector<Vec3> points = all_points(count);
  for (int i = 0; i < probes; ++i) {
    Sampler sampler(1, count, i);
    expect_nearest(points, probe(i, sampler));
  }
}

TEST(SphericalFibonacci, TheNearestPointIsThatOfAComparisonOfAllAtEveryCountUpTo4096) {
  for (int count = 1; count <= 4096; ++count) expect_nearest_everywhere(count, 24);
}

TEST(SphericalFibonacci, TheNearestPointIsThatOfAComparisonOfAllForManyDirections) {
  for (const int count : {2, 3, 17, 64, 100, 512, 1000, 4095, 4096, 5000, 65536})
    expect_nearest_everywhere(count, std::min(20000, 40'000'000 / count));
}

TEST(SphericalFibonacci, EveryPointIsNearestToItself) {
  for (const int count : {1, 2, 16, 17, 256, 4096, 65536})
    for (int i = 0; i < count; ++i)
      ASSERT_EQ(nearest_hemisphere_fibonacci(hemisphere_fibonacci(i, count), count), i) << count;
}

TEST(SphericalFibonacci, PoleHorizonAndBelowAreServed) {
  for (const int count : {1, 8, 17, 512, 4096}) {
    const std::vector<Vec3> points = all_points(count);
    expect_nearest(points, Vec3::UnitZ());
    for (int i = 0; i < 360; ++i) {
      expect_nearest(points, at(0, i * kPi / 180));
      EXPECT_LT(nearest_hemisphere_fibonacci(at(-0.01f, i * kPi / 180), count), count);
    }
  }
}

TEST(SphericalFibonacci, PointsShareTheHemisphereEvenly) {
  constexpr int kCount = 256, kProbes = 1 << 17;
  std::vector<int> hits(kCount);
  for (int i = 0; i < kProbes; ++i) {
    const Vec3 w = disk_to_direction(square_to_disk(Sampler(2, 2, i).next_2d()));
    ++hits[nearest_hemisphere_fibonacci(w, kCount)];
  }
  const double mean = double(kProbes) / kCount;
  // By the horizon regions are cut, or reach down to it.
  for (int i = 0; i < 3 * kCount / 4; ++i) EXPECT_NEAR(hits[i], mean, 0.2 * mean) << i;
  for (int i = 3 * kCount / 4; i < kCount; ++i) EXPECT_NEAR(hits[i], mean, 0.5 * mean) << i;
}

}  // namespace
}  // namespace waylight
