// What a cell is sampled by follows the evidence and the price, and nothing else.

#include "libguide/guiding/cell_choices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace waylight {
namespace {

// A vertex whose contribution is `bsdf` / pdf or `guide` / pdf times a density, so that one of the
// two samplers is perfect; directions are spread evenly over a unit interval.
enum class Perfect { bsdf, guide };

void add_samples(CellChoiceLearner& learner, uint32_t cell, Perfect perfect, int count,
                 float share) {
  for (int i = 0; i < count; ++i) {
    const float x = (i + 0.5f) / count;
    GuidedSample s;
    s.cell = cell;
    s.bsdf_pdf = 1;
    s.guide_pdfs = {3 * x * x, 0};
    s.pdf = share * s.bsdf_pdf + (1 - share) * s.guide_pdfs[0];
    s.contribution = (perfect == Perfect::bsdf ? s.bsdf_pdf : s.guide_pdfs[0]) / s.pdf;
    learner.add(s);
  }
}

constexpr std::array kLight = {DirectionGuide::illumination};
constexpr std::array kBoth = {DirectionGuide::illumination, DirectionGuide::product};

float share(const CellChoiceLearner& learner, size_t cell) {
  return learner.choices()[cell].bsdf_share;
}

TEST(CellChoices, WithoutEvidenceTheDefaultIsKept) {
  CellChoiceLearner learner(3, kLight, 0.35f);
  learner.add({1, 1, {1, 0}, 1, 0});
  for (size_t cell = 0; cell < 3; ++cell) EXPECT_EQ(share(learner, cell), 0.35f);
}

TEST(CellChoices, TheBetterOfTwoSamplersGetsTheLargerShare) {
  CellChoiceLearner learner(2, kLight, 0.5f);
  add_samples(learner, 0, Perfect::bsdf, 1000, 0.5f);
  add_samples(learner, 1, Perfect::guide, 1000, 0.5f);
  EXPECT_EQ(share(learner, 0), 1.0f);
  EXPECT_LE(share(learner, 1), 0.2f);
}

TEST(CellChoices, CellsOfLittleEvidenceFollowWhatIsCommonToAll) {
  CellChoiceLearner learner(100, kLight, 0.3f);
  for (uint32_t cell = 1; cell < 100; ++cell) add_samples(learner, cell, Perfect::bsdf, 20, 0.3f);
  EXPECT_EQ(share(learner, 0), 1.0f);
  EXPECT_EQ(share(learner, 1), 1.0f);
}

TEST(CellChoices, FewSamplesMoveAShareLessThanMany) {
  float last = 0.3f;
  for (const int count : {2, 30, 3000}) {
    CellChoiceLearner learner(1, kLight, 0.3f);
    add_samples(learner, 0, Perfect::bsdf, count, 0.3f);
    EXPECT_GE(share(learner, 0), last) << count;
    last = share(learner, 0);
  }
  EXPECT_EQ(last, 1.0f);
}

// One contribution that outweighs all others is worth one sample, however large it is.
TEST(CellChoices, AFireflyDoesNotMoveAShareFar) {
  CellChoiceLearner learner(1, kLight, 0.3f);
  add_samples(learner, 0, Perfect::guide, 200, 0.3f);
  learner.add({0, 1, {0.01f, 0}, 0.307f, 1e4f});
  EXPECT_LE(std::abs(share(learner, 0) - 0.3f), 0.21f);
}

// The light's density is that of the integrand itself, the product's is twice too wide.
void add_better_light(CellChoiceLearner& learner, float contribution) {
  for (int i = 0; i < 1000; ++i) {
    const float x = (i + 0.5f) / 1000, light = 3 * x * x, product = 2 * x;
    const float pdf = 0.3f + 0.7f * product;
    learner.add({0, 1, {light, product}, pdf, contribution * light / pdf});
  }
}

TEST(CellChoices, TheBetterOfTwoGuidesIsTaken) {
  CellChoiceLearner learner(1, kBoth, 0.3f);
  add_better_light(learner, 1);
  EXPECT_EQ(learner.choices()[0].guide, DirectionGuide::illumination);
}

TEST(CellChoices, AGuideThatCostsMoreThanItGainsIsLeftOut) {
  for (const bool worth_it : {true, false}) {
    CellChoiceLearner learner(1, kBoth, 0.3f);
    add_better_light(learner, 1);
    // A vertex with its rays: what it adds to the variance is all of it, or next to nothing.
    learner.add_paths(worth_it ? 1000 : 1e6, 2000);
    EXPECT_EQ(learner.choices()[0].guide != DirectionGuide::none, worth_it);
  }
}

TEST(CellChoices, WhatIsNotANumberIsLeftOut) {
  CellChoiceLearner learner(1, kLight, 0.3f);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  learner.add({0, 1, {1, 0}, 1, nan});
  learner.add({0, 1, {1, 0}, 1, infinity});
  learner.add({0, 1, {1, 0}, infinity, 1});
  learner.add({0, 0, {0, 0}, 1, 1});
  EXPECT_EQ(share(learner, 0), 0.3f);
}

}  // namespace
}  // namespace waylight
