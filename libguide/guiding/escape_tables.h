#pragma once
// Where importance leaves the scene, prepared for emission from afar.

#include <vector>

#include "libguide/cache/guide_cache_view.h"
#include "libguide/guiding/primary_table.h"
#include "libguide/spatial/escape_map.h"

namespace waylight {

class EscapeTables {
 public:
  explicit EscapeTables(const GuideCacheView& importance);

  // Luminance of the importance that leaves the scene towards there, 1/(m^2 sr), mean over the disk
  // of EscapeMap.
  float importance(const Vec3& to_light) const;
  // Places on the disk for a particle from there, as EscapeMap::position, in proportion to the
  // importance; uniform where none is known. The table is smoothed: a bin has 4.5 degrees, over
  // which a window's shadow on the disk moves by about a cell.
  Vec2 sample(const Vec3& to_light, float u, const Vec2& u2) const;
  float pdf(const Vec3& to_light, const Vec2& position) const;

 private:
  struct Bin {
    PrimaryTable places;
    float importance = 0;
  };
  const Bin& bin_of(const Vec3& to_light) const;

  std::vector<int> index_;  // of each bin of EscapeMap into bins_; empty: none are known
  std::vector<Bin> bins_;   // the first stands for all where nothing is known
};

}  // namespace waylight
