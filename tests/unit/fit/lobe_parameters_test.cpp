#include "libguide/fit/lobe_parameters.h"

#include <gtest/gtest.h>

#include "libguide/directional/mixture_check.h"
#include "unit/directional/mixtures.h"

namespace waylight {
namespace {

TEST(LobeParameters, ReturnTheMixtureThatTheyWereMadeOf) {
  const GaussianMixture expected(test::random_components(8, 3));
  std::vector<GaussianComponent> components;
  for (int k = 0; k < 8; ++k) components.push_back(expected.component(k));
  const GaussianMixture returned(components_of(parameters_of(components)));
  for (int i = 0; i < 256; ++i) {
    const Vec2 y = square_to_disk(Sampler(1, 0, i).next_2d());
    EXPECT_NEAR(returned.pdf(y), expected.pdf(y), 1e-3f * expected.pdf(y) + 1e-5f);
  }
}

// Uniform in +-range.
Eigen::VectorXd random_parameters(int components, double range, uint64_t seed) {
  Eigen::VectorXd parameters(kComponentParameters * components);
  for (Eigen::Index i = 0; i < parameters.size(); ++i)
    parameters[i] = range * (2 * Sampler(seed, 0, static_cast<uint32_t>(i)).next() - 1);
  return parameters;
}

// Further out they are too wide to count as Gaussians, and the refinement keeps its start.
TEST(LobeParameters, AnyOfThemAreAValidMixtureInsideTheDisk) {
  for (int seed = 0; seed < 200; ++seed) {
    const std::vector<GaussianComponent> c = components_of(random_parameters(4, 5, seed));
    EXPECT_EQ(check_mixture(c), "") << seed;
    for (const GaussianComponent& g : c) EXPECT_LE(std::hypot(g.mean_x, g.mean_y), 1) << seed;
  }
}

// Weight times density of the only component.
double density(const Eigen::VectorXd& parameters, const Vec2& y) {
  ParameterGaussian g;
  unpack(parameters.data(), std::span(&g, 1));
  return g.at(splat(y.x()), splat(y.y())).density[0];
}

TEST(LobeParameters, DerivativesAreThoseOfTheDensity) {
  for (int seed = 0; seed < 50; ++seed) {
    const Eigen::VectorXd parameters = random_parameters(1, 1, seed);
    const Vec2 y = square_to_disk(Sampler(seed, 1, 0).next_2d());
    ParameterGaussian g;
    unpack(parameters.data(), std::span(&g, 1));
    Lanes derivatives[kComponentParameters];
    g.log_derivatives(g.at(splat(y.x()), splat(y.y())), derivatives);
    for (int p = 1; p < kComponentParameters; ++p) {
      const double step = 1e-2;
      Eigen::VectorXd less = parameters, more = parameters;
      less[p] -= step, more[p] += step;
      const double expected = std::log(density(more, y) / density(less, y)) / (2 * step);
      EXPECT_NEAR(derivatives[p][0], expected, 2e-3 * (1 + std::abs(expected))) << seed << " " << p;
    }
  }
}

}  // namespace
}  // namespace waylight
