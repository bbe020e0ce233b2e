#include "libguide/transport/film.h"

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
  double sum = 0;
  for (const PixelSums& pixel : pixels_) {
    const Eigen::Array3d mean = pixel.mean();
    sum += (pixel.variance_of_mean() / (mean * mean + 0.01)).mean();
  }
  return sum / static_cast<double>(pixels_.size());
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
