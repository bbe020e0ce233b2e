#include "libguide/transport/fluence_plane.h"

#include "libguide/base/error.h"
#include "libguide/scene/medium_lights.h"

namespace waylight {
namespace {

struct PlaneAxes {
  int right, up;
};
constexpr PlaneAxes kAxes[] = {{2, 1}, {0, 2}, {0, 1}};
constexpr char kNames[] = "xyz";

Bounds bounds_of_media(const Scene& scene) {
  Bounds bounds;
  for (int i = 0; i < static_cast<int>(scene.description().media.size()); ++i)
    bounds.extend(medium_bounds(scene, i));
  if (bounds.empty()) fail("--fluence shows the fluence in media, and the scene has none");
  return bounds;
}

}  // namespace

FluencePlane::FluencePlane(const Scene& scene, const FluenceSlice& slice, int width, int height)
    : scene_(scene), slice_(slice) {
  const Bounds bounds = bounds_of_media(scene);
  const auto [right, up] = kAxes[slice.axis];
  const float low = bounds.min[slice.axis], high = bounds.max[slice.axis];
  if (!(slice.position >= low && slice.position <= high))
    fail("--fluence {}={}: the media of the scene are within {} and {}", kNames[slice.axis],
         slice.position, low, high);
  const Vec3 extent = bounds.max - bounds.min;
  const float side = std::max(extent[right] / width, extent[up] / height);
  right_[right] = side, down_[up] = -side;
  corner_ = bounds.center() - 0.5f * (width * right_ + height * down_);
  corner_[slice.axis] = slice.position;
}

Vec3 FluencePlane::point(const Vec2& pixel) const {
  return corner_ + pixel.x() * right_ + pixel.y() * down_;
}

PathRecord FluencePlane::sample(const Vec2& pixel, const PathTracer& tracer,
                                const MediumCacheView& cache, Sampler& sampler,
                                const PathContext& context) const {
  const Vec3 p = point(pixel);
  const int medium = scene_.medium_at(p);
  if (medium == kNone) return {};
  if (!slice_.of_cache) {
    PathRecord record = tracer.gather(p, medium, sampler, context);
    record.radiance = Color::Constant(luminance(record.radiance));
    return record;
  }
  PathRecord record;
  const MediumCell* cell = cache.query(p);
  if (cell) record.radiance = Color::Constant(cell->direct.fluence + cell->indirect.fluence);
  return record;
}

}  // namespace waylight
