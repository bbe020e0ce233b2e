#pragma once

#include <array>
#include <cstdint>

#include "libguide/math/types.h"

namespace waylight {

// Where the photons of a cell are, but for one or two that strayed: they are dealt out to eight
// groups, and on each side the box ends where the third of these does. So it keeps what three
// groups met, whatever the number of photons, and lacks about 3.5 / n of the extent of n that are
// spread evenly, on each side.
class PhotonExtent {
 public:
  void add(const Vec3& position) { groups_[count_++ % kGroups].extend(position); }
  uint32_t count() const { return count_; }
  Bounds box() const;  // empty before there are photons for each group

 private:
  static constexpr uint32_t kGroups = 8;

  std::array<Bounds, kGroups> groups_;
  uint32_t count_ = 0;
};

}  // namespace waylight
