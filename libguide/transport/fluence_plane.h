#pragma once
// Pictures of the fluence in media over a plane: what a cache says of it, and what it is.

#include "libguide/cache/medium_cache_view.h"
#include "libguide/records/fluence_slice.h"
#include "libguide/transport/path_tracer.h"

namespace waylight {

// The plane seen at a right angle, with square pixels that show all of the bounds of the scene's
// media: z to the right and y up for x, x to the right and z up for y, x to the right and y up for
// z.
class FluencePlane {
 public:
  // Throws Error where the scene has no media or the plane misses their bounds. The scene must
  // outlive this.
  FluencePlane(const Scene& scene, const FluenceSlice& slice, int width, int height);

  Vec3 point(const Vec2& pixel) const;
  // The luminance of the fluence, W/m^2, in all channels of `radiance`: an unbiased estimate, or
  // what the cell there has. Black outside of media.
  PathRecord sample(const Vec2& pixel, const PathTracer& tracer, const MediumCacheView& cache,
                    Sampler& sampler, const PathContext& context) const;

 private:
  const Scene& scene_;
  FluenceSlice slice_;
  Vec3 corner_ = Vec3::Zero();                       // of the picture, top left
  Vec3 right_ = Vec3::Zero(), down_ = Vec3::Zero();  // one pixel
};

}  // namespace waylight
