// The learned share of BSDF sampling follows the evidence, and nothing else.

#include "libguide/guiding/bsdf_shares.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace waylight {
namespace {

// A vertex whose contribution is `bsdf` / pdf or `guide` / pdf times a density, so that one of the
// two samplers is perfect; directions are spread evenly over a unit interval.
enum class Perfect { bsdf, guide };

void add_samples(ShareLearner& learner, uint32_t cell, Perfect perfect, int count, float share) {
  for (int i = 0; i < count; ++i) {
    const float x = (i + 0.5f) / count;
    GuidedSample s;
    s.cell = cell;
    s.bsdf_pdf = 1;
    s.guide_pdf = 3 * x * x;
    s.pdf = share * s.bsdf_pdf + (1 - share) * s.guide_pdf;
    s.contribution = (perfect == Perfect::bsdf ? s.bsdf_pdf : s.guide_pdf) / s.pdf;
    learner.add(s);
  }
}

TEST(BsdfShares, WithoutEvidenceTheDefaultIsKept) {
  ShareLearner learner(3, 0.35f);
  learner.add({1, 1, 1, 1, 0});
  EXPECT_EQ(learner.shares(), std::vector<float>(3, 0.35f));
}

TEST(BsdfShares, TheBetterOfTwoSamplersGetsTheLargerShare) {
  ShareLearner learner(2, 0.5f);
  add_samples(learner, 0, Perfect::bsdf, 1000, 0.5f);
  add_samples(learner, 1, Perfect::guide, 1000, 0.5f);
  EXPECT_EQ(learner.shares()[0], 1.0f);
  EXPECT_LE(learner.shares()[1], 0.2f);
}

TEST(BsdfShares, CellsOfLittleEvidenceFollowWhatIsCommonToAll) {
  ShareLearner learner(100, 0.3f);
  for (uint32_t cell = 1; cell < 100; ++cell) add_samples(learner, cell, Perfect::bsdf, 20, 0.3f);
  EXPECT_EQ(learner.shares()[0], 1.0f);
  EXPECT_EQ(learner.shares()[1], 1.0f);
}

TEST(BsdfShares, FewSamplesMoveAShareLessThanMany) {
  float last = 0.3f;
  for (const int count : {2, 30, 3000}) {
    ShareLearner learner(1, 0.3f);
    add_samples(learner, 0, Perfect::bsdf, count, 0.3f);
    EXPECT_GE(learner.shares()[0], last) << count;
    last = learner.shares()[0];
  }
  EXPECT_EQ(last, 1.0f);
}

// One contribution that outweighs all others is worth one sample, however large it is.
TEST(BsdfShares, AFireflyDoesNotMoveAShareFar) {
  ShareLearner learner(1, 0.3f);
  add_samples(learner, 0, Perfect::guide, 200, 0.3f);
  learner.add({0, 1, 0.01f, 0.307f, 1e4f});
  EXPECT_LE(std::abs(learner.shares()[0] - 0.3f), 0.21f);
}

TEST(BsdfShares, WhatIsNotANumberIsLeftOut) {
  ShareLearner learner(1, 0.3f);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  learner.add({0, 1, 1, 1, nan});
  learner.add({0, 1, 1, 1, infinity});
  learner.add({0, 1, 1, infinity, 1});
  learner.add({0, 0, 0, 1, 1});
  EXPECT_EQ(learner.shares()[0], 0.3f);
}

}  // namespace
}  // namespace waylight
