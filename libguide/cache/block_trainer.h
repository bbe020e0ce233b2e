#pragma once
// One kind of photon on its way into the cells of its tree.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "libguide/base/parallel.h"
#include "libguide/base/run_control.h"
#include "libguide/spatial/leaf_order.h"

namespace waylight {

// What becomes of a photon.
struct PhotonVerdict {
  bool valid = true;     // else it is rejected
  bool counts = true;    // its cell absorbs it
  bool dropped = false;  // it is direct light that was not wanted
};

struct BlockTally {
  uint64_t photons = 0, rejected = 0, dropped_direct = 0, weights_capped = 0;
};

// Photons are worked off in blocks whose ends depend on their number alone. Cells are split between
// blocks only, so the first blocks are short: a quarter of what came before. Within a block every
// cell takes its photons in their order: the result does not depend on threads.
// Rules: judge(photon), emitted, tree and cell options.
template <typename Photon, typename Tree, typename Rules>
class BlockTrainer {
 public:
  BlockTrainer() = default;
  // photons: of the training before this stream.
  BlockTrainer(Tree tree, const Rules& rules, uint64_t photons)
      : tree_(std::move(tree)), rules_(rules), photons_(photons) {}

  void consume(std::span<const Photon> photons);
  // control: told of the cells as they learn from their last photons.
  void finish(const RunControl& control = {});

  Tree& tree() { return tree_; }
  const Tree& tree() const { return tree_; }
  const Rules& rules() const { return rules_; }
  uint64_t photons() const { return photons_; }  // of the whole training, refused ones included
  const BlockTally& tally() const { return tally_; }  // of this stream

 private:
  static constexpr size_t kMinBlock = 1 << 12, kMaxBlock = 1 << 18;
  static constexpr size_t kPhotonsPerTask = 1 << 12, kCellsPerReport = 1 << 10;

  void process_block();
  void find_leaves();
  BlockTally find_leaves_of_task(size_t task);
  void absorb_block();
  void count_capped() {
    for (const size_t capped : capped_) tally_.weights_capped += capped;
  }

  Tree tree_;
  Rules rules_;
  uint64_t photons_ = 0;
  BlockTally tally_;
  std::vector<Photon> block_;
  std::vector<uint32_t> leaf_;  // of each photon of the block
  LeafOrder order_;
  std::vector<size_t> capped_;  // of each occupied cell
};

template <typename Photon, typename Tree, typename Rules>
void BlockTrainer<Photon, Tree, Rules>::consume(std::span<const Photon> photons) {
  while (!photons.empty()) {
    const size_t size = std::clamp<uint64_t>(photons_ / 4, kMinBlock, kMaxBlock);
    const size_t wanted = size - block_.size();
    const size_t taken = std::min(wanted, photons.size());
    block_.insert(block_.end(), photons.begin(), photons.begin() + taken);
    photons = photons.subspan(taken);
    if (taken == wanted) process_block();
  }
}

// Splitting comes first, not last: children made at the end of a stream would have seen nothing.
template <typename Photon, typename Tree, typename Rules>
void BlockTrainer<Photon, Tree, Rules>::process_block() {
  tree_.split_full_cells(rules_.tree, rules_.cell, static_cast<double>(photons_));
  find_leaves();
  order_.sort(leaf_, tree_.size());
  absorb_block();
  photons_ += block_.size();
  tally_.photons += block_.size();
  block_.clear();
}

template <typename Photon, typename Tree, typename Rules>
void BlockTrainer<Photon, Tree, Rules>::find_leaves() {
  leaf_.resize(block_.size());
  const size_t tasks = (block_.size() + kPhotonsPerTask - 1) / kPhotonsPerTask;
  std::vector<BlockTally> tallies(tasks);
  parallel_for(tasks, [&](size_t task) { tallies[task] = find_leaves_of_task(task); });
  for (const BlockTally& tally : tallies) {
    tally_.rejected += tally.rejected;
    tally_.dropped_direct += tally.dropped_direct;
  }
}

template <typename Photon, typename Tree, typename Rules>
BlockTally BlockTrainer<Photon, Tree, Rules>::find_leaves_of_task(size_t task) {
  BlockTally tally;
  const size_t end = std::min(block_.size(), (task + 1) * kPhotonsPerTask);
  for (size_t i = task * kPhotonsPerTask; i < end; ++i) {
    const PhotonVerdict verdict = rules_.judge(block_[i]);
    leaf_[i] = verdict.counts ? tree_.find(block_[i]) : LeafOrder::kNone;
    tally.rejected += !verdict.valid;
    tally.dropped_direct += verdict.dropped;
  }
  return tally;
}

template <typename Photon, typename Tree, typename Rules>
void BlockTrainer<Photon, Tree, Rules>::absorb_block() {
  const std::span<const uint32_t> occupied = order_.occupied();
  capped_.resize(occupied.size());
  parallel_for(occupied.size(), [&](size_t i) {
    const uint32_t cell = occupied[i];
    capped_[i] = tree_[cell].absorb(block_, order_.points(cell), rules_.emitted, rules_.cell);
  });
  count_capped();
}

template <typename Photon, typename Tree, typename Rules>
void BlockTrainer<Photon, Tree, Rules>::finish(const RunControl& control) {
  if (!block_.empty()) process_block();
  const size_t cells = tree_.size();
  for (size_t first = 0; first < cells && !control.stopped(); first += kCellsPerReport) {
    capped_.resize(std::min(kCellsPerReport, cells - first));
    parallel_for(capped_.size(),
                 [&](size_t i) { capped_[i] = tree_[first + i].flush(rules_.cell); });
    count_capped();
    control.progress(static_cast<double>(first + capped_.size()), static_cast<double>(cells),
                     "cells fitted");
  }
}

}  // namespace waylight
