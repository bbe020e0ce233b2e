#include "libguide/render.h"

#include <atomic>

#include "libguide/base/error.h"
#include "libguide/base/parallel.h"
#include "libguide/base/stopwatch.h"
#include "libguide/render_pilot.h"
#include "libguide/render_plan.h"
#include "libguide/scene/camera.h"
#include "libguide/scene/sphere_view.h"
#include "libguide/transport/choice_pilot.h"
#include "libguide/transport/film.h"
#include "libguide/transport/fluence_plane.h"
#include "libguide/transport/path_tracer.h"
#include "libguide/transport/pixel_estimate.h"

namespace waylight {

namespace {

constexpr int kTile = kRenderTile;

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
        start_medium_(options.sphere ? scene.medium_at(*options.sphere) : medium_of_camera()),
        film_(crop_.crop_width, crop_.crop_height),
        tiles_x_((film_.width() + kTile - 1) / kTile),
        tiles_y_((film_.height() + kTile - 1) / kTile),
        segments_(options.segments ? size_t(tiles_x_) * tiles_y_ : 0),
        clock_(clock_of(options)) {
    if (options.fluence) plane_.emplace(scene, *options.fluence, crop_.width, crop_.height);
    if (options.sphere) sphere_.emplace(*options.sphere, crop_.width, crop_.height);
    if (needs_fits(options.mode)) guiding_.load_fits();
    use(tracer_options(scene, options));
  }

  void run(const CheckpointSink& on_checkpoint) {
    if (learns_shares(options_)) learn();
    if (options_.mode == RenderMode::automatic)
      use(choose_method(
          scene_, sensor_, *tracer_, guiding_, options_, [&] { return control_.stopped(); },
          &decision_));
    const double before_preview = clock_.seconds();
    estimate_pixels();
    setup_seconds_ = clock_.seconds();
    preview_seconds_ = setup_seconds_ - before_preview;
    for (int count = 1; count > 0 && !stopped_; count = next_pass()) {
      render_pass(count);
      report();
      while (!stopped_ && checkpoint_due(0.5 * seconds_per_sample())) write(on_checkpoint);
    }
    while (!stopped_ && checkpoint_due(kInfinity)) write(on_checkpoint);
    read_clock();
  }

  Image develop() const { return film_.develop(options_.aovs); }

  RenderSummary summary() const {
    const FilmTotals totals = film_.totals();
    const double samples = std::max<double>(totals.samples, 1);
    const double scatterings = std::max<double>(totals.scatterings, 1);
    RenderSummary summary;
    summary.width = film_.width();
    summary.height = film_.height();
    summary.seconds = seconds_;
    summary.cpu_seconds = cpu_seconds_;
    summary.preview_seconds = preview_seconds_;
    summary.interrupted = stopped_;
    summary.mean_spp = double(totals.samples) / (double(film_.width()) * film_.height());
    summary.mean_path_length = double(totals.edges) / samples;
    summary.bsdf_share = totals.scatterings ? totals.bsdf_share / scatterings : 1;
    summary.guiding_share = double(totals.guided) / scatterings;
    summary.estimated_relmse = film_.estimated_relmse();
    summary.rays = totals.rays + preview_rays_;
    summary.killed_share = double(totals.killed) / (samples + double(totals.copies));
    summary.copies_per_path = double(totals.copies) / samples;
    summary.invalid_samples = totals.invalid;
    summary.segments = segments();
    summary.decision = decision_;
    return summary;
  }

 private:
  // Samples between two looks at the error; fewer say little of light that is hard to find.
  static constexpr int kMaxPass = 16;
  static constexpr double kTimeOfPilot = 20;
  static constexpr int kPathsOfPilot = 16;

  void use(const PathTracerOptions& options) {
    tracer_.emplace(scene_, guiding_, options, start_medium_);
  }

  // At most a twentieth of the time goes into the pilot, or a sixteenth of the paths.
  void learn() {
    PathTracerOptions options = tracer_options(scene_, options_);
    options.max_split = 1;
    options.directions.learned = false;
    ChoicePilotOptions pilot;
    pilot.guides = {options.directions.guide};
    pilot.default_share = options.directions.bsdf_share;
    pilot.max_paths = options_.spp > 0
                          ? uint64_t(options_.spp) * crop_.width * crop_.height / kPathsOfPilot
                          : std::numeric_limits<uint64_t>::max();
    const PilotFrame frame(sensor_, options_.seed);
    const PathTracer tracer(scene_, guiding_, options, medium_of_camera());
    guiding_.learned(learn_choices(tracer, frame, guiding_.guide().cells.size(), pilot, [&] {
      return control_.stopped() ||
             (options_.time > 0 && clock_.seconds() > options_.time / kTimeOfPilot);
    }));
  }

  // Samples per pixel of the next pass; 0 when the render is done. The error is judged at
  // multiples of kMaxPass alone: where checkpoints cut passes is up to the clock.
  int next_pass() const {
    int count = std::min(done_, kMaxPass - done_ % kMaxPass);
    if (options_.spp > 0) count = std::min(count, options_.spp - done_);
    if (checkpoint_ < options_.checkpoints.size())
      count = std::min(count, std::max(1, passes_until(options_.checkpoints[checkpoint_])));
    if (options_.time > 0) count = std::min(count, passes_until(options_.time));
    if (options_.error > 0 && done_ % kMaxPass == 0 && film_.estimated_relmse() <= options_.error)
      count = 0;
    return count;
  }

