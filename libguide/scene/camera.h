#pragma once

#include <optional>
#include <vector>

#include "libguide/scene/scene_description.h"

namespace waylight {

// The tangent of half the angle that the width of the film spans.
float tan_half_fov_x(const SensorDescription& sensor);

// Perspective or thin-lens camera over the full film of `width` x `height` pixels; a crop window is
// a choice of pixels, made by who renders. Throws Error for a description that makes no camera.
class Camera {
 public:
  explicit Camera(const SensorDescription& sensor);

  // pixel: position on the film in pixels, (0, 0) the top left corner. u_lens: uniform in the unit
  // square, used by the thin lens alone. Importance is one: a camera ray carries radiance straight
  // to its pixel. The principal offset is Mitsuba's: it is added to the position on the film.
  Ray ray(const Vec2& pixel, const Vec2& u_lens) const;
  const Vec3& origin() const { return origin_; }  // of its lens, the centre
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_, height_;
  Mat3 rotation_;
  Vec3 origin_;
  float tan_half_fov_x_, aspect_;
  float aperture_radius_, focus_distance_;
  Vec2 principal_;
};

// Reconstruction filter used by importance sampling: a sample is drawn about its own pixel with
// density |filter| and carries the sign, so that pixels stay independent [Ernst et al. 2006]. The
// filter is the product of two tabulated ones, linear between nodes 1/64 pixel apart; expectations
// are exact for that.
class FilterSampler {
 public:
  static constexpr float kMaxRadius = 16;  // pixels

  explicit FilterSampler(const FilmDescription& film);

  struct Sample {
    Vec2 offset;   // from the pixel's centre, in pixels
    float weight;  // integral of |filter| / integral of filter, with the sign of the filter
  };
  Sample sample(const Vec2& u) const;

 private:
  struct Node {
    float x, value;
    float cdf;  // of |value| up to x
  };
  std::vector<Node> nodes_;  // no cell between two nodes changes sign
  float weight_ = 1;         // (integral |f|)^2 / (integral f)^2

  float axis(float u, float& sign) const;
};

}  // namespace waylight
