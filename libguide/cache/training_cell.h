#pragma once
// One cell of an illumination cache while it is trained.

#include <optional>

#include "libguide/cache/cell_evidence.h"
#include "libguide/cache/cell_split.h"
#include "libguide/cache/online_mixture.h"
#include "libguide/cache/photon_extent.h"
#include "libguide/cache/photon_sample.h"
#include "libguide/directional/expectation_maximization.h"
#include "libguide/records/guide_cache.h"
#include "libguide/records/photon.h"

namespace waylight {

// What the training of a cell depends on besides its photons.
struct CellTrainingOptions {
  int components = 8;
  bool drop_direct = false;
  MixturePrior prior;
  bool mixes = false;               // camera paths are among the photons, or were
  double photons_per_particle = 0;  // of the whole training, as far as is known; where it mixes
  double old_share = 0;  // of the photons of the whole training, those of earlier streams
};

// Gaussians over the disk of a cell's mean normal.
struct GaussianLobes {
  using Component = GaussianComponent;
  using Statistics = ComponentStatistics;
  using Point = WeightedPoint;
  using Options = CellTrainingOptions;
  using Record = CacheCell;
  using Training = CellTraining;

  static std::vector<GaussianComponent> fit(std::span<const WeightedPoint> batch, int count,
                                            const MixturePrior& prior);
  static StepwiseResult update(std::span<GaussianComponent> components,
                               std::span<ComponentStatistics> statistics, float& step,
                               std::span<const WeightedPoint> batch, float samples,
                               const MixturePrior& prior);
  static size_t grow(std::span<GaussianComponent> components,
                     std::span<ComponentStatistics> statistics, size_t count, size_t wanted);
};

// About 1.9 KiB; the memory of the training is this per cell and nothing per photon.
class TrainingCell : private OnlineMixture<GaussianLobes> {
 public:
  TrainingCell() = default;
  // A cell of a finished training that goes on.
  TrainingCell(const CacheCell& cell, const CellTraining& training,
               std::span<const GaussianComponent> components,
               std::span<const ComponentStatistics> statistics, const CellReach& reach,
               const CellEvidence& evidence)
      : OnlineMixture(cell, training, components, statistics),
        evidence_(evidence),
        inherited_{reach.min, reach.max},
        made_with_(reach) {}

  // The photons of this cell in one block: block[indices[i]] in that order. Returns how many
  // weighed too much.
  size_t absorb(std::span<const Photon> block, std::span<const uint32_t> indices, float emitted,
                const CellTrainingOptions& options);

  // Takes in the photons that wait for their batch to fill if they are enough to learn from.
  size_t flush(const CellTrainingOptions& options);

  // What EM takes of a photon in the frame of the cell; empty where the cell does not learn from
  // it.
  std::optional<WeightedPoint> point_of(const Photon& photon, float emitted,
                                        const CellTrainingOptions& options) const;
  // Fits the mixture again, to a part of all photons of the stream that lie in the cell, which take
  // the place of those of the stream in its evidence. False where it is left as it is: they are
  // few, also against those that it has learned from.
  bool refit(const PhotonSample<WeightedPoint>& photons, const CellTrainingOptions& options);

  // The cell as one of the two children of its split. Across a position split the lobes, and half
  // of their evidence, are inherited: the light is nearly the same, and new photons soon outweigh
  // the old. Across a split of the normal nothing is: the lobes stand over another hemisphere.
  // upper: the one of larger values. now: photons of the whole training so far; min_area: see
  // irradiance().
  TrainingCell child(const CellSplit& split, bool upper, double now, double min_area,
                     const CellTrainingOptions& options) const;

  // Takes over the mixture of a cell nearby, as a child does that of its parent; `share` of its
  // evidence, in (0, 1], comes with it.
  void inherit_mixture(const TrainingCell& from, float share);

  // The cell with its mixture on the disk of another normal, to first order.
  void turn_to(const Vec3& normal);

  // Becomes one cell with its sibling, as far as all but the mixture goes: irradiance is flux over
  // the area of both, evidence adds up, and it has the given reach.
  void unite(const TrainingCell& sibling, const CellReach& reach, double now, double min_area);
  // The mixture of both, over the disk of the cell's normal.
  void take_mixture(std::span<const GaussianComponent> mixture);

  // Effective photons and samples behind the irradiance, what was inherited included.
  double irradiance_samples() const;
  // Area times photons of the training while the cell was there: the irradiance is flux over it.
  double exposure(double now, double min_area) const { return area(min_area) * (now - born()); }

  // How photons and samples of camera paths are weighed from now on; see irradiance().
  void balance_sources(double now, double min_area, double photons_per_particle);

  // W/m^2, with a few photons' worth of what its parent knew: weight of photons per area and photon
  // of the training, times photons_per_particle, and what camera paths found. Photons on less than
  // min_area count as spread over it.
  float irradiance(double now, double min_area, double photons_per_particle) const;

  const Vec3& centre() const { return training_.position_mean; }
  Bounds lit() const;  // the box of its photons, but for strays, within its reach
  // Of its own photons once there are enough, and of those of the cells that it was made from.
  CellReach reach() const;
  // When the cell was made, in photons of the whole training.
  double born() const { return training_.born; }
  void restate_birth(double born) { training_.born = born; }

  const CacheCell& cell() const { return record_; }
  const CellEvidence& evidence() const { return evidence_; }  // where CellTrainingOptions::mixes
  using OnlineMixture::components;
  using OnlineMixture::statistics;
  using OnlineMixture::training;

 private:
  void locate(std::span<const Photon> block, std::span<const uint32_t> indices, float emitted,
              const CellTrainingOptions& options);
  bool guides(const Photon& photon, const CellTrainingOptions& options) const;
  double photon_irradiance(double now, double min_area) const;
  size_t update(const CellTrainingOptions& options);
  bool on_other_side() const;
  void turn_to_photons();
  void inherit_irradiance(CellTraining& child, double now, double min_area) const;
  std::span<WeightedPoint> batch_on_disk(Batch& batch) const;
  Bounds extent() const;
  double area(double min_area) const;

  CellEvidence evidence_;
  PhotonExtent own_;  // of the photons since the cell was made, in this training
  Bounds inherited_ = {Vec3::Constant(-kInfinity), Vec3::Constant(kInfinity)};
  // The reach of a cell that was merged, or trained before, until its own photons tell.
  std::optional<CellReach> made_with_;
};

}  // namespace waylight
