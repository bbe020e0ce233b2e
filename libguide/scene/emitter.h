#pragma once
// The contract of every emitter. An emitter is a plain struct with
//
//   double power() const          W, mean of the colour channels; zero: never chosen
//   std::optional<LightSample> sample(from, u, u2) const   as if it were the only emitter
//   std::optional<EmissionSample> emit(u, u_position, u_direction) const     likewise
//
// and, where a BSDF sample can meet it, the density with which sample() makes a direction: `pdf`.
// The choice among emitters is LightSet's.

#include "libguide/scene/scene.h"
#include "libguide/spatial/escape_map.h"

namespace waylight {

// The sphere around the scene, which distant emitters must illuminate in full.
struct SceneSphere {
  Vec3 center = Vec3::Zero();
  float radius = 0;

  SceneSphere() = default;
  explicit SceneSphere(const Bounds& bounds) {
    if (!bounds.empty()) center = bounds.center(), radius = bounds.radius() * kSceneMargin;
  }
  float cross_section() const { return kPi * radius * radius; }
};

inline double mean(const Color& c) { return c.cast<double>().mean(); }

}  // namespace waylight
