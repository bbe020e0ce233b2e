#pragma once
// Running sums of one render, one pixel independent of the next.

#include <vector>

#include "libguide/image/image.h"
#include "libguide/records/aov_set.h"
#include "libguide/transport/path_tracer.h"

namespace waylight {

// Sums over the samples of one pixel. Double, so that 10^6 samples lose nothing.
struct PixelSums {
  Eigen::Array3d radiance = Eigen::Array3d::Zero();
  Eigen::Array3d radiance_squared = Eigen::Array3d::Zero();
  Color albedo = Color::Zero();
  Vec3 normal = Vec3::Zero();
  double depth = 0;
  uint32_t hits = 0;  // samples that met a surface
  uint32_t samples = 0;
  uint32_t invalid = 0;
  uint64_t edges = 0, scatterings = 0, guided = 0, rays = 0, killed = 0, copies = 0;
  double bsdf_share = 0;  // sum over the scatterings

  // filter_weight: of reconstruction by filter importance sampling.
  void add(const PathRecord& path, float filter_weight);
  Eigen::Array3d mean() const;
  Eigen::Array3d variance_of_mean() const;  // unbiased; zero below two samples
};

// Over all pixels, in pixel order.
struct FilmTotals {
  uint64_t samples = 0, edges = 0, scatterings = 0, guided = 0, rays = 0, killed = 0, copies = 0;
  uint64_t invalid = 0;
  double bsdf_share = 0;
};

class Film {
 public:
  Film(int width, int height) : width_(width), height_(height), pixels_(size_t(width) * height) {}

  int width() const { return width_; }
  int height() const { return height_; }
  PixelSums& at(int x, int y) { return pixels_[size_t(y) * width_ + x]; }

  Image develop(const AovSet& aovs) const;
  FilmTotals totals() const;
  // relMSE estimated from the variance of each pixel's mean: var / (mean^2 + 0.01), with the mean of
  // its block of 8 x 8 where the pixel is above that by chance. NaN below two samples. Light that no
  // sample found yet it cannot know.
  double estimated_relmse() const;

 private:
  double block_error(int x0, int y0, int x1, int y1) const;

  int width_, height_;
  std::vector<PixelSums> pixels_;
};

}  // namespace waylight
