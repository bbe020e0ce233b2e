#include "libguide/cache/medium_trainer.h"

#include "libguide/base/error.h"

namespace waylight {

MediumTrainer::MediumTrainer(const MediumCache& previous, const MediumStream& stream,
                             const MediumRules& rules, bool merges_alike)
    : photons_(
          previous.nodes.empty() ? MediumTree(stream.scene) : MediumTree(previous, stream.scene),
          rules, previous.photons),
      stream_(stream),
      merges_alike_(merges_alike) {
  clock_.photons_before = static_cast<double>(previous.photons);
  clock_.particles_before = static_cast<double>(previous.emitted);
}

void MediumTrainer::consume(std::span<const MediumPhoton> photons) {
  require(!foci_, "photons come before the same photons again");
  stream_.holds_photons |= !photons.empty();
  photons_.consume(photons);
}

void MediumTrainer::find_foci(std::span<const MediumPhoton> photons) {
  if (!foci_) {
    settle();
    foci_.emplace(FocusTree(photons_.tree()), photons_.rules(), 0);
  }
  foci_->consume(photons);
}

// The cells become what they stay but for their foci.
void MediumTrainer::settle() {
  photons_.finish();
  clock_.photons = static_cast<double>(photons_.photons());
  clock_.particles =
      clock_.particles_before + (stream_.holds_photons ? static_cast<double>(stream_.emitted) : 0);
  if (photons_.photons() == 0) return;
  MediumTree& tree = photons_.tree();
  tree.restate_exposure(clock_);
  cells_before_merging_ = tree.size();
  if (merges_alike_) tree.merge_alike(photons_.rules().cell, clock_.photons);
}

MediumCache MediumTrainer::finish(const RunControl& control) {
  if (foci_)
    foci_->finish(control);
  else
    settle();
  MediumCache cache;
  cache.emitted = static_cast<uint64_t>(clock_.particles);
  cache.photons = photons_.photons();
  if (cache.photons == 0) return cache;
  MediumTree& tree = photons_.tree();
  tree.lend_mixtures();
  tree.sort_by_place();
  tree.store(cache, photons_.rules().cell, clock_.photons / clock_.particles);
  return cache;
}

}  // namespace waylight
