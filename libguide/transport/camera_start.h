#pragma once
// Where paths that belong to no pixel leave the camera.

#include "libguide/base/sampler.h"
#include "libguide/scene/camera.h"
#include "libguide/scene/scene.h"

namespace waylight {

class CameraStart {
 public:
  explicit CameraStart(const Scene& scene)
      : camera_(scene.description().sensor), film_(scene.description().sensor.film) {
    const int named = scene.description().sensor.medium;
    medium_ = named != kNone ? named : scene.medium_at(camera_.origin());
  }

  // Uniform over the film, or over its crop window: each pixel is a mean over its own area, and the
  // mean of the image one over them all.
  Ray ray(Sampler& sampler) const {
    const Vec2 u = sampler.next_2d();
    Vec2 pixel(u.x() * film_.width, u.y() * film_.height);
    if (film_.crop_width > 0 && film_.crop_height > 0)
      pixel = {film_.crop_x + u.x() * film_.crop_width, film_.crop_y + u.y() * film_.crop_height};
    return camera_.ray(pixel, sampler.next_2d());
  }
  int medium() const { return medium_; }  // that these rays start in

 private:
  Camera camera_;
  FilmDescription film_;
  int medium_ = kNone;
};

}  // namespace waylight