  double seconds_per_sample() const { return (clock_.seconds() - setup_seconds_) / done_; }

  // Samples per pixel that fit into the time; 0 where less than half of one does.
  int passes_until(double seconds) const {
    const double left = std::min((seconds - clock_.seconds()) / seconds_per_sample(), 1e9);
    return left < 0.5 ? 0 : std::max(1, static_cast<int>(left));
  }

  bool checkpoint_due(double tolerance) const {
    return checkpoint_ < options_.checkpoints.size() &&
           clock_.seconds() + tolerance >= options_.checkpoints[checkpoint_];
  }

  void read_clock() {
    seconds_ = clock_.seconds();
    cpu_seconds_ = clock_.cpu_seconds();
  }

  void write(const CheckpointSink& on_checkpoint) {
    read_clock();
    const double due = options_.checkpoints[checkpoint_++];
    clock_.paused([&] { on_checkpoint(due, develop(), summary()); });
  }

  // Added in the order of tiles, so that threads do not matter.
  SegmentSums segments() const {
    SegmentSums sums;
    for (const SegmentSums& tile : segments_) sums.merge(tile);
    return sums;
  }

  void estimate_pixels() {
    if (roulette_of(options_) != Roulette::guided) return;
    if (options_.pixel_estimate != PixelEstimateMode::preview) return;
    const Preview preview = render_preview(*tracer_, camera_, crop_, options_.seed, stopped_);
    estimates_ = PixelEstimates(preview);
    preview_rays_ = preview.rays;
  }

  void render_pass(int count) {
    const int first = done_;
    parallel_for(size_t(tiles_x_) * tiles_y_, [&](size_t tile) {
      const int x0 = int(tile % tiles_x_) * kTile, y0 = int(tile / tiles_x_) * kTile;
      SegmentSums* segments = segments_.empty() ? nullptr : &segments_[tile];
      for (int y = y0; y < std::min(y0 + kTile, film_.height()); ++y)
        for (int x = x0; x < std::min(x0 + kTile, film_.width()); ++x)
          if (!stopped_) render_pixel(x, y, first, count, segments);
      if (control_.stopped()) stopped_ = true;
    });
    done_ += count;
  }

  void render_pixel(int x, int y, int first, int count, SegmentSums* segments) {
    const int film_x = crop_.crop_x + x, film_y = crop_.crop_y + y;
    PathContext context{estimates_.at(film_x, film_y), 1, segments};
    const uint64_t stream = uint64_t(film_y) * crop_.width + film_x;
    for (int s = first; s < first + count; ++s) {
      Sampler sampler(options_.seed, stream, s);
      const FilterSampler::Sample offset = filter_.sample(sampler.next_2d());
      const Vec2 pixel = Vec2(film_x + 0.5f, film_y + 0.5f) + offset.offset;
      context.filter_weight = offset.weight;
      film_.at(x, y).add(sample(pixel, sampler, context), offset.weight);
    }
    if (segments) segments->samples += count;
  }

  int medium_of_camera() const {
    return sensor_.medium != kNone ? sensor_.medium : scene_.medium_at(camera_.origin());
  }

  PathRecord sample(const Vec2& pixel, Sampler& sampler, const PathContext& context) const {
    if (plane_) return plane_->sample(pixel, *tracer_, guiding_.guide().medium, sampler, context);
    if (sphere_) {
      const std::optional<Ray> ray = sphere_->ray(pixel);
      return ray ? tracer_->trace(*ray, sampler, context) : PathRecord();
    }
    const Ray ray = camera_.ray(pixel, sampler.next_2d());
    return tracer_->trace(ray, sampler, context);
  }

  void report() const {
    const double seconds = clock_.seconds();
    if (options_.time > 0 &&
        (options_.spp == 0 || seconds / options_.time > double(done_) / options_.spp))
      control_.progress(std::min(seconds, options_.time), options_.time, "s");
    else
      control_.progress(done_, options_.spp, "spp");
  }

  const Scene& scene_;
  const RenderOptions& options_;
  const RunControl& control_;
  SensorDescription sensor_;
  FilmDescription crop_;
  Camera camera_;
  FilterSampler filter_;
  GuidingCaches guiding_;
  int start_medium_;  // of the paths
  std::optional<FluencePlane> plane_;
  std::optional<SphereView> sphere_;
  std::optional<PathTracer> tracer_;
  AutoDecision decision_;
  PixelEstimates estimates_;
  Film film_;
  int tiles_x_, tiles_y_;
  std::vector<SegmentSums> segments_;  // one per tile; empty when not asked for
  Stopwatch clock_;
  int done_ = 0;           // samples per pixel
  size_t checkpoint_ = 0;  // the next
  double seconds_ = 0, cpu_seconds_ = 0, setup_seconds_ = 0, preview_seconds_ = 0;
  uint64_t preview_rays_ = 0;
  std::atomic<bool> stopped_{false};
};

}  // namespace

Image render(const Scene& scene, const RenderCaches& caches, const RenderOptions& options,
             RenderSummary* summary, const RunControl& control,
             const CheckpointSink& on_checkpoint) {
  options.validate();
  require_caches(caches, options);
  warn_of_fallback(scene, options, control);
  Renderer renderer(scene, caches, options, control);
  renderer.run(on_checkpoint);
  const RenderSummary result = renderer.summary();
  if (result.invalid_samples > 0)
    control.warn(
        fmt::format("{} samples were NaN or infinite and count as zero", result.invalid_samples));
  if (summary) *summary = result;
  return renderer.develop();
}

}  // namespace waylight
