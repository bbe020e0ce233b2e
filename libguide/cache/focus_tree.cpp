#include "libguide/cache/focus_tree.h"

namespace waylight {

size_t FocusCell::absorb(std::span<const MediumPhoton> block, std::span<const uint32_t> indices,
                         float emitted, const MediumCellOptions& /*options*/) {
  for (const uint32_t i : indices)
    if (const MediumPhoton& p = block[i]; p.path_depth > 0)
      photons_.add({p.position, p.direction, luminance(p.weight) * emitted});
  return 0;
}

size_t FocusCell::flush(const MediumCellOptions& options) {
  light_->focus(photons_, options.indirect.prior, options.far);
  photons_ = PhotonSample<PlacedDirection>(0);
  return 0;
}

}  // namespace waylight
