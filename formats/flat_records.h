#pragma once
// Records that more than one kind of file holds.

#include "formats/flat_file.h"
#include "libguide/math/types.h"
#include "libguide/records/gaussian.h"
#include "libguide/records/quantity.h"

namespace waylight {

FLAT_RECORD(GaussianComponent, fbs::GaussianComponent);

inline Vec3 from_flat(const fbs::Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline fbs::Vec3 to_flat(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline Bounds from_flat(const fbs::Bounds& b) { return {from_flat(b.min()), from_flat(b.max())}; }
inline fbs::Bounds to_flat(const Bounds& b) { return {to_flat(b.min), to_flat(b.max)}; }

inline fbs::Quantity to_flat(Quantity q) {
  return q == Quantity::radiance ? fbs::Quantity::radiance : fbs::Quantity::importance;
}
inline Quantity quantity_from(fbs::Quantity flat, const std::string& path) {
  if (flat > fbs::Quantity::MAX) fail_damaged(path, "a quantity that is not known");
  return flat == fbs::Quantity::radiance ? Quantity::radiance : Quantity::importance;
}

}  // namespace waylight
