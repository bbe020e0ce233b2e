#pragma once
// Cells in training and the tree over them, whatever the cells hold.

#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "libguide/base/parallel.h"
#include "libguide/cache/cell_split.h"
#include "libguide/cache/training_clock.h"
#include "libguide/spatial/leaf_finder.h"

namespace waylight {

// Who lends its mixture to whom.
struct CellLoan {
  uint32_t borrower = 0, lender = 0;
  float share = 1;  // of the lender's evidence
};

static_assert(kMaxTreeDepth < 256);

// Cell: centre() of its photons; born() in photons of the whole training, and restate_birth(born).
template <typename Cell>
class CellTree {
 public:
  explicit CellTree(Cell root = {})
      : nodes_{{0, 0, kLeafAxis}},
        cells_{std::move(root)},
        node_of_cell_{0},
        depth_{0},
        finder_(nodes_) {}
  // nodes: passed check_tree().
  CellTree(std::vector<CacheNode> nodes, std::deque<Cell> cells);

  const std::vector<CacheNode>& nodes() const { return nodes_; }
  const std::deque<Cell>& cells() const { return cells_; }
  uint32_t find(const Vec3& position, const Vec3& normal) const {
    return finder_.find(position, normal);
  }
  size_t size() const { return cells_.size(); }
  Cell& operator[](size_t i) { return cells_[i]; }

  // In index order, while there are fewer than max_cells: the result does not depend on threads.
  // where(cell): a CellSplit or nothing. child(cell, split, upper): one of the two that replace it.
  template <typename Where, typename Child>
  void split_cells(size_t max_cells, const Where& where, const Child& child);

  // Bottom-up: two sibling leaves become one wherever merge(lower, upper, split) gives a cell for
  // both, an optional; the results are siblings in turn. Indices of cells change, their order does
  // not, and the result does not depend on threads.
  template <typename Merge>
  void merge_siblings(const Merge& merge);

  // Orders cells and nodes depth first, as a walk of the tree meets them: what lies close together
  // in space does so in memory. Indices of cells change.
  void sort_by_place();

  // Restates when cells were made so that the photons since then stand for their particles at the
  // mean rate of the whole training; for a first stream they do.
  void restate_exposure(const TrainingClock& clock);

  // The nearest relative that can lend to each cell in need: needs(cell), can_lend(borrower,
  // lender). Loans are to be made after all were found.
  template <typename Needs, typename CanLend>
  std::vector<CellLoan> find_loans(const Needs& needs, const CanLend& can_lend) const;

  size_t bytes() const {
    return nodes_.capacity() * sizeof(CacheNode) + finder_.bytes() +
           cells_.size() * (sizeof(Cell) + sizeof(uint32_t) + sizeof(uint8_t));
  }

 private:
  // How far a cell looks for a mixture to inherit: ancestors up, and leaves under each.
  static constexpr int kMaxGenerations = 6;
  static constexpr size_t kMaxRelatives = 64;

  void split(uint32_t cell, const CellSplit& split, Cell lower, Cell upper);
  bool is_leaf(uint32_t node) const { return nodes_[node].axis == kLeafAxis; }
  void find_nodes();
  void permute_cells(std::vector<uint32_t>& order);
  std::vector<uint32_t> untried_pairs(std::vector<bool>& tried) const;
  void remove_dead(const std::vector<bool>& dead);
  void remove_unreached_nodes();
  std::vector<uint32_t> parents() const;
  float distance2(uint32_t a, uint32_t b) const {
    return (cells_[a].centre() - cells_[b].centre()).squaredNorm();
  }
  template <typename CanLend>
  std::optional<CellLoan> find_loan(uint32_t borrower, std::span<const uint32_t> parents,
                                    const CanLend& can_lend) const;
  template <typename CanLend>
  std::optional<uint32_t> nearest_lender(uint32_t borrower, uint32_t subtree,
                                         const CanLend& can_lend) const;

