#include "libguide/render.h"

#include <atomic>
#include <chrono>

#include "libguide/base/error.h"
#include "libguide/base/memory.h"
#include "libguide/base/parallel.h"
#include "libguide/scene/camera.h"
#include "libguide/transport/film.h"
#include "libguide/transport/path_tracer.h"
#include "libguide/transport/pixel_estimate.h"

namespace waylight {

namespace {

Roulette roulette_of(const RenderOptions& options) {
  switch (options.roulette) {
    case RouletteMode::none:
      return Roulette::none;
    case RouletteMode::throughput:
      return Roulette::throughput;
    case RouletteMode::guided:
      return Roulette::guided;
    case RouletteMode::automatic:
      break;
  }
  return options.mode == RenderMode::bsdf ? Roulette::throughput : Roulette::guided;
}

}  // namespace

void RenderOptions::validate() const {
  require(spp > 0 || time > 0 || error > 0, "one of --spp, --time and --error must be given");
  require(spp >= 0 && spp <= 1 << 24, "--spp must be in [1, 16777216], not {}", spp);
  require(time >= 0 && std::isfinite(time), "--time must be a number of seconds, not {}", time);
  require(error >= 0 && std::isfinite(error), "--error must be positive, not {}", error);
  require(
      width >= 0 && height >= 0 && width <= 65536 && height <= 65536 && (width > 0) == (height > 0),
      "--size must be WIDTHxHEIGHT with both in [1, 65536]");
  require(max_depth >= -2 && max_depth != 0, "--max-depth must be at least 1, or -1 for no limit");
  require(rr_depth >= -1, "--rr-depth must not be negative");
  require(roulette != RouletteMode::guided || mode != RenderMode::bsdf,
          "--rr guided needs the cache of --mode illumination or product");
  require(split >= 1 && split <= kMaxSplit, "--split must be in [1, {}], not {}", kMaxSplit, split);
  require(split == 1 || roulette_of(*this) == Roulette::guided,
          "--split needs guided roulette: --mode illumination or product, --rr guided or auto");
  require(guiding_prob == -1 || (guiding_prob >= 0 && guiding_prob <= 0.99f),
          "--guiding-prob must be in [0, 0.99], or -1 for the mode's own, not {}", guiding_prob);
}

namespace {

constexpr int kTile = 16;  // pixels along a side
constexpr double kTileArea = kTile * kTile;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// The sums, then the image of every channel, and its copy while it is written.
void require_memory_for(const FilmDescription& film, bool segments) {
  constexpr double kChannels = 16, kBytesPerPixel = sizeof(PixelSums) + 2 * kChannels * 4;
  const double per_pixel = kBytesPerPixel + (segments ? sizeof(SegmentSums) / kTileArea : 0);
  const double needed = per_pixel * film.crop_width * film.crop_height;
  const double limit = static_cast<double>(memory_limit_bytes());
  require(
      needed <= limit,
      "{} x {} pixels need up to {:.1f} GB of memory, and there are {:.1f} GB: reduce --size, or "
      "render windows of it with --crop",
      film.crop_width, film.crop_height, needed / 1e9, limit / 1e9);
}

// The scene's film with the options' size and crop window.
FilmDescription film_of(const FilmDescription& scene_film, const RenderOptions& options) {
  FilmDescription film = scene_film;
  if (options.width > 0) {
    film.crop_x = film.crop_x * options.width / film.width;
    film.crop_width = film.crop_width * options.width / film.width;
    film.crop_y = film.crop_y * options.height / film.height;
    film.crop_height = film.crop_height * options.height / film.height;
    film.width = options.width;
    film.height = options.height;
  }
  if (options.crop_width > 0) {
    film.crop_x = options.crop_x;
    film.crop_y = options.crop_y;
    film.crop_width = options.crop_width;
    film.crop_height = options.crop_height;
  }
  if (film.crop_width <= 0 || film.crop_height <= 0) {
    film.crop_x = film.crop_y = 0;
    film.crop_width = film.width;
    film.crop_height = film.height;
  }
  require(film.crop_x >= 0 && film.crop_y >= 0 && film.crop_x + film.crop_width <= film.width &&
              film.crop_y + film.crop_height <= film.height,
          "the crop window {}x{}+{}+{} leaves the film of {}x{} pixels", film.crop_width,
          film.crop_height, film.crop_x, film.crop_y, film.width, film.height);
  require_memory_for(film, options.segments);
  return film;
}

PathTracerOptions tracer_options(const Scene& scene, const RenderOptions& options) {
  const IntegratorDefaults& defaults = scene.description().integrator;
  PathTracerOptions result;
  result.guide = options.mode == RenderMode::bsdf           ? DirectionGuide::none
                 : options.mode == RenderMode::illumination ? DirectionGuide::illumination
                                                            : DirectionGuide::product;
  const float own_prob = options.mode == RenderMode::product ? 0.7f : 0.5f;
  result.guiding_prob = options.guiding_prob < 0 ? own_prob : options.guiding_prob;
  result.roulette = roulette_of(options);
  result.max_split = options.split;
  result.max_depth = options.max_depth == -2 ? defaults.max_depth : options.max_depth;
  result.rr_depth = options.rr_depth == -1 ? defaults.rr_depth : options.rr_depth;
  result.hide_emitters = defaults.hide_emitters;
  return result;
}

void require_caches(const RenderCaches& caches, RenderMode mode) {
  require(mode == RenderMode::bsdf || !caches.guide.cells.empty(),
          "--mode illumination and product need --cache with at least one trained cell");
  require(mode != RenderMode::product || caches.brdf, "--mode product needs --brdf");
}

// Renders whole passes over the image until one of the stopping rules holds.
class Renderer {
 public:
  Renderer(const Scene& scene, const RenderCaches& caches, const RenderOptions& options,
           const RunControl& control)
      : options_(options),
        control_(control),
        sensor_(scene.description().sensor),
        crop_(sensor_.film = film_of(sensor_.film, options)),
        camera_(sensor_),
        filter_(crop_),
        guiding_(caches.brdf, caches.guide, scene.description().materials),
        tracer_(scene, guiding_, tracer_options(scene, options)),
        film_(crop_.crop_width, crop_.crop_height),
        tiles_x_((film_.width() + kTile - 1) / kTile),
        tiles_y_((film_.height() + kTile - 1) / kTile),
        segments_(options.segments ? size_t(tiles_x_) * tiles_y_ : 0) {}

