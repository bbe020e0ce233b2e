#include "libguide/transport/film.h"

#include <cmath>
#include <functional>

namespace waylight {

void PixelSums::add(const PathRecord& path, float filter_weight) {
  ++samples;
  edges += path.edges;
  scatterings += path.scatterings;
  guided += path.guided;
  bsdf_share += path.bsdf_share;
  rays += path.rays;
  killed += path.killed;
  copies += path.copies;
  if (!is_finite(path.radiance)) {
    ++invalid;
    return;
  }
  const Eigen::Array3d value = (path.radiance * filter_weight).cast<double>();
  radiance += value;
  radiance_squared += value * value;
  if (path.depth <= 0) return;
  ++hits;
  albedo += path.albedo;
  normal += path.normal;
  depth += path.depth;
}

Eigen::Array3d PixelSums::mean() const { return radiance / std::max(samples, 1u); }

Eigen::Array3d PixelSums::variance_of_mean() const {
  if (samples < 2) return Eigen::Array3d::Zero();
  const double n = samples;
  return ((radiance_squared - radiance * radiance / n) / (n * (n - 1))).max(0.0);
}

namespace {

// One group of channels and how a pixel fills it.
struct ChannelGroup {
  bool wanted;
  std::vector<std::string> names;
  std::function<Eigen::Array3d(const PixelSums&)> value;
};

std::vector<ChannelGroup> channel_groups(const AovSet& aovs) {
  const auto per_hit = [](const PixelSums& p) { return 1.0 / std::max(p.hits, 1u); };
  const auto scalar = [](double v) { return Eigen::Array3d(v, 0, 0); };
  return {
      {true, {"R", "G", "B"}, [](const PixelSums& p) { return p.mean(); }},
      {aovs.albedo,
       {"albedo.R", "albedo.G", "albedo.B"},
       [=](const PixelSums& p) -> Eigen::Array3d { return p.albedo.cast<double>() * per_hit(p); }},
      {aovs.normal,
       {"normal.X", "normal.Y", "normal.Z"},
       [=](const PixelSums& p) -> Eigen::Array3d {
         return p.normal.array().cast<double>() * per_hit(p);
       }},
      {aovs.depth, {"depth.Z"}, [=](const PixelSums& p) { return scalar(p.depth * per_hit(p)); }},
      {aovs.sample_count, {"samples.N"}, [=](const PixelSums& p) { return scalar(p.samples); }},
      {aovs.variance,
       {"variance.R", "variance.G", "variance.B"},
       [](const PixelSums& p) { return p.variance_of_mean(); }},
      {aovs.path_length,
       {"path_length.N"},
       [=](const PixelSums& p) { return scalar(double(p.edges) / std::max(p.samples, 1u)); }},
      {aovs.guiding_share,
       {"guiding.share"},
       [=](const PixelSums& p) {
         return scalar(double(p.guided) / std::max<double>(p.scatterings, 1));
       }},
  };
}

}  // namespace

Image Film::develop(const AovSet& aovs) const {
  const std::vector<ChannelGroup> groups = channel_groups(aovs);
  std::vector<std::string> names;
  for (const ChannelGroup& group : groups)
    if (group.wanted) names.insert(names.end(), group.names.begin(), group.names.end());
  Image image(width_, height_, names);
  size_t out = 0;
  for (const PixelSums& pixel : pixels_) {
    for (const ChannelGroup& group : groups) {
      if (!group.wanted) continue;
      const Eigen::Array3d value = group.value(pixel);
      for (size_t c = 0; c < group.names.size(); ++c)
        image.pixels[out++] = static_cast<float>(value[c]);
    }
  }
  return image;
}

double Film::estimated_relmse() const {
  constexpr int kBlock = 8;
  double sum = 0;
  for (int y = 0; y < height_; y += kBlock)
    for (int x = 0; x < width_; x += kBlock)
      sum += block_error(x, y, std::min(x + kBlock, width_), std::min(y + kBlock, height_));
  return sum / static_cast<double>(pixels_.size());
}

// Over its pixels. Where few samples find the light, most pixels have neither mean nor variance,
// and those that were hit have both, and the variance of their mean is its square: what a pixel has
// above the mean of the block and within two standard deviations of it is taken for chance.
double Film::block_error(int x0, int y0, int x1, int y1) const {
  constexpr double kFloor = 0.01, kChance = 2;
  const auto sum_over = [&](const auto& of_pixel) {
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) sum += of_pixel(pixels_[size_t(y) * width_ + x]);
    return sum;
  };
  const Eigen::Array3d mean =
      sum_over([](const PixelSums& p) { return p.mean(); }) / ((x1 - x0) * (y1 - y0));
  const auto error = [&](const PixelSums& p) -> Eigen::Array3d {
    if (p.samples < 2) return Eigen::Array3d::Constant(std::nan(""));
    const Eigen::Array3d own = p.mean(), variance = p.variance_of_mean(), above = own - mean;
    const Eigen::Array3d likely =
        (above > 0 && above < kChance * variance.sqrt()).select(mean, own);
    return variance / (likely * likely + kFloor);
  };
  return sum_over(error).mean();
}

FilmTotals Film::totals() const {
  FilmTotals totals;
  for (const PixelSums& pixel : pixels_) {
    totals.samples += pixel.samples;
    totals.edges += pixel.edges;
    totals.scatterings += pixel.scatterings;
    totals.guided += pixel.guided;
    totals.bsdf_share += pixel.bsdf_share;
    totals.rays += pixel.rays;
    totals.killed += pixel.killed;
    totals.copies += pixel.copies;
    totals.invalid += pixel.invalid;
  }
  return totals;
}

}  // namespace waylight
