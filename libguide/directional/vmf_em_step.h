#pragma once
// The two halves of one EM iteration over directions, shared by batch and stepwise EM.

#include <array>

#include "libguide/directional/vmf_em.h"

namespace waylight {

bool valid_direction(const WeightedDirection& point);
BatchWeights scan_weights(std::span<const WeightedDirection> points, float max_weight);

// Sufficient statistics of one pass over a batch, as in VmfStatistics.
struct VmfBatchStatistics {
  std::array<VmfStatistics, kMaxEmComponents> components;
  double log_likelihood = 0;  // mean by weight, natural logarithm; only if asked for
};

// Eight directions. Those that are not valid, and those that fill the last row up, have weight zero.
struct DirectionRow {
  Lanes x{}, y{}, z{}, weight{};
};
void fill_rows(std::span<const WeightedDirection> points, const BatchWeights& weights,
               std::span<DirectionRow> rows);  // of row_count(points.size())

// One lobe in the form that the E-step needs.
struct VmfResponsibility {
  float mean_x, mean_y, mean_z, half, log2_norm;  // half = log2(e) kappa / 2

  VmfResponsibility() = default;
  explicit VmfResponsibility(const VmfComponent& c);

  // Of weight times density.
  Lanes log2_density(const DirectionRow& row) const {
    const Lanes dx = row.x - mean_x, dy = row.y - mean_y, dz = row.z - mean_z;
    return log2_norm - half * (dx * dx + dy * dy + dz * dz);
  }
};

// The E-step over a batch, block by block.
class VmfExpectation {
 public:
  VmfExpectation(std::span<const VmfComponent> components, Likelihood likelihood);
  void add(std::span<const DirectionRow> rows);
  VmfBatchStatistics finish() const;

 private:
  using Moments = std::array<double, 4>;  // 1, x, y, z

  static void add_moments(std::span<const DirectionRow> rows, const Lanes* share,
                          Moments& moments);

  size_t count_;
  Likelihood likelihood_;
  std::array<VmfResponsibility, kMaxEmComponents> model_;
  std::array<Moments, kMaxEmComponents> moments_{};
  double log2_likelihood_ = 0;
};

// Lobes of the statistics with n = samples (at least 1); those without support are left out of both,
// the others moved to the front. Returns how many are left.
int maximization(std::span<VmfStatistics> statistics, float samples, const VmfPrior& prior,
                 std::span<VmfComponent> components);

}  // namespace waylight
