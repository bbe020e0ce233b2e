#include "libguide/directional/frame_carry.h"

#include <gtest/gtest.h>

#include "unit/directional/mixtures.h"

namespace waylight {
namespace {

Mat3 rotation(float angle, const Vec3& axis) {
  return Eigen::AngleAxisf(angle, axis.normalized()).toRotationMatrix();
}

Vec2 mapped(const Vec2& y, const Mat3& r) { return direction_to_disk(r * disk_to_direction(y)); }

TEST(FrameCarry, DensityAtMappedPointsIsKept) {
  const Mat3 r = rotation(0.6f, {1, 2, 0.5f});
  const GaussianMixture before(std::array{test::component(1, {0.4f, -0.3f}, 0.05f, 0.03f, 0.4f),
                                          test::component(2, {-0.5f, 0.2f}, 0.04f, 0.06f, -0.5f)});
  const GaussianMixture after = before.carried(r);
  for (const Vec2& y : test::draw(before, 500, 1)) {
    // Far from the mean the map is not linear; 12 % at 2 standard deviations is what curvature
    // costs.
    if (before.pdf(y) < 8) continue;
    EXPECT_NEAR(after.pdf(mapped(y, r)) / before.pdf(y), 1, 0.15) << y.transpose();
  }
}

TEST(FrameCarry, MeanAndCovarianceAgreeWithFiniteDifferences) {
  const Mat3 r = rotation(1.1f, {-1, 0.3f, 0.2f});
  for (const GaussianComponent& c : test::random_components(20, 5)) {
    const Vec2 mean(c.mean_x, c.mean_y), image = mapped(mean, r);
    if (image.squaredNorm() > 1.5f) continue;  // beside the tear of the plane
    const float h = 1e-2f;
    const Vec2 dx = (mapped(mean + Vec2(h, 0), r) - mapped(mean - Vec2(h, 0), r)) / (2 * h);
    const Vec2 dy = (mapped(mean + Vec2(0, h), r) - mapped(mean - Vec2(0, h), r)) / (2 * h);
    const GaussianComponent out = carry(c, r);
    EXPECT_NEAR(out.mean_x, image.x(), 1e-5f);
    EXPECT_NEAR(out.mean_y, image.y(), 1e-5f);
    const float scale = c.cov_xx + c.cov_yy;
    const auto expected = [&](int a, int b) {
      return c.cov_xx * dx[a] * dx[b] + c.cov_xy * (dx[a] * dy[b] + dy[a] * dx[b]) +
             c.cov_yy * dy[a] * dy[b];
    };
    EXPECT_NEAR(out.cov_xx, expected(0, 0), 2e-3f * scale);
    EXPECT_NEAR(out.cov_xy, expected(0, 1), 2e-3f * scale);
    EXPECT_NEAR(out.cov_yy, expected(1, 1), 2e-3f * scale);
  }
}

TEST(FrameCarry, RotationAboutTheNormalIsExactEverywhere) {
  const auto components = test::random_components(4, 8);
  const float angle = 2.2f;
  const GaussianMixture carried = GaussianMixture(components).carried(rotation(angle, {0, 0, 1}));
  const GaussianMixture turned(components, Vec2(std::cos(angle), std::sin(angle)));
  for (int i = 0; i < 100; ++i) {
    const Vec2 y = 1.4f * square_to_disk(Sampler(1, 0, i).next_2d());
    EXPECT_NEAR(carried.pdf(y), turned.pdf(y), 1e-4f * turned.pdf(y) + 1e-6f);
  }
}

TEST(FrameCarry, StaysADensityAtTheAntipodeAndOffTheDomain) {
  for (float angle : {0.0f, 1e-4f, 1.5707963f, 3.0f, 3.1415926f})
    for (const Vec2& mean : {Vec2(0, 0), Vec2(1, 0), Vec2(1.41f, 0), Vec2(1.6f, 0)}) {
      const GaussianMixture mixture(std::array{test::component(1, mean, 0.02f, 0.1f, 0.3f)});
      const GaussianMixture carried = mixture.carried(rotation(angle, {0, 1, 0}));
      ASSERT_EQ(carried.count(), 1);
      const GaussianComponent c = carried.component(0);
      EXPECT_TRUE(std::isfinite(c.mean_x) && std::isfinite(c.mean_y));
      EXPECT_EQ(GaussianMixture(std::array{c}).count(), 1) << angle << " " << mean.transpose();
    }
}

}  // namespace
}  // namespace waylight
