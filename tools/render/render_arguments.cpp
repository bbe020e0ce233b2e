#include "tools/render/render_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "libguide/base/error.h"
#include "tools/common/position.h"

namespace waylight {
namespace {

constexpr int kDefaultSpp = 64;

// In the order of RenderMode.
const std::vector<std::string> kModes = {"bsdf",    "illumination", "mixture",
                                         "product", "ris",          "auto"};
// In the order of DistanceMode and PhaseMode.
const std::vector<std::string> kDistances = {"auto",        "standard",    "guided",
                                             "probability", "equiangular", "exponential"};
const std::vector<std::string> kPhases = {"auto", "standard", "mixture", "product"};
// In the order of RouletteMode.
const std::vector<std::string> kRoulettes = {"auto", "none", "throughput", "guided"};

const std::map<std::string, bool AovSet::*>& aov_names() {
  static const std::map<std::string, bool AovSet::*> kNames = {
      {"albedo", &AovSet::albedo},        {"normal", &AovSet::normal},
      {"depth", &AovSet::depth},          {"samples", &AovSet::sample_count},
      {"variance", &AovSet::variance},    {"path_length", &AovSet::path_length},
      {"guiding", &AovSet::guiding_share}};
  return kNames;
}

void add_aov(const std::string& name, AovSet& set) {
  const auto found = aov_names().find(name);
  require(
      found != aov_names().end() || name == "all",
      "--aov {}: is none of albedo, normal, depth, samples, variance, path_length, guiding, all",
      name);
  for (const auto& [known, member] : aov_names())
    if (name == "all" || name == known) set.*member = true;
}

void read_size(const std::string& text, RenderOptions& options) {
  if (text.empty()) return;
  int used = 0;
  const bool read =
      std::sscanf(text.c_str(), "%dx%d%n", &options.width, &options.height, &used) == 2;
  require(read && size_t(used) == text.size() && options.width > 0 && options.height > 0,
          "--size {}: write it as WIDTHxHEIGHT, for example 640x360", text);
}

void read_crop(const std::string& text, RenderOptions& options) {
  if (text.empty()) return;
  int used = 0;
  const bool read = std::sscanf(text.c_str(), "%d,%d,%d,%d%n", &options.crop_x, &options.crop_y,
                                &options.crop_width, &options.crop_height, &used) == 4;
  require(read && size_t(used) == text.size() && options.crop_width > 0 && options.crop_height > 0,
          "--crop {}: write it as X,Y,WIDTH,HEIGHT in pixels", text);
}

void read_share(const std::string& text, RenderOptions& options) {
  if (text == "auto") return;
  if (text == "learned") {
    options.share_rule = ShareRule::learned;
    return;
  }
  int used = 0;
  const bool read = std::sscanf(text.c_str(), "%f%n", &options.bsdf_share, &used) == 1;
  require(read && size_t(used) == text.size(),
          "--bsdf-share {}: write auto, learned or a number in [0.01, 1]", text);
  options.share_rule = ShareRule::fixed;
}

void read_fluence(const RenderArguments& arguments, RenderOptions& options) {
  const std::string& text = arguments.fluence;
  require(!text.empty() || !arguments.fluence_of_cache, "--fluence-of cache belongs to --fluence");
  if (text.empty()) return;
  FluenceSlice slice;
  char axis = 0;
  int used = 0;
  const bool read = std::sscanf(text.c_str(), "%c=%f%n", &axis, &slice.position, &used) == 2;
  require(read && size_t(used) == text.size() && axis >= 'x' && axis <= 'z',
          "--fluence {}: write the plane as x=NUMBER, y=NUMBER or z=NUMBER", text);
  slice.axis = axis - 'x';
  slice.of_cache = arguments.fluence_of_cache;
  options.fluence = slice;
}

void read_sphere(const std::string& text, RenderOptions& options) {
  if (text.empty()) return;
  options.sphere = parse_position(text);
  require(options.sphere.has_value(), "--sphere {}: write the point as X,Y,Z", text);
}

void add_mode(CLI::App& app, RenderMode& mode) {
  add_choice(
      app, "--mode", kModes, [&mode](size_t i) { mode = static_cast<RenderMode>(i); },
      "What directions are sampled from");
}

void add_roulette(CLI::App& app, RenderOptions& options) {
  add_choice(
      app, "--rr", kRoulettes,
      [&options](size_t i) { options.roulette = static_cast<RouletteMode>(i); },
      "Russian roulette; auto: guided where there is a cache");
  app.add_option("--weight-window", options.weight_window,
                 "Of guided roulette: how many times its upper end is its lower, 1 to 1000");
  app.add_option(
      "--split", options.split,
      "Copies that guided roulette may make of a path at a vertex, 1 to 20; 1: none; 0: 2 in "
      "mode auto, else none");
  // In the order of PixelEstimateMode.
  add_choice(
      app, "--pixel-estimate", {"cache", "preview"},
      [&options](size_t i) { options.pixel_estimate = static_cast<PixelEstimateMode>(i); },
      "What guided roulette compares paths with");
  app.add_option("--max-depth", options.max_depth, "Path edges; -1: no limit, -2: the scene's");
  app.add_option("--rr-depth", options.rr_depth,
                 "Path edges before Russian roulette; -1: the scene's");
}

void add_media(CLI::App& app, RenderOptions& options) {
  add_choice(
      app, "--distance", kDistances,
      [&options](size_t i) { options.distance = static_cast<DistanceMode>(i); },
      "In media, where along a ray to scatter; auto: guided in all modes but bsdf");
  app.add_option("--distance-bias", options.distance_bias,
                 "Factor of the extinction that half of the distances go by with --distance "
                 "exponential, up to 10");
  add_choice(
      app, "--direction", kPhases,
      [&options](size_t i) { options.direction = static_cast<PhaseMode>(i); },
      "In media, what directions are sampled from: phase function, its mixture or product with "
      "incident light; auto: product in all modes but bsdf");
}

std::string above_zero(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool good = end == text.c_str() + text.size() && value > 0 && std::isfinite(value);
  return good ? "" : fmt::format("must be a number above 0, not {}", text);
}

void add_stopping(CLI::App& app, RenderOptions& options) {
  app.add_option("--spp", options.spp, "Samples per pixel")
      ->check(CLI::Range(1, 1 << 24))
      ->default_str("");
  app.add_option("--time", options.time, "Seconds of rendering")
      ->check(above_zero)
      ->default_str("");
  add_choice(
      app, "--clock", {"wall", "cpu"}, [&options](size_t i) { options.cpu_clock = i == 1; },
      "What seconds of rendering are; cpu: processor seconds over threads, for comparing methods "
      "on a machine that has other work");
  app.add_option("--error", options.error, "Estimated relMSE to reach")
      ->check(above_zero)
      ->default_str("");
  app.add_option("--checkpoints", options.checkpoints,
                 "Seconds, separated by commas, at which the image so far and its --png and "
                 "--stats are written too, as out-2s.exr; --time is the last of them by default")
      ->type_name("SECONDS")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->default_str("");
}

void add_frame(CLI::App& app, RenderArguments& frame) {
  app.add_option("--size", frame.size, "Size of the image")->type_name("WxH");
  app.add_option("--crop", frame.crop, "Render this window only, in pixels of the whole image")
      ->type_name("X,Y,W,H");
  app.add_option("--aov", frame.aovs, "More channels, separated by commas")
      ->type_name("NAMES")
      ->delimiter(',')
      ->allow_extra_args(false);
}

void add_views(CLI::App& app, RenderArguments& arguments) {
  app.add_option("--fluence", arguments.fluence,
                 "In place of the camera's view, the fluence in media over a plane, such as y=0.5")
      ->type_name("AXIS=POSITION");
  add_choice(
      app, "--fluence-of", {"paths", "cache"},
      [&arguments](size_t i) { arguments.fluence_of_cache = i == 1; },
      "Where it comes from: path tracing, or the cells of --cache");
  app.add_option("--sphere", arguments.sphere,
                 "In place of the camera's view, the radiance that arrives at a point, as "
                 "cache-info --plot draws the sphere; --sphere=X,Y,Z where X is negative")
      ->type_name("X,Y,Z");
}

void add_sharing(CLI::App& app, RenderArguments& arguments) {
  app.add_option("--bsdf-share", arguments.bsdf_share,
                 "Share of BSDF sampling where there is a guide: 0.01 to 1, learned per cell, or "
                 "auto: learned in mode illumination, else 0.3, and 0.5 in ris")
      ->type_name("SHARE");
  app.add_option("--candidates", arguments.options.candidates, "Directions that ris chooses from");
}

}  // namespace

void declare(CLI::App& app, RenderArguments& arguments) {
  RenderOptions& options = arguments.options;
  add_scene(app, arguments.scene);
  add_ignore_media(app, arguments.scene);
  as_output(app.add_option("-o,--output", arguments.output, "Image to write (.exr)"), {".exr"})
      ->required();
  as_output(app.add_option("--png", arguments.png, "The image as sRGB picture too (.png)"),
            {".png"});
  add_mode(app, options.mode);
  add_media(app, options);
  add_roulette(app, options);
  as_input(app.add_option("--cache", arguments.cache, "Illumination cache"));
  as_input(app.add_option("--brdf", arguments.brdf, "Fitted BSDFs"));
  as_output(app.add_option("--segments", arguments.segments,
                           "Contribution by number of edges, as a table (.csv)"),
            {".csv"});
  add_stopping(app, options);
  add_frame(app, arguments);
  add_views(app, arguments);
  add_seed(app, options.seed);
  add_sharing(app, arguments);
}

RenderOptions complete_options(const RenderArguments& arguments) {
  RenderOptions options = arguments.options;
  read_size(arguments.size, options);
  read_crop(arguments.crop, options);
  read_share(arguments.bsdf_share, options);
  read_fluence(arguments, options);
  read_sphere(arguments.sphere, options);
  for (const std::string& name : arguments.aovs) add_aov(name, options.aovs);
  const bool endless = options.spp == 0 && options.time == 0 && options.error == 0;
  if (endless && !options.checkpoints.empty()) options.time = options.checkpoints.back();
  if (options.spp == 0 && options.time == 0 && options.error == 0) options.spp = kDefaultSpp;
  options.segments = !arguments.segments.empty();
  options.validate();
  return options;
}

const char* mode_name(RenderMode mode) { return kModes[static_cast<size_t>(mode)].c_str(); }

std::string method_name(const RenderOptions& options) {
  std::string name = mode_name(options.mode);
  if (options.distance != DistanceMode::automatic)
    name += ", distance " + kDistances[static_cast<size_t>(options.distance)];
  if (options.distance == DistanceMode::exponential)
    name += fmt::format(" {:g}", options.distance_bias);
  if (options.direction != PhaseMode::automatic)
    name += ", direction " + kPhases[static_cast<size_t>(options.direction)];
  if (options.roulette != RouletteMode::automatic)
    name += ", roulette " + kRoulettes[static_cast<size_t>(options.roulette)];
  if (options.fluence) name += options.fluence->of_cache ? ", fluence of cells" : ", fluence";
  if (options.sphere) name += ", sphere";
  return options.split > 1 ? name + ", split" : name;
}

}  // namespace waylight
