#include "tools/render/render_tool.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "formats/atomic_file.h"
#include "formats/brdf_file.h"
#include "formats/cache_file.h"
#include "formats/image_io.h"
#include "libguide/base/error.h"
#include "libguide/render_plan.h"
#include "tools/common/provenance_of.h"
#include "tools/render/render_arguments.h"
#include "tools/render/segment_table.h"

namespace waylight {
namespace {

// The caches that the mode asks for, checked against the scene, and noted as parents of the image.
// Others are not even opened, and of the illumination cache, which is mapped, only what paths look
// at is read. Mode auto asks for the fits when it knows that it may use them.
class LoadedCaches {
 public:
  // All must outlive this.
  LoadedCaches(const RenderArguments& arguments, const RenderOptions& options, Provenance& image)
      : path_of_fits_(arguments.brdf), image_(image) {
    const RenderMode mode = options.mode;
    const bool automatic = mode == RenderMode::automatic;
    require(!needs_cache(options) || !arguments.cache.empty(), "--mode {} needs --cache",
            method_name(options));
    if (!(needs_cache(options) || automatic) || arguments.cache.empty()) return;
    guide_.emplace(arguments.cache);
    require_same_scene(arguments.cache, guide_->provenance(), image.scene_name, image.scene,
                       SceneParts::all);
    if (guide_->view().quantity != Quantity::radiance)
      fail(
          "\"{}\": is an importance cache, which guides photons (photon-trace --importance); "
          "render needs one trained on photons",
          arguments.cache);
    if (!automatic && guide_->view().cells.empty() && guide_->view().medium.cells.empty())
      fail("\"{}\": has no cells; train it on photons of the scene", arguments.cache);
    image.parents.push_back(parent_of(arguments.cache));
    require(!needs_fits(mode) || !arguments.brdf.empty(), "--mode {} needs --brdf",
            mode_name(mode));
    if (needs_fits(mode))
      fits_ = [fits = load_fits()] { return fits; };
    else if (automatic && !arguments.brdf.empty())
      fits_ = [this] { return load_fits(); };
  }

  RenderCaches caches() const { return {fits_, guide_ ? guide_->view() : GuideCacheView()}; }

 private:
  std::shared_ptr<const BrdfCache> load_fits() const {
    BrdfFile file = read_brdf(path_of_fits_);
    require_same_scene(path_of_fits_, file.provenance, image_.scene_name, image_.scene,
                       SceneParts::materials);
    image_.parents.push_back(parent_of(path_of_fits_));
    return std::make_shared<const BrdfCache>(std::move(file.cache));
  }

