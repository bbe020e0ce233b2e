#pragma once
// The part of a training that is of media: photons in, cells out.

#include <optional>

#include "libguide/base/run_control.h"
#include "libguide/cache/focus_tree.h"
#include "libguide/cache/photon_rules.h"

namespace waylight {

// What the trainer has to know of its stream.
struct MediumStream {
  Bounds scene;
  uint64_t emitted = 0;        // its particles
  bool holds_photons = false;  // also where none comes: its particles count
};

class MediumTrainer {
 public:
  MediumTrainer() = default;
  // previous: empty, or a training to go on from that passed check() and check_training().
  MediumTrainer(const MediumCache& previous, const MediumStream& stream, const MediumRules& rules,
                bool merges_alike);

  void consume(std::span<const MediumPhoton> photons);
  // After all of the stream, its photons again: where does the indirect light come from?
  void find_foci(std::span<const MediumPhoton> photons);
  // The cells, without any where no photon ever came. control: told of the cells as they are
  // fitted.
  MediumCache finish(const RunControl& control);

  const BlockTally& tally() const { return photons_.tally(); }
  size_t cells_before_merging() const { return cells_before_merging_; }
  size_t bytes() const { return photons_.tree().bytes() + (foci_ ? foci_->tree().bytes() : 0); }

 private:
  void settle();

  BlockTrainer<MediumPhoton, MediumTree, MediumRules> photons_;
  std::optional<BlockTrainer<MediumPhoton, FocusTree, MediumRules>> foci_;  // once that has begun
  MediumStream stream_;
  bool merges_alike_ = false;
  TrainingClock clock_;
  size_t cells_before_merging_ = 0;
};

}  // namespace waylight
