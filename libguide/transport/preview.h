#pragma once
// A cheap picture of what a render will show: blocks of pixels, few samples each.

#include <atomic>
#include <vector>

#include "libguide/scene/camera.h"
#include "libguide/transport/path_tracer.h"

namespace waylight {

// Means over the samples of one block.
struct PreviewBlock {
  float luminance = 0;  // of the radiance, emitters included
  Color albedo = Color::Zero();
  Vec3 normal = Vec3::Zero();
  float depth = 0;

  void add(const PathRecord& path);  // what misses every surface has depth and normal zero
  void finish(int samples);
};

// Blocks of the film's own grid; those of a crop window and a margin around it, so that what is
// computed from up to kMargin blocks around a pixel does not depend on the window.
struct Preview {
  static constexpr int kBlock = 4;     // pixels along a side
  static constexpr int kSamples = 16;  // of a block: the price of one sample per pixel
  static constexpr int kMargin = 5;    // blocks

  int first_column = 0, first_row = 0, columns = 0, rows = 0;
  std::vector<PreviewBlock> blocks;
  uint64_t rays = 0;

  size_t index(int x, int y) const { return static_cast<size_t>(y) * columns + x; }
  const PreviewBlock& at(int x, int y) const { return blocks[index(x, y)]; }
};

// The same for equal arguments at any thread count. Once `stop` holds, blocks stay black.
Preview render_preview(const PathTracer& tracer, const Camera& camera, const FilmDescription& film,
                       uint64_t seed, const std::atomic<bool>& stop);

}  // namespace waylight
