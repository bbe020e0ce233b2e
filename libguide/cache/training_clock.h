#pragma once

#include <algorithm>

namespace waylight {

// Photons and particles of the training so far, and of those what came before the current stream.
struct TrainingClock {
  double photons = 0, particles = 0;
  double photons_before = 0, particles_before = 0;

  // False for a first stream, and as long as there are only camera paths.
  bool needs_restating() const {
    return particles > 0 && (particles_before > 0 || photons_before > 0);
  }

  // Particles since a cell was made, `born` in photons: streams differ in photons per particle.
  double exposure(double born) const {
    const double stream = photons - photons_before;
    const double before = photons_before > 0 ? std::max(0.0, 1 - born / photons_before) : 1;
    const double during = stream > 0 ? (photons - std::max(born, photons_before)) / stream : 1;
    return before * particles_before + during * (particles - particles_before);
  }
};

}  // namespace waylight