  const std::string& path_of_fits_;
  Provenance& image_;
  std::optional<MappedCache> guide_;
  BrdfSource fits_;
};

std::map<std::string, std::string> exr_attributes(const Provenance& p) {
  std::map<std::string, std::string> attributes = {
      {"waylight.tool", p.tool},
      {"waylight.version", p.version},
      {"waylight.command", p.command_line},
      {"waylight.seed", std::to_string(p.seed)},
      {"waylight.scene", p.scene_name},
      {"waylight.scene_hash",
       fmt::format("geometry {:016x} materials {:016x} emitters {:016x} media {:016x}",
                   p.scene.geometry, p.scene.materials, p.scene.emitters, p.scene.media)}};
  for (size_t i = 0; i < p.parents.size(); ++i)
    attributes[fmt::format("waylight.parent{}", i + 1)] =
        fmt::format("{} {:016x}", p.parents[i].name, p.parents[i].hash);
  return attributes;
}

std::string checkpoint_tag(double seconds) { return fmt::format("{:g}s", seconds); }

void report(const ToolRun& run, const RenderSummary& s) {
  run.print(fmt::format("{} x {} pixels, {:.1f} samples per pixel in {:.1f} s, {} rays/s", s.width,
                        s.height, s.mean_spp, s.seconds,
                        format_count(double(s.rays) / std::max(s.seconds, 1e-9))));
  const std::string error = std::isnan(s.estimated_relmse)
                                ? "unknown below two samples"
                                : fmt::format("{:.4g}", s.estimated_relmse);
  run.print(
      fmt::format("estimated relMSE {}; {:.2f} edges per path; {:.0f} % of scatterings guided",
                  error, s.mean_path_length, 100 * s.guiding_share));
}

// Variance times cost of each way over that of everything guided.
void report(const ToolRun& run, const AutoDecision& decision) {
  const std::string fits = decision.fits.empty() ? "" : "; fits " + decision.fits;
  run.print(fmt::format("auto: {}; cells by bsdf {}, illumination {}, product {}{}; pilot {:.2f} s",
                        decision.method, decision.cells_bsdf, decision.cells_illumination,
                        decision.cells_product, fits, decision.seconds));
  for (const MethodFigures& m : decision.compared)
    run.print(fmt::format("  {:<26} variance x cost {:.3f} +- {:.3f}", m.name,
                          m.inefficiency() / decision.compared[0].inefficiency(), m.uncertainty));
}

nlohmann::ordered_json json_of(const AutoDecision& decision) {
  nlohmann::ordered_json compared = nlohmann::ordered_json::array();
  for (const MethodFigures& m : decision.compared)
    compared.push_back({{"method", m.name},
                        {"variance", m.variance},
                        {"cost", m.cost},
                        {"uncertainty", m.uncertainty}});
  return {{"method", decision.method},
          {"cells_bsdf", decision.cells_bsdf},
          {"cells_illumination", decision.cells_illumination},
          {"cells_product", decision.cells_product},
          {"fits", decision.fits},
          {"pilot_seconds", decision.seconds},
          {"compared", compared}};
}

void write_stats(const ToolRun& run, const Provenance& provenance, const RenderOptions& options,
                 const RenderSummary& s, const std::string& tag = {}) {
  nlohmann::ordered_json stats = stats_of(provenance);
  stats.update({{"mode", mode_name(options.mode)},
                {"clock", options.cpu_clock ? "cpu" : "wall"},
                {"seconds", s.seconds},
                {"cpu_seconds", s.cpu_seconds},
                {"spp", s.mean_spp},
                {"width", s.width},
                {"height", s.height},
                {"preview_seconds", s.preview_seconds},
                {"rays", s.rays},
                {"mean_path_length", s.mean_path_length},
                {"killed_share", s.killed_share},
                {"copies_per_path", s.copies_per_path},
                {"bsdf_share", s.bsdf_share},
                {"guiding_share", s.guiding_share},
                {"estimated_relmse", s.estimated_relmse},
                {"invalid_samples", s.invalid_samples},
                {"interrupted", s.interrupted},
                {"peak_memory_bytes", peak_memory_bytes()}});
  if (options.mode == RenderMode::automatic) stats["auto"] = json_of(s.decision);
  run.write_stats(stats, tag);
}

// Checked against all that the render writes, with the images at checkpoints.
SceneDescription load_scene_of(const RenderArguments& arguments, const RenderOptions& options,
                               const ToolRun& run) {
  SceneArguments scene = arguments.scene;
  for (const double checkpoint : options.checkpoints)
    for (const std::string& output : {arguments.output, arguments.png})
      if (!output.empty()) scene.written.push_back(tagged(output, checkpoint_tag(checkpoint)));
  return load_scene(scene, run);
}

// A scene without surfaces has an environment that lights nothing, but is seen.
std::unique_ptr<Scene> build_lit_scene(SceneDescription description, const RenderOptions& options,
                                       const SceneArguments& arguments, const ToolRun& run) {
  std::unique_ptr<Scene> scene = build_scene(std::move(description), arguments, run);
  const bool sees_light =
      scene->has_environment() && !tracer_options(*scene, options).hide_emitters;
  if (!scene->has_lights() && !sees_light)
    run.control.warn(fmt::format(
        "\"{}\": no emitter sends light into the scene; the image will be black", arguments.path));
  return scene;
}

}  // namespace

void render(const ToolRun& run, const ToolInfo& tool, const RenderArguments& arguments) {
  const RenderOptions options = complete_options(arguments);
  if (!arguments.segments.empty()) check_writable(arguments.segments);
  SceneDescription description = load_scene_of(arguments, options, run);
  Provenance provenance = provenance_of(run, tool, options.seed, arguments.scene, description.hash);
  const LoadedCaches loaded(arguments, options, provenance);
  const std::unique_ptr<Scene> scene =
      build_lit_scene(std::move(description), options, arguments.scene, run);
  RenderSummary summary;
  // Pictures of the fluence show the mean radiance.
  const float exposure = options.fluence ? -std::log2(4 * kPi) : 0.0f;
  const auto write_images = [&](const Image& image, const std::string& tag) {
    write_exr(tagged(arguments.output, tag), image, exr_attributes(provenance));
    if (!arguments.png.empty()) write_png(tagged(arguments.png, tag), image, exposure);
  };
  const Image image =
      render(*scene, loaded.caches(), options, &summary, run.control,
             [&](double checkpoint, const Image& so_far, const RenderSummary& figures) {
               const std::string tag = checkpoint_tag(checkpoint);
               write_images(so_far, tag);
               write_stats(run, provenance, options, figures, tag);
             });
  if (summary.mean_spp < 1) run.stop_if_interrupted();  // a part of the pixels is no image
  write_images(image, "");
  if (!arguments.segments.empty())
    write_segment_table(arguments.segments, file_name(arguments.scene.path), method_name(options),
                        summary.segments);
  report(run, summary);
  if (options.mode == RenderMode::automatic) report(run, summary.decision);
  write_stats(run, provenance, options, summary);
}

}  // namespace waylight
