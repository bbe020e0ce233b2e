// The guided density of a vertex in a medium is what its sampler makes.

#include "libguide/guiding/phase_sampler.h"

#include "common/flight_cases.h"
#include "statistical/density_assertions.h"

namespace waylight {
namespace {

using testing::DensityCheck;
using testing::FlightFixture;
using testing::homogeneous;

// Of vertices in one cell that the path reached in three directions.
void expect_valid_densities(const FlightFixture& fixture, const MediumGuide& guide,
                            const PhaseOptions& options, const std::string& name) {
  DensityCheck check;
  check.tests = 36;
  for (const Vec3& wo : {Vec3(0, 0, 1), Vec3(-1, 0, 0), Vec3(0.6f, 0.64f, -0.48f)}) {
    const PhaseSampler phase(fixture.medium.phase(), wo, Vec3::Zero(), &guide,
                             &fixture.guides.phase(0), options);
    EXPECT_TRUE(phase.guided());
    testing::expect_valid_density(
        testing::Sphere{}, name,
        [&](Sampler& sampler) -> std::optional<Vec3> {
          const std::optional<DirectionSample> s = phase.sample(sampler);
          return s ? std::optional<Vec3>(s->wi) : std::nullopt;
        },
        [&](const Vec3& wi) { return phase.pdf(wi); }, check);
  }
}

// Of vertices guided by a mixture, half of it where it can be, over the trust in the cell.
float guide_share_of_mixture(float g) {
  const FlightFixture fixture({"g", homogeneous(Color::Ones(), Color::Ones(), g)});
  const MediumCache cache = testing::cells_along_x();
  const MediumGuides guides(MediumCacheView(cache), fixture.media);
  const MediumGuide& guide = guides.guide(0, 1);
  const PhaseSampler phase(fixture.medium.phase(), Vec3::UnitZ(), Vec3::Zero(), &guide,
                           &guides.phase(0), {PhaseGuide::mixture, 0.5f});
  return (1 - phase.bsdf_share()) / guide.trust();
}

// Those of the cell where light comes towards -x, by itself or from places near and far.
void expect_valid_densities(float g, bool places) {
  const std::string name = "g " + std::to_string(g) + (places ? " places" : "");
  const FlightFixture fixture({name, homogeneous(Color::Ones(), Color::Ones(), g)});
  MediumCache cache = testing::cells_along_x();
  if (places) {
    cache.focused_cells = {{1, 0, 2}};
    cache.focused_lobes = {{0.7f, Vec3(0.3f, 0.4f, 0), 0.2f}, {0.3f, Vec3(1e4f, 0, 0), 3e3f}};
  }
  const MediumGuides guides(MediumCacheView(cache), fixture.media);
  for (const PhaseGuide guide : {PhaseGuide::mixture, PhaseGuide::product})
    for (const bool is_homogeneous : {true, false})
      expect_valid_densities(fixture, guides.guide(0, 1),
                             PhaseOptions{guide}.for_medium(is_homogeneous), name);
}

TEST(PhaseSampler, DensityIsThatOfTheSamples) {
  for (const float g : {0.0f, 0.5f, -0.8f}) expect_valid_densities(g, false);
}

TEST(PhaseSampler, DensityIsThatOfTheSamplesWhereLightComesFromPlaces) {
  for (const float g : {0.0f, 0.5f, -0.8f}) expect_valid_densities(g, true);
}

TEST(PhaseSampler, GridsHaveAtLeastHalfOfThePhaseFunction) {
  EXPECT_EQ(PhaseOptions{PhaseGuide::product}.for_medium(true).phase_share, 0.25f);
  EXPECT_EQ(PhaseOptions{PhaseGuide::product}.for_medium(false).phase_share, 0.5f);
  EXPECT_EQ((PhaseOptions{PhaseGuide::mixture, 0.75f}.for_medium(false).phase_share), 0.75f);
}

TEST(PhaseSampler, MixturesLeaveNarrowPhaseFunctionsToThemselves) {
  EXPECT_FLOAT_EQ(guide_share_of_mixture(0), 0.5f);
  EXPECT_LT(guide_share_of_mixture(-0.99f), 0.02f);
  EXPECT_LT(guide_share_of_mixture(0.99f), 0.02f);
}

}  // namespace
}  // namespace waylight
