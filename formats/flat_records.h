#pragma once
// Records that more than one kind of file holds.

#include "formats/flat_file.h"
#include "libguide/math/types.h"
#include "libguide/records/gaussian.h"

namespace waylight {

FLAT_RECORD(GaussianComponent, fbs::GaussianComponent);

inline Vec3 from_flat(const fbs::Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline fbs::Vec3 to_flat(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline Bounds from_flat(const fbs::Bounds& b) { return {from_flat(b.min()), from_flat(b.max())}; }
inline fbs::Bounds to_flat(const Bounds& b) { return {to_flat(b.min), to_flat(b.max)}; }

}  // namespace waylight
