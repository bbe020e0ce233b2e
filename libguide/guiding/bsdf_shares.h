#pragma once
// The share of directions that each cell leaves to BSDF sampling, learned from recorded paths.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace waylight {

// What one path tells of one of its guided vertices. Densities are conditional on the smooth part,
// per steradian, of the direction that was taken.
struct GuidedSample {
  uint32_t cell = 0;
  float bsdf_pdf = 0, guide_pdf = 0;
  float pdf = 0;           // the density it was made with: their mixture
  float contribution = 0;  // to the pixel by all that came after, relative to the pixel's value
};

// With share a the second moment of a vertex's contributions is, from samples of density p,
//   M(a) = sum c^2 p / (a p_bsdf + (1 - a) p_guide).
// Each cell takes the a of a small grid that minimises
//   n M(a) / M(a_0) + kPriorSamples P(a),
// a_0 being the default and n how many samples its evidence is worth: (sum c^2)^2 / sum c^4, so
// that one large contribution counts once, and no more than its sum of c^2 over that of a mean
// sample, so that what hardly shows in the image moves little. P is the ratio for all cells
// together, itself held to 1 + kPriorCurvature (a - a_0)^2 by as many samples. The density stays
// positive where the BSDF's own is, and a second moment at most 1 / a of that of BSDF sampling; a =
// 1 is BSDF sampling.
class ShareLearner {
 public:
  ShareLearner(size_t cells, float default_share)
      : default_share_(default_share), evidence_(cells) {}

  void add(const GuidedSample& sample);  // in a fixed order, for equal sums
  // By cell; what is best for all cells where nothing was recorded, the default without any record.
  std::vector<float> shares() const;

 private:
  static constexpr std::array<float, 10> kGrid = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f,
                                                  0.6f, 0.7f, 0.8f, 0.9f, 1.0f};
  static constexpr double kPriorSamples = 16, kPriorCurvature = 2;

  struct Evidence {
    std::array<double, kGrid.size()> moment{};  // M at the shares of the grid
    double default_moment = 0;                  // M at the default share
    double squares = 0, fourth_powers = 0;      // sums of c^2 and c^4

    double samples() const { return fourth_powers > 0 ? squares * squares / fourth_powers : 0; }
  };
  struct Common {
    std::array<double, kGrid.size()> ratio{};  // P at the shares of the grid
    double mean_square = 0;                    // of a contribution, over effective samples
  };
  Common common() const;
  float best_share(const Evidence& evidence, const Common& common) const;

  float default_share_;
  std::vector<Evidence> evidence_;
};

}  // namespace waylight
