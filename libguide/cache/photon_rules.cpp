#include "libguide/cache/photon_rules.h"

namespace waylight {
namespace {

// Rounding may leave photons this share of the scene's diameter outside its bounds.
constexpr float kBoundsTolerance = 1e-3f;

bool is_unit(const Vec3& v) { return std::abs(v.squaredNorm() - 1) < 1e-2f; }  // false for NaN

bool contains(const Bounds& bounds, const Vec3& p) {
  return (p.array() >= bounds.min.array()).all() && (p.array() <= bounds.max.array()).all();
}

// False for NaN.
bool is_valid(const Color& power, float emitted, float limit) {
  const float weight = luminance(power) * emitted;
  return weight > 0 && weight < limit && (power >= 0).all();
}

// What a camera path did not find counts too.
bool is_valid(const Photon& photon, float emitted, float limit) {
  if (photon.from == TracedFrom::lights) return is_valid(photon.power, emitted, limit);
  return (photon.power >= 0).all() && luminance(photon.power) < limit;
}

constexpr float kMaxWeight = 1e36f;  // leaves room for the sums of a batch

}  // namespace

Bounds accepted_bounds(Bounds scene) {
  const float margin = kBoundsTolerance * 2 * scene.radius();
  scene.min.array() -= margin;
  scene.max.array() += margin;
  return scene;
}

PhotonVerdict SurfaceRules::judge(const Photon& photon) const {
  const bool valid = is_valid(photon, emitted, kMaxWeight) && is_unit(photon.normal) &&
                     is_unit(photon.direction) && contains(accepted, photon.position);
  const bool dropped = valid && cell.drop_direct && photon.path_depth == 0;
  return {valid, valid && !(dropped && quantity == Quantity::importance), dropped};
}

PhotonVerdict SurfaceRules::judge(const Escape& escape) const {
  const bool valid = is_valid(escape.power, emitted, 1e30f) && is_unit(escape.direction) &&
                     contains(accepted, escape.origin);
  const bool dropped = valid && cell.drop_direct && escape.path_depth == 0;
  return {valid, valid && !dropped, dropped};
}

PhotonVerdict MediumRules::judge(const MediumPhoton& photon) const {
  const bool valid = is_valid(photon.weight, emitted, kMaxWeight) && is_unit(photon.direction) &&
                     contains(accepted, photon.position);
  return {valid, valid, false};
}

}  // namespace waylight