  void run() {
    const Clock::time_point start = Clock::now();
    estimate_pixels();
    preview_seconds_ = seconds_since(start);
    int done = 0;
    for (int count = 1; count > 0 && !stopped_; count = next_pass(done, seconds_since(start))) {
      render_pass(done, count);
      done += count;
      report(done, seconds_since(start));
    }
    seconds_ = seconds_since(start);
  }

  const Film& film() const { return film_; }
  double seconds() const { return seconds_; }
  double preview_seconds() const { return preview_seconds_; }
  uint64_t preview_rays() const { return preview_rays_; }
  bool interrupted() const { return stopped_; }
  // Added in the order of tiles, so that threads do not matter.
  SegmentSums segments() const {
    SegmentSums sums;
    for (const SegmentSums& tile : segments_) sums.merge(tile);
    return sums;
  }

 private:
  static constexpr int kMaxPass = 16;

  // Samples per pixel of the next pass; 0 when the render is done.
  int next_pass(int done, double seconds) const {
    int count = std::min(done, kMaxPass);
    if (options_.spp > 0) count = std::min(count, options_.spp - done);
    if (options_.time > 0) {
      const double left = (options_.time - seconds) / ((seconds - preview_seconds_) / done);
      count = left < 0.5 ? 0 : std::min(count, std::max(1, int(left)));
    }
    if (options_.error > 0 && done >= 4 && film_.estimated_relmse() <= options_.error) count = 0;
    return count;
  }

  void estimate_pixels() {
    if (roulette_of(options_) != Roulette::guided) return;
    if (options_.pixel_estimate != PixelEstimateMode::preview) return;
    const Preview preview = render_preview(tracer_, camera_, crop_, options_.seed, stopped_);
    estimates_ = PixelEstimates(preview);
    preview_rays_ = preview.rays;
  }

