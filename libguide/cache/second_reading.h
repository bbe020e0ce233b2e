#pragma once
// The cells of a finished tree while the photons of its stream are read once more.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace waylight {

// What BlockTrainer takes for a tree; no cell of it is split. Cell: made of a cell of the tree, and
// keeps Cell::kMostPhotons of Cell::Kept at most. The tree has to stay where it is.
template <typename Tree, typename Cell>
class SecondReading {
 public:
  SecondReading() = default;
  explicit SecondReading(Tree& tree) : tree_(&tree) {
    for (size_t i = 0; i < tree.size(); ++i) cells_.emplace_back(tree[i]);
  }

  uint32_t find(const auto& photon) const { return tree_->find(photon); }
  size_t size() const { return cells_.size(); }
  Cell& operator[](size_t i) { return cells_[i]; }
  const std::vector<Cell>& cells() const { return cells_; }
  void split_full_cells(const auto& /*tree*/, const auto& /*cell*/, double /*now*/) {}
  size_t bytes() const {  // at most
    return size() * (sizeof(Cell) + Cell::kMostPhotons * sizeof(typename Cell::Kept));
  }

 private:
  Tree* tree_ = nullptr;
  std::vector<Cell> cells_;
};

}  // namespace waylight
