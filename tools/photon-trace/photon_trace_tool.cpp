#include "tools/photon-trace/photon_trace_tool.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "formats/cache_file.h"
#include "formats/photon_file.h"
#include "libguide/base/error.h"
#include "tools/common/provenance_of.h"

namespace waylight {
namespace {

void report_particles(const ToolRun& run, Quantity quantity, const PhotonTraceSummary& s) {
  const double emitted = static_cast<double>(s.emitted);
  run.print(fmt::format("{} {} of {} particles in {:.1f} s ({}/s)", format_count(double(s.stored)),
                        quantity == Quantity::radiance ? "photons" : "importons",
                        format_count(emitted), s.seconds,
                        format_count(emitted / std::max(s.seconds, 1e-9))));
  run.print(fmt::format("particles: {:.1f} % absorbed, {:.1f} % left the scene, {:.2f} % too deep",
                        100 * s.absorbed / emitted, 100 * s.left_scene / emitted,
                        100 * s.too_deep / emitted));
}

void report(const ToolRun& run, const Provenance& provenance, Quantity quantity,
            const PhotonTraceSummary& s) {
  if (s.emitted > 0) report_particles(run, quantity, s);
  if (s.paths > 0)
    run.print(fmt::format("{} samples of {} camera paths in {:.1f} s{}",
                          format_count(double(s.samples)), format_count(double(s.paths)), s.seconds,
                          s.emitted > 0 ? ", photons included" : ""));
  if (s.invalid > 0) run.control.warn(fmt::format("{} invalid photons were dropped", s.invalid));
  if (s.in_media > 0)
    run.print(fmt::format("{} photons in media", format_count(double(s.in_media))));
  if (s.stored + s.in_media + s.samples == 0)
    run.control.warn("no particle hit a surface that stores photons: a cache cannot be trained");
  nlohmann::ordered_json stats = stats_of(provenance);
  stats.update({{"seconds", s.seconds},
                {"quantity", quantity_name(quantity)},
                {"emitted", s.emitted},
                {"stored", s.stored},
                {"escapes", s.escapes},
                {"in_media", s.in_media},
                {"paths", s.paths},
                {"samples", s.samples},
                {"absorbed", s.absorbed},
                {"left_scene", s.left_scene},
                {"too_deep", s.too_deep},
                {"invalid", s.invalid},
                {"peak_memory_bytes", peak_memory_bytes()}});
  run.write_stats(stats);
}

// A cache of this scene that guides; empty where none was given. wanted: what the option needs.
std::optional<MappedCache> open_guide(const std::string& path, Quantity quantity,
                                      const char* wanted, const PhotonTraceArguments& arguments,
                                      const SceneDescription& scene) {
  if (path.empty()) return std::nullopt;
  MappedCache cache(path);
  require_same_scene(path, cache.provenance(), file_name(arguments.scene.path), scene.hash,
                     SceneParts::all);
  if (cache.view().quantity != quantity)
    fail("\"{}\": holds {}; {}", path, quantity_name(cache.view().quantity), wanted);
  return cache;
}

struct Guides {
  std::optional<MappedCache> importance, radiance;

  Guides(const PhotonTraceArguments& a, const SceneDescription& scene)
      : importance(open_guide(a.importance, Quantity::importance,
                              "--importance needs a cache trained on `photon-trace --from camera`",
                              a, scene)),
        radiance(open_guide(a.cache, Quantity::radiance,
                            "--cache needs one trained on photons or `photon-trace --paths`", a,
                            scene)) {}

  TraceGuides views() const {
    return {importance ? importance->view() : GuideCacheView(),
            radiance ? radiance->view() : GuideCacheView()};
  }
};

Provenance provenance_of_photons(const ToolRun& run, const ToolInfo& tool,
                                 const PhotonTraceArguments& arguments, const SceneHash& scene) {
  Provenance provenance = provenance_of(run, tool, arguments.options.seed, arguments.scene, scene);
  for (const std::string& guide : {arguments.importance, arguments.cache})
    if (!guide.empty()) provenance.parents.push_back(parent_of(guide));
  return provenance;
}

PhotonStreamInfo stream_of(const Scene& scene, const PhotonTraceOptions& options,
                           const TraceGuides& guides) {
  const bool media =
      scene.has_media() && options.quantity == Quantity::radiance && options.count > 0;
  return {scene.bounds(),
          options.count,
          options.pass,
          options.quantity,
          media,
          options.paths,
          expected_records(scene, options, guides)};
}

}  // namespace

void photon_trace(const ToolRun& run, const ToolInfo& tool, const PhotonTraceArguments& arguments) {
  const PhotonTraceOptions& options = arguments.options;
  options.validate();
  require(arguments.cache.empty() || options.paths > 0,
          "--cache guides camera paths: it needs --paths");
  const std::unique_ptr<Scene> built =
      build_scene(load_scene(arguments.scene, run), arguments.scene, run);
  const Scene& scene = *built;
  if (options.quantity == Quantity::radiance && !scene.has_lights())
    run.control.warn(
        fmt::format("\"{}\": no emitter sends light into the scene: there are no photons to trace",
                    arguments.scene.path));
  const Guides guides(arguments, scene.description());
  const Provenance provenance =
      provenance_of_photons(run, tool, arguments, scene.description().hash);
  PhotonWriter writer(arguments.output, {provenance, stream_of(scene, options, guides.views())});
  const PhotonTraceSummary summary = trace_photons(
      scene, options, [&](std::span<const Photon> photons) { writer.write(photons); }, run.control,
      [&](std::span<const Escape> escapes) { writer.write(escapes); }, guides.views(),
      [&](std::span<const MediumPhoton> photons) { writer.write(photons); });
  run.stop_if_interrupted();
  writer.finish(summary);
  report(run, provenance, options.quantity, summary);
}

}  // namespace waylight
