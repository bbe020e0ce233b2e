#pragma once
// Where importance leaves the scene, gathered in training.

#include <span>
#include <vector>

#include "libguide/records/guide_cache.h"
#include "libguide/records/photon.h"
#include "libguide/spatial/escape_map.h"

namespace waylight {

// At most 16 MiB, and nothing until the first escape comes. Weights are luminances of power times
// the particles of the stream, so that streams of any length stand on one footing.
class EscapeHistogram {
 public:
  EscapeHistogram() = default;
  explicit EscapeHistogram(const GuideCache& previous);  // goes on from it

  void add(const EscapeMap& map, const Escape& escape, float emitted);
  // Divides by the particles of the whole training, cache.emitted.
  void store(GuideCache& cache) const;

 private:
  double& weight(uint32_t bin, uint32_t cell);

  std::vector<double> weights_;  // bins times cells, or empty
};

}  // namespace waylight
