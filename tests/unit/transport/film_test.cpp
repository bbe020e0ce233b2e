#include "libguide/transport/film.h"

#include <gtest/gtest.h>

#include "libguide/base/sampler.h"

namespace waylight {
namespace {

// Every pixel has radiance 1, which a sample finds with the given probability.
Film film_of(double probability, int samples) {
  Film film(32, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x)
      for (int i = 0; i < samples; ++i) {
        Sampler sampler(1, static_cast<uint64_t>(y) * 32 + x, i);
        PathRecord path;
        if (sampler.next() < probability)
          path.radiance = Color::Constant(static_cast<float>(1 / probability));
        film.at(x, y).add(path, 1);
      }
  return film;
}

// (1 / p - 1) / n over 1.01.
double true_relmse(double probability, int samples) {
  return (1 / probability - 1) / samples / 1.01;
}

TEST(Film, EstimatesItsErrorWhereLightIsEasyToFind) {
  EXPECT_NEAR(film_of(0.5, 256).estimated_relmse() / true_relmse(0.5, 256), 1, 0.1);
}

TEST(Film, EstimatesItsErrorWhereMostPixelsFoundNoLight) {
  EXPECT_NEAR(film_of(0.01, 16).estimated_relmse() / true_relmse(0.01, 16), 1, 0.3);
}

TEST(Film, KnowsNoErrorBelowTwoSamples) {
  EXPECT_TRUE(std::isnan(film_of(0.5, 1).estimated_relmse()));
}

}  // namespace
}  // namespace waylight
