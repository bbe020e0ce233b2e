#include "tools/brdf-fit/brdf_fit_tool.h"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "formats/brdf_file.h"
#include "tools/common/provenance_of.h"

namespace waylight {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const MaterialFitSummary& m) {
  return {{"name", m.name},
          {"kind", m.kind},
          {"textured", m.textured},
          {"entries", m.entries},
          {"mean_components", m.mean_components},
          {"held_out_error", m.held_out_error},
          {"seconds", m.seconds},
          {"bytes", m.bytes}};
}

void print_table(const ToolRun& run, const BrdfFitSummary& summary) {
  run.print(fmt::format("{:28} {:16} {:>7} {:>5} {:>8} {:>8} {:>8}", "material", "kind", "entries",
                        "comp.", "error", "CPU ms", "size"));
  for (const MaterialFitSummary& m : summary.materials)
    run.print(fmt::format("{:28} {:16} {:>7} {:>5.1f} {:>8.3f} {:>8.1f} {:>8}{}", m.name, m.kind,
                          m.entries, m.mean_components, m.held_out_error, 1000 * m.seconds,
                          format_bytes(double(m.bytes)),
                          m.textured ? "  mean of its textures" : ""));
  for (const std::string& name : summary.skipped) run.print("not fitted: " + name);
}

void report(const ToolRun& run, const Provenance& provenance, const BrdfFitSummary& summary,
            double seconds) {
  print_table(run, summary);
  size_t entries = 0, bytes = 0;
  Json materials = Json::array();
  for (const MaterialFitSummary& m : summary.materials) {
    entries += m.entries;
    bytes += m.bytes;
    materials.push_back(to_json(m));
  }
  run.print(fmt::format("{} materials, {} entries, {} in {:.2f} s", summary.materials.size(),
                        entries, format_bytes(double(bytes)), seconds));
  Json stats = stats_of(provenance);
  stats.update({{"seconds", seconds}, {"entries", entries}, {"bytes", bytes}});
  stats["materials"] = materials;
  stats["skipped"] = summary.skipped;
  run.write_stats(stats);
}

}  // namespace

void brdf_fit(const ToolRun& run, const ToolInfo& tool, const BrdfFitArguments& arguments) {
  arguments.options.validate();
  const SceneDescription scene = load_scene(arguments.scene, run);
  const auto start = std::chrono::steady_clock::now();
  BrdfFitResult result = fit_brdfs(scene, arguments.options, run.control);
  run.stop_if_interrupted();
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Provenance provenance =
      provenance_of(run, tool, arguments.options.seed, arguments.scene, scene.hash);
  write_brdf(arguments.output, {provenance, std::move(result.cache)});
  report(run, provenance, result.summary, seconds);
}

}  // namespace waylight
