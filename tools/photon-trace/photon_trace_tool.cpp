#include "tools/photon-trace/photon_trace_tool.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "formats/photon_file.h"
#include "libguide/base/error.h"
#include "tools/common/provenance_of.h"

namespace waylight {
namespace {

void report(const ToolRun& run, const Provenance& provenance, const PhotonTraceSummary& s) {
  const double emitted = static_cast<double>(s.emitted);
  run.print(fmt::format("{} photons of {} particles in {:.1f} s ({}/s)",
                        format_count(double(s.stored)), format_count(emitted), s.seconds,
                        format_count(emitted / std::max(s.seconds, 1e-9))));
  run.print(fmt::format("particles: {:.1f} % absorbed, {:.1f} % left the scene, {:.2f} % too deep",
                        100 * s.absorbed / emitted, 100 * s.left_scene / emitted,
                        100 * s.too_deep / emitted));
  if (s.invalid > 0) run.control.warn(fmt::format("{} invalid photons were dropped", s.invalid));
  if (s.stored == 0)
    run.control.warn("no particle hit a surface that stores photons: a cache cannot be trained");
  nlohmann::ordered_json stats = stats_of(provenance);
  stats.update({{"seconds", s.seconds},
                {"emitted", s.emitted},
                {"stored", s.stored},
                {"absorbed", s.absorbed},
                {"left_scene", s.left_scene},
                {"too_deep", s.too_deep},
                {"invalid", s.invalid},
                {"peak_memory_bytes", peak_memory_bytes()}});
  run.write_stats(stats);
}

}  // namespace

void photon_trace(const ToolRun& run, const ToolInfo& tool, const PhotonTraceArguments& arguments) {
  const PhotonTraceOptions& options = arguments.options;
  options.validate();
  const std::unique_ptr<Scene> built =
      build_scene(load_scene(arguments.scene, run), arguments.scene, run);
  const Scene& scene = *built;
  if (!scene.has_lights())
    fail("\"{}\": no emitter sends light into the scene, so there are no photons to trace",
         arguments.scene.path);
  const Provenance provenance =
      provenance_of(run, tool, options.seed, arguments.scene, scene.description().hash);
  PhotonWriter writer(arguments.output,
                      {provenance, {scene.bounds(), options.count, options.pass}});
  const PhotonTraceSummary summary = trace_photons(
      scene, options, [&](std::span<const Photon> photons) { writer.write(photons); }, run.control);
  run.stop_if_interrupted();
  writer.finish(summary);
  report(run, provenance, summary);
}

}  // namespace waylight
