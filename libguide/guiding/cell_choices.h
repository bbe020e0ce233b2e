#pragma once
// What each cell of the cache is sampled by, learned from recorded paths.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace waylight {

// What is sampled beside the BSDF: incident light, its product with the fitted BSDF or the mean of
// both, or, of several candidates from BSDF and incident light, the one that promises most (RIS).
enum class DirectionGuide { none, illumination, product, mixture, resampled };

struct CellChoice {
  DirectionGuide guide = DirectionGuide::none;
  float bsdf_share = 1;  // of BSDF sampling beside the guide, in (0, 1]
};

// What one path tells of one of its guided vertices. Densities are conditional on the smooth part,
// per steradian, of the direction that was taken.
struct GuidedSample {
  uint32_t cell = 0;
  float bsdf_pdf = 0;
  std::array<float, 2> guide_pdfs{};  // of the learner's guides, in their order
  float pdf = 0;                      // the density it was made with
  float contribution = 0;  // to the pixel by all that came after, relative to the pixel's value
};

// With guide g at 1 - a and BSDF sampling at a, the second moment of a vertex's contributions is,
// from samples of density p,
//   M(g, a) = sum c^2 p / (a p_bsdf + (1 - a) p_g).
// It is known up to a ratio: that of the default, (g_0, a_0), is M_0, and
//   R(g, a) = (n M(g, a) / M_0 + kPriorSamples P(g, a)) / (n + kPriorSamples),
// n being how many samples the cell's evidence is worth: (sum c^2)^2 / sum c^4, so that one large
// contribution counts once, and no more than its sum of c^2 over that of a mean sample, so that
// what hardly shows in the image moves little. P is the ratio for all cells together, itself held
// to 1 + kPriorCurvature (a - a_0)^2 by as many samples. A second moment is at most 1 / a of that
// of BSDF sampling, and a = 1 is BSDF sampling.
//
// Without prices each cell takes the (g, a) of least R. With them, of least variance times time of
// the whole image: with V the variance of all paths and T their work, to first order
//   M_0 R(g, a) / V + n_visits price(g) / T.
class CellChoiceLearner {
 public:
  // guides: one or two; the last, with default_share, is the default.
  CellChoiceLearner(size_t cells, std::span<const DirectionGuide> guides, float default_share)
      : guides_(guides.begin(), guides.end()), default_share_(default_share), evidence_(cells) {}

  void add(const GuidedSample& sample);  // in a fixed order, for equal sums
  // Of the paths that the samples are of: their relative variance and their work, in rays. From now
  // on guides have their price.
  void add_paths(double variance, double work) { variance_ += variance, work_ += work; }
  // By cell; what is best for all cells where nothing was recorded, the default without any record.
  std::vector<CellChoice> choices() const;

 private:
  static constexpr std::array<float, 10> kGrid = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f,
                                                  0.6f, 0.7f, 0.8f, 0.9f, 1.0f};
  static constexpr double kPriorSamples = 16, kPriorCurvature = 2;
  using Table = std::array<std::array<double, kGrid.size()>, 2>;  // by guide and share

  struct Evidence {
    Table moment{};                         // M
    double default_moment = 0;              // M_0
    double squares = 0, fourth_powers = 0;  // sums of c^2 and c^4
    double visits = 0;

    void merge(const Evidence& other);
    double samples() const { return fourth_powers > 0 ? squares * squares / fourth_powers : 0; }
  };
  struct Common {
    Table ratio{};           // P
    double mean_square = 0;  // of a contribution, over effective samples
    double mean_moment = 0;  // M_0 of a visit
  };
  Common common() const;
  CellChoice choose(const Evidence& evidence, const Common& common) const;
  double price(size_t guide, float share) const;

  std::vector<DirectionGuide> guides_;
  float default_share_;
  std::vector<Evidence> evidence_;
  double variance_ = 0, work_ = 0;
};

}  // namespace waylight
