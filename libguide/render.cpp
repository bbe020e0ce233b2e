#include "libguide/render.h"

#include <atomic>
#include <chrono>

#include "libguide/base/error.h"
#include "libguide/base/memory.h"
#include "libguide/base/parallel.h"
#include "libguide/render_plan.h"
#include "libguide/scene/camera.h"
#include "libguide/transport/film.h"
#include "libguide/transport/path_tracer.h"
#include "libguide/transport/pixel_estimate.h"
#include "libguide/transport/share_pilot.h"

namespace waylight {

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

void require_caches(const RenderCaches& caches, const RenderOptions& options) {
  const GuideCacheView& guide = caches.guide;
  require(!needs_cache(options) || !guide.cells.empty() || !guide.medium.cells.empty(),
          "all modes but bsdf, and guided decisions in media, need --cache with at least one "
          "trained cell");
  require(!insists_on_media(options) || !guide.medium.cells.empty(),
          "--distance guided and probability, and --direction mixture and product, need a cache of "
          "media: train it on photons of a scene that has some");
  require(!needs_fits(options.mode) || caches.brdf, "--mode product and mixture need --brdf");
}

void warn_of_fallback(const Scene& scene, const RenderOptions& options, const RunControl& control) {
  if (options.distance != DistanceMode::equiangular) return;
  const int media = static_cast<int>(scene.description().media.size());
  for (int i = 0; i < media; ++i)
    if (!scene.medium(i).homogeneous())
      return control.warn(
          "--distance equiangular is for homogeneous media: distances in the others are sampled by "
          "the standard method");
}

std::span<const Medium> guided_media(const Scene& scene, const RenderOptions& options) {
  if (!guides_media(options)) return {};
  return scene.description().media;
}

// Renders whole passes over the image until one of the stopping rules holds.
class Renderer {
 public:
  Renderer(const Scene& scene, const RenderCaches& caches, const RenderOptions& options,
           const RunControl& control)
      : scene_(scene),
        options_(options),
        control_(control),
        sensor_(scene.description().sensor),
        crop_(sensor_.film = film_of(sensor_.film, options)),
        camera_(sensor_),
        filter_(crop_),
        guiding_(caches.brdf, caches.guide, scene.description().materials,
                 guided_media(scene, options)),
        camera_medium_(sensor_.medium != kNone ? sensor_.medium
                                               : scene.medium_at(camera_.origin())),
        tracer_(scene, guiding_, tracer_options(scene, options), camera_medium_),
        film_(crop_.crop_width, crop_.crop_height),
        tiles_x_((film_.width() + kTile - 1) / kTile),
        tiles_y_((film_.height() + kTile - 1) / kTile),
        segments_(options.segments ? size_t(tiles_x_) * tiles_y_ : 0) {}

  void run() {
    const Clock::time_point start = Clock::now();
    if (learns_shares(options_)) learn(start);
    const double before_preview = seconds_since(start);
    estimate_pixels();
    preview_seconds_ = seconds_since(start) - before_preview;
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
  static constexpr double kTimeOfPilot = 20;

  // At most a twentieth of the time goes into the pilot.
  void learn(Clock::time_point start) {
    SharePilotOptions pilot;
    pilot.seed = options_.seed;
    pilot.default_share = default_share(options_.mode);
    pilot.render_paths = uint64_t(options_.spp) * crop_.width * crop_.height;
    PathTracerOptions options = tracer_options(scene_, options_);
    options.max_split = 1;
    const PathTracer unsplit(scene_, guiding_, options, camera_medium_);
    guiding_.learned(learn_shares(unsplit, sensor_, guiding_.guide().cells.size(), pilot, [&] {
      return control_.stopped() ||
             (options_.time > 0 && seconds_since(start) > options_.time / kTimeOfPilot);
    }));
  }

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

  const Scene& scene_;
  const RenderOptions& options_;
  const RunControl& control_;
  SensorDescription sensor_;
  FilmDescription crop_;
  Camera camera_;
  FilterSampler filter_;
  GuidingCaches guiding_;
  int camera_medium_;
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
  summary.bsdf_share = totals.scatterings ? totals.bsdf_share / totals.scatterings : 1;
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
  require_caches(caches, options);
  warn_of_fallback(scene, options, control);
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
