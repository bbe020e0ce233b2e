#include "libguide/cache/refit_tree.h"

namespace waylight {

size_t RefitCell::absorb(std::span<const Photon> block, std::span<const uint32_t> indices,
                         float emitted, const CellTrainingOptions& options) {
  for (const uint32_t i : indices)
    if (const auto point = cell_->point_of(block[i], emitted, options)) photons_.add(*point);
  return 0;
}

size_t RefitCell::flush(const CellTrainingOptions& options) {
  refitted_ = cell_->refit(photons_, options);
  photons_ = PhotonSample<WeightedPoint>(0);
  return 0;
}

}  // namespace waylight
