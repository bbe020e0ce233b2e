#include "libguide/transport/preview.h"

#include <numeric>

#include "libguide/base/parallel.h"

namespace waylight {
namespace {

constexpr uint64_t kSeedOfPreviews = 0x70726576;  // its samples are not those of the image

// Blocks of one axis: those of pixels [begin, begin + size) and the margin, within the film.
void place(int begin, int size, int film_size, int& first, int& count) {
  const int last = (begin + size - 1) / Preview::kBlock + Preview::kMargin;
  first = std::max(begin / Preview::kBlock - Preview::kMargin, 0);
  count = std::min(last, (film_size - 1) / Preview::kBlock) - first + 1;
}

// Uniform over the part of the block that lies on the film.
float position(int block, float u, int film_size) {
  const int begin = block * Preview::kBlock;
  return begin + u * std::min(Preview::kBlock, film_size - begin);
}

}  // namespace

void PreviewBlock::add(const PathRecord& path) {
  const float value = waylight::luminance(path.radiance);
  if (std::isfinite(value)) luminance += value;
  albedo += path.albedo;
  normal += path.normal;
  depth += path.depth;
}

void PreviewBlock::finish(int samples) {
  const float scale = 1.0f / samples;
  luminance *= scale;
  albedo *= scale;
  normal *= scale;
  depth *= scale;
}

Preview render_preview(const PathTracer& tracer, const Camera& camera, const FilmDescription& film,
                       uint64_t seed, const std::atomic<bool>& stop) {
  Preview preview;
  place(film.crop_x, film.crop_width, film.width, preview.first_column, preview.columns);
  place(film.crop_y, film.crop_height, film.height, preview.first_row, preview.rows);
  preview.blocks.resize(static_cast<size_t>(preview.columns) * preview.rows);
  std::vector<uint64_t> rays(preview.rows);
  const auto render_block = [&](int column, int row, PreviewBlock& block) {
    const uint64_t stream = static_cast<uint64_t>(row) * film.width + column;
    for (int s = 0; s < Preview::kSamples && !stop; ++s) {
      Sampler sampler(hash_combine(seed, kSeedOfPreviews), stream, s);
      const Vec2 u = sampler.next_2d();
      const Vec2 pixel(position(column, u.x(), film.width), position(row, u.y(), film.height));
      const Ray ray = camera.ray(pixel, sampler.next_2d());
      const PathRecord path = tracer.trace(ray, sampler);
      block.add(path);
      rays[row - preview.first_row] += path.rays;
    }
    block.finish(Preview::kSamples);
  };
  parallel_for(preview.rows, [&](size_t y) {
    for (int x = 0; x < preview.columns; ++x)
      render_block(preview.first_column + x, preview.first_row + static_cast<int>(y),
                   preview.blocks[preview.index(x, static_cast<int>(y))]);
  });
  preview.rays = std::accumulate(rays.begin(), rays.end(), uint64_t(0));
  return preview;
}

}  // namespace waylight