  void render_pass(int first, int count) {
    parallel_for(size_t(tiles_x_) * tiles_y_, [&](size_t tile) {
      const int x0 = int(tile % tiles_x_) * kTile, y0 = int(tile / tiles_x_) * kTile;
      SegmentSums* segments = segments_.empty() ? nullptr : &segments_[tile];
      for (int y = y0; y < std::min(y0 + kTile, film_.height()); ++y)
        for (int x = x0; x < std::min(x0 + kTile, film_.width()); ++x)
          if (!stopped_) render_pixel(x, y, first, count, segments);
      if (control_.stopped()) stopped_ = true;
    });
  }

  void render_pixel(int x, int y, int first, int count, SegmentSums* segments) {
    const int film_x = crop_.crop_x + x, film_y = crop_.crop_y + y;
    PathContext context{estimates_.at(film_x, film_y), 1, segments};
    const uint64_t stream = uint64_t(film_y) * crop_.width + film_x;
    for (int s = first; s < first + count; ++s) {
      Sampler sampler(options_.seed, stream, s);
      const FilterSampler::Sample offset = filter_.sample(sampler.next_2d());
      const Vec2 pixel = Vec2(film_x + 0.5f, film_y + 0.5f) + offset.offset;
      const Ray ray = camera_.ray(pixel, sampler.next_2d());
      context.filter_weight = offset.weight;
      film_.at(x, y).add(tracer_.trace(ray, sampler, context), offset.weight);
    }
    if (segments) segments->samples += count;
  }

  void report(int done, double seconds) const {
    if (options_.time > 0 &&
        (options_.spp == 0 || seconds / options_.time > double(done) / options_.spp))
      control_.progress(std::min(seconds, options_.time), options_.time, "s");
    else
      control_.progress(done, options_.spp, "spp");
  }

  const RenderOptions& options_;
  const RunControl& control_;
  SensorDescription sensor_;
  FilmDescription crop_;
  Camera camera_;
  FilterSampler filter_;
  GuidingCaches guiding_;
  PathTracer tracer_;
  PixelEstimates estimates_;
  Film film_;
  int tiles_x_, tiles_y_;
  std::vector<SegmentSums> segments_;  // one per tile; empty when not asked for
  double seconds_ = 0, preview_seconds_ = 0;
  uint64_t preview_rays_ = 0;
  std::atomic<bool> stopped_{false};
};

}  // namespace

namespace {

RenderSummary summarize(const Renderer& renderer) {
  const Film& film = renderer.film();
  const FilmTotals totals = film.totals();
  RenderSummary summary;
  summary.width = film.width();
  summary.height = film.height();
  summary.seconds = renderer.seconds();
  summary.interrupted = renderer.interrupted();
  summary.mean_spp = double(totals.samples) / (double(film.width()) * film.height());
  summary.mean_path_length = double(totals.edges) / std::max<double>(totals.samples, 1);
  summary.guiding_share = double(totals.guided) / std::max<double>(totals.scatterings, 1);
  summary.estimated_relmse = film.estimated_relmse();
  summary.rays = totals.rays + renderer.preview_rays();
  summary.preview_seconds = renderer.preview_seconds();
  const double samples = std::max<double>(totals.samples, 1);
  summary.killed_share = double(totals.killed) / (samples + double(totals.copies));
  summary.copies_per_path = double(totals.copies) / samples;
  summary.segments = renderer.segments();
  summary.invalid_samples = totals.invalid;
  return summary;
}

}  // namespace

Image render(const Scene& scene, const RenderCaches& caches, const RenderOptions& options,
             RenderSummary* summary, const RunControl& control) {
  options.validate();
  require_caches(caches, options.mode);
  Renderer renderer(scene, caches, options, control);
  renderer.run();
  const RenderSummary result = summarize(renderer);
  if (result.invalid_samples > 0)
    control.warn(
        fmt::format("{} samples were NaN or infinite and count as zero", result.invalid_samples));
  if (summary) *summary = result;
  return renderer.film().develop(options.aovs);
}

}  // namespace waylight
