#pragma once
// The cells that a ray passes, in order.

#include "libguide/spatial/orientation_tree.h"

namespace waylight {

// A stretch of a ray and its cell.
struct LeafSpan {
  uint32_t cell = 0;
  float t0 = 0, t1 = 0;
};

// Walks a tree that splits no normal axis, over [0, t_max] of a ray, in two to three nodes a cell.
// Spans follow each other without gap or overlap; cells that the ray only touches have no length.
class LeafWalk {
 public:
  // nodes: valid (check_tree) and not empty; must outlive this.
  LeafWalk(std::span<const CacheNode> nodes, const Ray& ray, float t_max)
      : nodes_(nodes), origin_(ray.origin), direction_(ray.direction) {
    inverse_ = ray.direction.cwiseInverse();
    waiting_[0] = {0, t_max};
  }

  // False when the ray has ended.
  bool next(LeafSpan& span) {
    if (depth_ == 0) return false;
    const Later start = waiting_[--depth_];
    const CacheNode* node = nodes_.data() + start.node;
    float t1 = start.t1;
    while (node->axis != kLeafAxis) {
      const float below = node->split - origin_[node->axis];
      const float t = below * inverse_[node->axis];  // infinite or NaN along the plane
      const bool second = below < 0 || (below == 0 && direction_[node->axis] >= 0);
      const uint32_t near = node->child + second, far = node->child + !second;
      if (!(t > 0) || t >= t1) {
        node = nodes_.data() + near;
      } else if (t <= t_) {
        node = nodes_.data() + far;
      } else {
        waiting_[depth_++] = {far, t1};
        node = nodes_.data() + near;
        t1 = t;
      }
    }
    span = {node->child, t_, t1};
    t_ = t1;
    return true;
  }

 private:
  struct Later {
    uint32_t node;
    float t1;
  };

  std::span<const CacheNode> nodes_;
  Vec3 origin_, direction_, inverse_;
  float t_ = 0;
  int depth_ = 1;  // of the stack
  std::array<Later, kMaxTreeDepth + 1> waiting_;
};

}  // namespace waylight