  std::vector<CacheNode> nodes_;
  std::deque<Cell> cells_;  // grows without a second copy of all, as a vector would need
  std::vector<uint32_t> node_of_cell_;
  std::vector<uint8_t> depth_;  // of the cell's leaf
  LeafFinder finder_;           // of nodes_ as they are between calls
};

template <typename Cell>
CellTree<Cell>::CellTree(std::vector<CacheNode> nodes, std::deque<Cell> cells)
    : nodes_(std::move(nodes)), cells_(std::move(cells)) {
  find_nodes();
}

// Which node is the leaf of each cell, how deep, and how to get there.
template <typename Cell>
void CellTree<Cell>::find_nodes() {
  node_of_cell_.resize(cells_.size());
  depth_.resize(cells_.size());
  finder_ = LeafFinder(nodes_);
  std::vector<uint8_t> depth(nodes_.size());
  for (uint32_t i = 0; i < nodes_.size(); ++i) {
    const CacheNode& node = nodes_[i];
    if (node.axis == kLeafAxis) {
      node_of_cell_[node.child] = i;
      depth_[node.child] = depth[i];
    } else {
      depth[node.child] = depth[node.child + 1] = static_cast<uint8_t>(depth[i] + 1);
    }
  }
}

template <typename Cell>
template <typename Where, typename Child>
void CellTree<Cell>::split_cells(size_t max_cells, const Where& where, const Child& child) {
  const uint32_t count = static_cast<uint32_t>(cells_.size());
  for (uint32_t i = 0; i < count && cells_.size() < max_cells; ++i) {
    if (depth_[i] >= kMaxTreeDepth) continue;
    const std::optional<CellSplit> place = where(cells_[i]);
    if (place) split(i, *place, child(cells_[i], *place, false), child(cells_[i], *place, true));
  }
  if (cells_.size() > count) finder_ = LeafFinder(nodes_);
}

template <typename Cell>
void CellTree<Cell>::split(uint32_t cell, const CellSplit& split, Cell lower, Cell upper) {
  const uint32_t child = static_cast<uint32_t>(nodes_.size());
  const uint32_t new_cell = static_cast<uint32_t>(cells_.size());
  nodes_[node_of_cell_[cell]] = {split.value, child, split.axis};
  nodes_.push_back({0, cell, kLeafAxis});
  nodes_.push_back({0, new_cell, kLeafAxis});
  cells_[cell] = std::move(lower);
  cells_.push_back(std::move(upper));
  node_of_cell_[cell] = child;
  node_of_cell_.push_back(child + 1);
  depth_[cell] += 1;
  depth_.push_back(depth_[cell]);
}

// A round has all pairs of leaves whose merging was not tried; those that merge may make pairs for
// the next. In chunks, so that few cells are in memory twice.
template <typename Cell>
template <typename Merge>
void CellTree<Cell>::merge_siblings(const Merge& merge) {
  constexpr size_t kChunk = 1024;
  std::vector<bool> tried(nodes_.size()), dead(cells_.size());
  std::vector<std::optional<Cell>> merged;
  for (std::vector<uint32_t> pairs; !(pairs = untried_pairs(tried)).empty();)
    for (size_t first = 0; first < pairs.size(); first += kChunk) {
      const auto chunk = std::span(pairs).subspan(first, std::min(kChunk, pairs.size() - first));
      const auto cell_of = [&](size_t i, uint32_t upper) {
        return nodes_[nodes_[chunk[i]].child + upper].child;
      };
      merged.assign(chunk.size(), std::nullopt);
      parallel_for(chunk.size(), [&](size_t i) {
        const CacheNode& node = nodes_[chunk[i]];
        merged[i] =
            merge(cells_[cell_of(i, 0)], cells_[cell_of(i, 1)], CellSplit{node.axis, node.split});
      });
      for (size_t i = 0; i < chunk.size(); ++i) {
        if (!merged[i]) continue;
        const uint32_t kept = cell_of(i, 0);
        dead[cell_of(i, 1)] = true;
        cells_[kept] = std::move(*merged[i]);
        nodes_[chunk[i]] = {0, kept, kLeafAxis};
      }
    }
  remove_unreached_nodes();
  remove_dead(dead);
  find_nodes();
}

template <typename Cell>
std::vector<uint32_t> CellTree<Cell>::untried_pairs(std::vector<bool>& tried) const {
  std::vector<uint32_t> pairs;
  for (uint32_t i = 0; i < nodes_.size(); ++i) {
    if (tried[i] || is_leaf(i) || !is_leaf(nodes_[i].child) || !is_leaf(nodes_[i].child + 1))
      continue;
    tried[i] = true;
    pairs.push_back(i);
  }
  return pairs;
}

template <typename Cell>
void CellTree<Cell>::remove_dead(const std::vector<bool>& dead) {
  std::vector<uint32_t> index(cells_.size());
  uint32_t count = 0;
  for (uint32_t i = 0; i < cells_.size(); ++i) {
    if (dead[i]) continue;
    index[i] = count;
    if (i != count) cells_[count] = std::move(cells_[i]);
    ++count;
  }
  cells_.erase(cells_.begin() + count, cells_.end());
  for (CacheNode& node : nodes_)
    if (node.axis == kLeafAxis) node.child = index[node.child];
}

// Children come after their parent and beside each other: in the same order they still do.
template <typename Cell>
void CellTree<Cell>::remove_unreached_nodes() {
  std::vector<bool> reached(nodes_.size());
  reached[0] = true;
  std::vector<uint32_t> index(nodes_.size());
  std::vector<CacheNode> kept;
  for (uint32_t i = 0; i < nodes_.size(); ++i) {
    if (!reached[i]) continue;
    index[i] = static_cast<uint32_t>(kept.size());
    kept.push_back(nodes_[i]);
    if (!is_leaf(i)) reached[nodes_[i].child] = reached[nodes_[i].child + 1] = true;
  }
  for (CacheNode& node : kept)
    if (node.axis != kLeafAxis) node.child = index[node.child];
  nodes_ = std::move(kept);
}

// Siblings stay beside each other; what is below the lower one comes before what is below the
// upper.
template <typename Cell>
void CellTree<Cell>::sort_by_place() {
  std::vector<CacheNode> nodes = {nodes_[0]};
  std::vector<uint32_t> order;  // the cells of now, in the order to come
  for (std::vector<uint32_t> open = {0}; !open.empty();) {
    CacheNode& node = nodes[open.back()];
    open.pop_back();
    const uint32_t from = node.child;
    if (node.axis == kLeafAxis) {
      node.child = static_cast<uint32_t>(order.size());
      order.push_back(from);
      continue;
    }
    const uint32_t child = node.child = static_cast<uint32_t>(nodes.size());
    nodes.insert(nodes.end(), {nodes_[from], nodes_[from + 1]});
    open.insert(open.end(), {child + 1, child});
  }
  nodes_ = std::move(nodes);
  permute_cells(order);
  find_nodes();
}

// Cycle by cycle: no more than one cell is in memory twice.
template <typename Cell>
void CellTree<Cell>::permute_cells(std::vector<uint32_t>& order) {
  for (uint32_t first = 0; first < order.size(); ++first) {
    if (order[first] == first) continue;
    Cell lifted = std::move(cells_[first]);
    uint32_t to = first;
    for (uint32_t from; (from = std::exchange(order[to], to)) != first; to = from)
      cells_[to] = std::move(cells_[from]);
    cells_[to] = std::move(lifted);
  }
}

template <typename Cell>
void CellTree<Cell>::restate_exposure(const TrainingClock& clock) {
  if (!clock.needs_restating()) return;
  for (Cell& cell : cells_) {
    const double share = clock.exposure(cell.born()) / clock.particles;
    cell.restate_birth(clock.photons * std::clamp(1 - share, 0.0, 1.0));
  }
}

// The root is its own parent.
template <typename Cell>
std::vector<uint32_t> CellTree<Cell>::parents() const {
  std::vector<uint32_t> parents(nodes_.size());
  for (uint32_t i = 0; i < nodes_.size(); ++i)
    if (nodes_[i].axis != kLeafAxis) parents[nodes_[i].child] = parents[nodes_[i].child + 1] = i;
  return parents;
}

template <typename Cell>
template <typename Needs, typename CanLend>
std::vector<CellLoan> CellTree<Cell>::find_loans(const Needs& needs,
                                                 const CanLend& can_lend) const {
  const std::vector<uint32_t> parents = this->parents();
  std::vector<CellLoan> loans;
  for (uint32_t i = 0; i < cells_.size(); ++i) {
    if (!needs(cells_[i])) continue;
    if (const std::optional<CellLoan> loan = find_loan(i, parents, can_lend))
      loans.push_back(*loan);
  }
  return loans;
}

// Each generation halves the evidence, as the splits in between would have done.
template <typename Cell>
template <typename CanLend>
std::optional<CellLoan> CellTree<Cell>::find_loan(uint32_t borrower,
                                                  std::span<const uint32_t> parents,
                                                  const CanLend& can_lend) const {
  uint32_t node = node_of_cell_[borrower];
  float share = 1;
  for (int i = 0; i < kMaxGenerations && node != 0; ++i) {
    node = parents[node];
    share *= 0.5f;
    if (const std::optional<uint32_t> lender = nearest_lender(borrower, node, can_lend))
      return CellLoan{borrower, *lender, share};
  }
  return std::nullopt;
}

template <typename Cell>
template <typename CanLend>
std::optional<uint32_t> CellTree<Cell>::nearest_lender(uint32_t borrower, uint32_t subtree,
                                                       const CanLend& can_lend) const {
  std::optional<uint32_t> nearest;
  std::vector<uint32_t> open = {subtree};
  for (size_t leaves = 0; !open.empty() && leaves < kMaxRelatives;) {
    const CacheNode& node = nodes_[open.back()];
    open.pop_back();
    if (node.axis != kLeafAxis) {
      open.insert(open.end(), {node.child + 1, node.child});
      continue;
    }
    ++leaves;
    if (!can_lend(cells_[borrower], cells_[node.child])) continue;
    if (!nearest || distance2(borrower, node.child) < distance2(borrower, *nearest))
      nearest = node.child;
  }
  return nearest;
}

}  // namespace waylight
