#include "libguide/scene/cone.h"

#include "statistical/density_assertions.h"

namespace waylight {
namespace {

TEST(Cone, HasItsDensity) {
  for (const float height : {1.5f, 1.0f, 0.5f, 0.05f})
    testing::expect_valid_density(
        testing::Sphere{}, "cone",
        [=](Sampler& s) {
          return std::make_optional(square_to_cone_of_height(s.next_2d(), height));
        },
        [=](const Vec3& w) { return w.z() >= 1 - height ? cone_of_height_pdf(height) : 0; });
}

// A cone as small as the sun's, and one a fifth of it. E[sin^2] = h to first order.
TEST(Cone, KeepsItsAngleWhereItIsNarrow) {
  for (const float height : {1.08e-5f, 5e-7f}) {
    double mean = 0;
    for (int i = 0; i < 4096; ++i) {
      const Vec3 w = square_to_cone_of_height(Sampler(5, 0, i).next_2d(), height);
      mean += w.head<2>().cast<double>().squaredNorm() / 4096;
    }
    EXPECT_NEAR(mean / height, 1, 1e-4) << height;
  }
}

}  // namespace
}  // namespace waylight
