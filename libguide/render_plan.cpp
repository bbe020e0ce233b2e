#include "libguide/render_plan.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "libguide/base/error.h"
#include "libguide/base/memory.h"
#include "libguide/base/parallel.h"
#include "libguide/transport/film.h"

namespace waylight {
namespace {

constexpr double kTileArea = kRenderTile * kRenderTile;

DirectionGuide guide_of(RenderMode mode) {
  switch (mode) {
    case RenderMode::bsdf:
      return DirectionGuide::none;
    case RenderMode::illumination:
      return DirectionGuide::illumination;
    case RenderMode::product:
      return DirectionGuide::product;
    case RenderMode::mixture:
      return DirectionGuide::mixture;
    case RenderMode::ris:
      return DirectionGuide::resampled;
    case RenderMode::automatic:
      return DirectionGuide::product;
  }
  return DirectionGuide::none;
}

PhaseGuide phase_guide_of(const RenderOptions& options) {
  if (options.direction == PhaseMode::mixture) return PhaseGuide::mixture;
  if (options.direction == PhaseMode::product) return PhaseGuide::product;
  const bool guided = options.direction == PhaseMode::automatic && options.mode != RenderMode::bsdf;
  return guided ? PhaseGuide::product : PhaseGuide::none;
}

FlightMethod flight_of(const RenderOptions& options) {
  switch (options.distance) {
    case DistanceMode::standard:
      return FlightMethod::standard;
    case DistanceMode::guided:
      return FlightMethod::guided;
    case DistanceMode::probability:
      return FlightMethod::probability;
    case DistanceMode::equiangular:
      return FlightMethod::equiangular;
    case DistanceMode::exponential:
      return FlightMethod::exponential;
    case DistanceMode::automatic:
      break;
  }
  return options.mode == RenderMode::bsdf ? FlightMethod::standard : FlightMethod::guided;
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

int split_of(const RenderOptions& options) {
  if (options.split > 0) return options.split;
  return options.mode == RenderMode::automatic ? 2 : 1;
}

}  // namespace

bool guides_media(const RenderOptions& options) {
  return needs_guides(flight_of(options)) || phase_guide_of(options) != PhaseGuide::none ||
         roulette_of(options) == Roulette::guided;
}

bool insists_on_media(const RenderOptions& options) {
  return options.distance == DistanceMode::guided ||
         options.distance == DistanceMode::probability || options.direction == PhaseMode::mixture ||
         options.direction == PhaseMode::product || (options.fluence && options.fluence->of_cache);
}

bool needs_cache(const RenderOptions& options) {
  if (options.mode == RenderMode::automatic) return insists_on_media(options);
  return options.mode != RenderMode::bsdf || guides_media(options) || insists_on_media(options);
}

Stopwatch clock_of(const RenderOptions& options) {
  return Stopwatch(options.cpu_clock ? thread_count() : 0);
}

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

namespace {

void check_ending(const RenderOptions& o) {
  require(o.spp > 0 || o.time > 0 || o.error > 0, "one of --spp, --time and --error must be given");
  require(o.spp >= 0 && o.spp <= 1 << 24, "--spp must be in [1, 16777216], not {}", o.spp);
  require(o.time >= 0 && std::isfinite(o.time), "--time must be a number of seconds, not {}",
          o.time);
  require(o.error >= 0 && std::isfinite(o.error), "--error must be positive, not {}", o.error);
  require(
      std::is_sorted(o.checkpoints.begin(), o.checkpoints.end(), std::less_equal<>()) &&
          (o.checkpoints.empty() || (o.checkpoints[0] > 0 && std::isfinite(o.checkpoints.back()))),
      "--checkpoints must be rising numbers of seconds");
}

void check_paths(const RenderOptions& o) {
  require(o.width >= 0 && o.height >= 0 && o.width <= 65536 && o.height <= 65536 &&
              (o.width > 0) == (o.height > 0),
          "--size must be WIDTHxHEIGHT with both in [1, 65536]");
  require(o.max_depth >= -2 && o.max_depth != 0,
          "--max-depth must be at least 1, or -1 for no limit");
  require(o.rr_depth >= -1, "--rr-depth must not be negative");
  require(o.distance_bias > 0 && o.distance_bias <= 10,
          "--distance-bias must be in (0, 10], not {}", o.distance_bias);
  require(o.weight_window >= 1 && o.weight_window <= WeightWindow::kMaxRatio,
          "--weight-window must be in [1, {}], not {}", WeightWindow::kMaxRatio, o.weight_window);
  require(o.split >= 0 && o.split <= kMaxSplit, "--split must be in [0, {}], not {}", kMaxSplit,
          o.split);
}

// What has no effect is refused: it would be believed to have one.
void check_effects(const RenderOptions& o) {
  const RenderOptions defaults;
  const bool guided = roulette_of(o) == Roulette::guided;
  const auto needs_roulette = [&](bool is_default, const char* option) {
    require(is_default || guided,
            "{} needs guided roulette: --rr guided, or a mode other than bsdf", option);
  };
  needs_roulette(o.split <= 1, "--split");
  needs_roulette(o.weight_window == defaults.weight_window, "--weight-window");
  needs_roulette(o.pixel_estimate == defaults.pixel_estimate, "--pixel-estimate preview");
  require(o.mode == RenderMode::ris || o.candidates == defaults.candidates,
          "--candidates are those of --mode ris");
  require(o.mode != RenderMode::bsdf || o.share_rule == ShareRule::automatic,
          "--bsdf-share is for modes that guide: --mode bsdf has nothing else");
  require(o.distance == DistanceMode::exponential || o.distance_bias == defaults.distance_bias,
          "--distance-bias is for --distance exponential");
}

void check_directions(const RenderOptions& o) {
  require(o.bsdf_share >= 0.01f && o.bsdf_share <= 1,
          "--bsdf-share must be learned or in [0.01, 1], not {}", o.bsdf_share);
  require(o.mode != RenderMode::automatic || o.share_rule == ShareRule::automatic,
          "--bsdf-share is not for --mode auto, which finds it out by itself");
  require(
      o.share_rule != ShareRule::learned || o.mode != RenderMode::ris,
      "--bsdf-share learned is not for --mode ris, whose share is that of the candidates: give a "
      "number");
  require(o.candidates >= 1 && o.candidates <= 64, "--candidates must be in [1, 64], not {}",
          o.candidates);
}

void check_view(const RenderOptions& o) {
  const bool of_camera = !o.fluence && !o.sphere;
  require(of_camera || o.mode != RenderMode::automatic,
          "--mode auto compares ways to render what the camera sees, which --fluence and --sphere "
          "are not");
  require(of_camera || o.pixel_estimate == PixelEstimateMode::cache,
          "--pixel-estimate preview is of what the camera sees, which --fluence and --sphere are "
          "not");
  require(!o.fluence || !o.sphere, "--fluence and --sphere are two pictures: give one of them");
}

}  // namespace

void RenderOptions::validate() const {
  check_ending(*this);
  check_paths(*this);
  check_directions(*this);
  check_effects(*this);
  check_view(*this);
}

float default_share(RenderMode mode) {
  return needs_fits(mode) || mode == RenderMode::automatic ? 0.3f : 0.5f;
}

bool learns_shares(const RenderOptions& options) {
  if (options.mode == RenderMode::bsdf || options.mode == RenderMode::ris ||
      options.mode == RenderMode::automatic)
    return false;
  if (options.share_rule == ShareRule::automatic) return options.mode == RenderMode::illumination;
  return options.share_rule == ShareRule::learned;
}

PathTracerOptions tracer_options(const Scene& scene, const RenderOptions& options) {
  const IntegratorDefaults& defaults = scene.description().integrator;
  PathTracerOptions result;
  result.directions.guide = guide_of(options.mode);
  result.directions.bsdf_share =
      options.share_rule == ShareRule::fixed ? options.bsdf_share : default_share(options.mode);
  result.directions.candidates = options.candidates;
  result.directions.learned = learns_shares(options);
  result.phases.guide = phase_guide_of(options);
  if (options.direction == PhaseMode::mixture) result.phases.phase_share = 0.5f;
  result.flight = flight_of(options);
  result.flights.bias = options.distance_bias;
  result.flights.guides_grids = options.distance == DistanceMode::guided;
  result.roulette = roulette_of(options);
  result.window = WeightWindow(options.weight_window);
  result.max_split = split_of(options);
  result.max_depth = options.max_depth == -2 ? defaults.max_depth : options.max_depth;
  result.rr_depth = options.rr_depth == -1 ? defaults.rr_depth : options.rr_depth;
  result.hide_emitters = defaults.hide_emitters && !options.fluence && !options.sphere;
  return result;
}

namespace {

// A window along one axis, in proportion; at least a pixel where there is one.
void scale_window(int size, int& film_size, int& start, int& extent) {
  const auto scaled = [&](int64_t v) { return static_cast<int>(v * size / film_size); };
  start = std::min(scaled(start), size - 1);
  extent = extent > 0 ? std::max(scaled(extent), 1) : extent;
  film_size = size;
}

bool within(int64_t start, int64_t extent, int64_t size) {
  return start >= 0 && start + extent <= size;
}

}  // namespace

FilmDescription film_of(const FilmDescription& scene_film, const RenderOptions& options) {
  FilmDescription film = scene_film;
  if (options.width > 0) {
    scale_window(options.width, film.width, film.crop_x, film.crop_width);
    scale_window(options.height, film.height, film.crop_y, film.crop_height);
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
  require(within(film.crop_x, film.crop_width, film.width) &&
              within(film.crop_y, film.crop_height, film.height),
          "the crop window {}x{}+{}+{} leaves the film of {}x{} pixels", film.crop_width,
          film.crop_height, film.crop_x, film.crop_y, film.width, film.height);
  require_memory_for(film, options.segments);
  return film;
}

}  // namespace waylight
