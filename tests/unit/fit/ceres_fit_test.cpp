#include "libguide/fit/ceres_fit.h"

#include <gtest/gtest.h>

#include "libguide/directional/mixture_check.h"
#include "unit/directional/mixtures.h"

namespace waylight {
namespace {

using Components = std::vector<GaussianComponent>;

// Rows whose target is a mixture, at points uniform over the disk.
std::vector<LobeRow> rows_of(const GaussianMixture& target, int count) {
  std::vector<LobePoint> points;
  for (int i = 0; i < count; ++i) {
    const Vec2 y = square_to_disk(Sampler(1, 0, i).next_2d());
    points.push_back({y, target.pdf(y), kHemispherePdf});
  }
  return lobe_rows(points, count);
}

const Components kTruth = {test::component(0.7f, {-0.3f, 0.1f}, 0.12f, 0.08f, 0.4f),
                           test::component(0.3f, {0.2f, -0.2f}, 0.1f, 0.15f, 0)};

TEST(RefineMixture, FindsAKnownMixtureFromAStartThatIsOff) {
  const GaussianMixture truth(kTruth);
  const Components start = {test::component(0.5f, {-0.2f, 0.2f}, 0.2f, 0.2f, 0),
                            test::component(0.5f, {0.3f, -0.1f}, 0.2f, 0.2f, 0)};
  CeresOptions options;
  options.max_iterations = 100, options.tolerance = 1e-9f;
  const GaussianMixture found(refine_mixture(rows_of(truth, 1000), start, options).components);
  for (int i = 0; i < 256; ++i) {
    const Vec2 y = square_to_disk(Sampler(2, 0, i).next_2d());
    EXPECT_NEAR(found.pdf(y), truth.pdf(y), 0.01f * truth.pdf(y) + 0.01f);
  }
}

TEST(RefineMixture, NeverRaisesTheCostAndStaysValid) {
  for (int seed = 0; seed < 50; ++seed) {
    const auto rows = rows_of(GaussianMixture(test::random_components(8, 100 + seed)), 512);
    Components start = test::random_components(1 + seed % 16, seed);
    float sum = 0;
    for (const GaussianComponent& c : start) sum += c.weight;
    for (GaussianComponent& c : start) c.weight /= sum;
    const Components refined = refine_mixture(rows, start, {}).components;
    EXPECT_EQ(check_mixture(std::span(refined).first(std::min<size_t>(refined.size(), 8)))
                  .find("not a valid"),
              std::string::npos)
        << seed;
    EXPECT_LE(relative_cost(rows, refined), relative_cost(rows, start) * 1.0001) << seed;
  }
}

TEST(RefineMixture, HoldsOnWhereTheStartMissesTheLobe) {
  const GaussianMixture narrow(Components{test::component(1, {0.9f, 0}, 1e-3f, 1e-3f, 0)});
  std::vector<LobePoint> points;
  for (int i = 0; i < 512; ++i) {
    Sampler s(1, 0, i);
    const float u = s.next();
    if (const auto y = narrow.sample(u, s.next_2d()))
      points.push_back({*y, narrow.pdf(*y), narrow.pdf(*y) / kSteradianPerDiskArea});
  }
  const Components far = {test::component(1, {-0.9f, 0}, 1e-3f, 1e-3f, 0)};
  EXPECT_EQ(check_mixture(refine_mixture(lobe_rows(points, 512), far, {}).components), "");
}

}  // namespace
}  // namespace waylight
