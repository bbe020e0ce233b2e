#pragma once
// Stage: trains an illumination cache from a stream of photons, in memory bounded by its cells.

#include <memory>
#include <span>

#include "libguide/base/run_control.h"
#include "libguide/directional/expectation_maximization.h"
#include "libguide/directional/vmf_em.h"
#include "libguide/records/guide_cache.h"
#include "libguide/records/photon.h"

namespace waylight {

// Photons straight from an emitter, which next-event estimation samples well, and importons
// straight from the camera, which photons cannot hit. Dropped, such photons still count in the
// irradiance; such importons count in nothing, so that the cache has what photons bring to the
// image by way of a further surface. Media keep direct light apart in any case.
enum class DirectLight { keep, drop };

struct CacheTrainOptions {
  int components = 8;                  // K, 1..8
  int photons_per_cell = 300;          // a cell that saw more is split, 64..10^7
  int medium_photons_per_cell = 2000;  // the same of cells of media
  int max_cells = 200'000;             // 1..10^7, of surfaces and of media each
  // Cells whose mean normal is shorter are split by orientation, 0..1; 0: none.
  float normal_spread = 0.9f;
  DirectLight direct = DirectLight::drop;
  // At the end, cells become one where their photons cannot tell their light apart.
  bool merge_alike = false;
  MixturePrior prior;
  VmfPrior medium_prior;

  void validate() const;
};

struct MediumLightSummary {
  size_t cells_with_mixture = 0;
  double mean_components = 0, mean_effective_samples = 0;

  void add(const MediumLight& light);
};

struct MediumTrainSummary {
  uint64_t photons = 0, rejected = 0, weights_capped = 0;
  size_t cells = 0, cells_before_merging = 0;  // equal where none were to be merged
  size_t cells_with_focus = 0;                 // whose indirect light comes from places
  MediumLightSummary indirect, direct;
  size_t bytes = 0;
};

struct CacheTrainSummary {
  uint64_t photons = 0, rejected = 0, dropped_direct = 0, escapes = 0;
  size_t cells = 0, cells_with_mixture = 0, cells_made = 0;
  size_t mixtures_refitted = 0;     // before any were merged
  size_t cells_before_merging = 0;  // of surfaces; as cells where none were to be merged
  size_t bytes_saved = 0;           // by merging, of the cache without its statistics
  uint64_t weights_capped = 0;      // photons that weighed too much against their cell's mean
  double mean_components = 0, mean_effective_samples = 0, lost_mass = 0;
  size_t bytes = 0;  // memory of all cells at the end; it never depends on the number of photons
  double seconds = 0;
  MediumTrainSummary media;  // all zero where there are none

  void count_cells(const GuideCache& cache);  // how many there are, and what their mixtures hold
};

// consume() any number of batches, then finish(). The result depends on the order of the photons
// but not on how they are cut into calls, nor on the number of threads.
class CacheTrainer {
 public:
  // previous: a cache with training statistics to go on from, or an empty one.
  CacheTrainer(const CacheTrainOptions& options, const PhotonStreamInfo& stream,
               GuideCache previous = {});
  ~CacheTrainer();

  void consume(std::span<const Photon> photons);
  void consume(std::span<const MediumPhoton> photons);
  void consume(std::span<const Escape> escapes);
  // After all of the stream, its photons again, in any number of batches. On surfaces each mixture
  // is fitted anew to those in its cell, most of which the cells before it have learned from. In
  // media, where cells are wide and see more photons, that did not lower the error of images; there
  // cells learn from which places their light comes.
  void refit(std::span<const Photon> photons);
  void refit(std::span<const MediumPhoton> photons);
  // control: told of the second fits; where it stops them, the result is empty.
  GuideCache finish(CacheTrainSummary* summary, const RunControl& control = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace waylight
