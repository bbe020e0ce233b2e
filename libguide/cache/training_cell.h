#pragma once
// One cell of an illumination cache while it is trained.

#include <array>
#include <optional>
#include <span>

#include "libguide/cache/cell_split.h"
#include "libguide/directional/expectation_maximization.h"
#include "libguide/records/guide_cache.h"
#include "libguide/records/photon.h"

namespace waylight {

// What the training of a cell depends on besides its photons.
struct CellTrainingOptions {
  int components = 8;
  bool drop_direct = false;
  MixturePrior prior;
};

// Photons that one stepwise-EM update takes. Fewer make the step noisy, more make a cell large.
inline constexpr int kBatchSize = 64;

// About 1.7 KiB; the memory of the training is this per cell and nothing per photon.
class TrainingCell {
 public:
  TrainingCell() = default;
  // A cell of a finished training that goes on.
  TrainingCell(const CacheCell& cell, const CellTraining& training,
               std::span<const GaussianComponent> components,
               std::span<const ComponentStatistics> statistics);

  // The photons of this cell in one block: block[indices[i]] in that order. Returns how many
  // weighed too much.
  size_t absorb(std::span<const Photon> block, std::span<const uint32_t> indices, float emitted,
                const CellTrainingOptions& options);

  // Takes in the photons that wait for their batch to fill if they are enough to learn from.
  size_t flush(const CellTrainingOptions& options);

  // The cell as one of the two children of its split. Across a position split the lobes, and half
  // of their evidence, are inherited: the light is nearly the same, and new photons soon outweigh
  // the old. Across a split of the normal nothing is: the lobes stand over another hemisphere.
  // now: photons of the whole training so far; min_area: see irradiance().
  TrainingCell child(const CellSplit& split, double now, double min_area,
                     const CellTrainingOptions& options) const;

  // Takes over the mixture of a cell nearby, as a child does that of its parent; `share` of its
  // evidence, in (0, 1], comes with it.
  void inherit_mixture(const TrainingCell& from, float share);

  // Weight per area and photon of the stream, with a few photons' worth of what its parent knew.
  // Photons on less than min_area count as spread over it.
  float irradiance(double now, double min_area) const;

  // Sets when the cell was made, in photons of the whole training.
  void restate_birth(double born) { training_.born = born; }

  const CacheCell& cell() const { return cell_; }
  const CellTraining& training() const { return training_; }
  std::span<const GaussianComponent> components() const {
    return {components_.data(), cell_.component_count};
  }
  std::span<const ComponentStatistics> statistics() const {
    return {statistics_.data(), cell_.component_count};
  }

 private:
  struct Pending {
    Vec3 direction;  // of the world: the frame of the cell may turn before the batch is full
    float weight = 0;
  };
  using Batch = std::array<WeightedPoint, kBatchSize>;

  bool guides(const Photon& photon, const CellTrainingOptions& options) const;
  size_t update(const CellTrainingOptions& options);
  float weight_cap(std::span<const WeightedPoint> batch) const;
  bool on_other_side() const;
  void forget_mixture();
  void turn_to_photons();
  void inherit_irradiance(CellTraining& child, double now, double min_area) const;
  void weigh_evidence();
  void carry_evidence_over(double sum, size_t photons);
  std::span<WeightedPoint> batch_on_disk(Batch& batch) const;
  void begin(std::span<const WeightedPoint> batch, float effective_samples,
             const CellTrainingOptions& options);
  void step(std::span<const WeightedPoint> batch, float effective_samples,
            const CellTrainingOptions& options);
  void set_mixture(std::span<const GaussianComponent> components,
                   std::span<const ComponentStatistics> statistics);

  CacheCell cell_;
  CellTraining training_;
  std::array<GaussianComponent, GaussianMixture::kMaxComponents> components_;
  std::array<ComponentStatistics, GaussianMixture::kMaxComponents> statistics_;
  std::array<Pending, kBatchSize> pending_;
  int pending_count_ = 0;
  bool carried_over_ = false;  // the evidence is in weights of an earlier stream
};

}  // namespace waylight
