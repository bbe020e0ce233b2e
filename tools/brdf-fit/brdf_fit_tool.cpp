#include "tools/brdf-fit/brdf_fit_tool.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <nlohmann/json.hpp>

#include "formats/brdf_file.h"
#include "libguide/base/error.h"
#include "tools/common/provenance_of.h"

namespace waylight {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const MaterialFitSummary& m) {
  return {{"name", m.name},
          {"kind", m.kind},
          {"textured", m.textured},
          {"widths", m.widths},
          {"entries", m.entries},
          {"mean_components", m.mean_components},
          {"held_out_error", m.held_out_error},
          {"seconds", m.seconds},
          {"bytes", m.bytes},
          {"from_family", m.from_family},
          {"shares_with", m.shares_with}};
}

std::string remark(const MaterialFitSummary& m) {
  if (!m.shares_with.empty()) return fmt::format("  as {}", m.shares_with);
  if (m.widths > 0)
    return fmt::format("  {} widths", m.widths) + (m.from_family ? " of its family" : "");
  if (m.from_family) return "  of its family";
  return m.textured ? "  mean of its textures" : "";
}

void print_table(const ToolRun& run, const BrdfFitSummary& summary) {
  run.print(fmt::format("{:28} {:16} {:>7} {:>5} {:>8} {:>8} {:>8}", "material", "kind", "entries",
                        "comp.", "error", "CPU ms", "size"));
  for (const MaterialFitSummary& m : summary.materials)
    run.print(fmt::format("{:28} {:16} {:>7} {:>5.1f} {:>8.3f} {:>8.1f} {:>8}{}", m.name, m.kind,
                          m.entries, m.mean_components, m.held_out_error, 1000 * m.seconds,
                          format_bytes(double(m.bytes)), remark(m)));
  for (const std::string& name : summary.skipped) run.print("not fitted: " + name);
}

Json to_json(const FitCost& cost) {
  return {{"entries", cost.entries}, {"bytes", cost.bytes}, {"seconds", cost.seconds}};
}

void print_totals(const ToolRun& run, const BrdfFitSummary& summary, double seconds) {
  run.print(fmt::format("{} materials, {} entries, {} in {:.2f} s", summary.materials.size(),
                        summary.cost.entries, format_bytes(double(summary.cost.bytes)), seconds));
  if (summary.full.entries == summary.cost.entries) return;
  run.print(
      fmt::format("unshared and at full resolution: {} entries, {}, {:.1f} times the CPU time",
                  summary.full.entries, format_bytes(double(summary.full.bytes)),
                  summary.full.seconds / std::max(summary.cost.seconds, 1e-9)));
}

void report(const ToolRun& run, const Provenance& provenance, const BrdfFitSummary& summary,
            double seconds) {
  print_table(run, summary);
  print_totals(run, summary, seconds);
  Json materials = Json::array();
  for (const MaterialFitSummary& m : summary.materials) materials.push_back(to_json(m));
  Json stats = stats_of(provenance);
  stats.update({{"seconds", seconds},
                {"entries", summary.cost.entries},
                {"bytes", summary.cost.bytes},
                {"full", to_json(summary.full)}});
  stats["materials"] = materials;
  stats["skipped"] = summary.skipped;
  run.write_stats(stats);
}

void validate(const BrdfFitArguments& arguments) {
  const bool scene = !arguments.scene.path.empty(), family = !arguments.family.empty();
  require(scene || family, "give a SCENE, or a --family to fit");
  require(!scene || !family, "--family {}: needs no SCENE; give one or the other",
          arguments.family);
  require(scene || arguments.families.empty(), "--family-file serves a SCENE; give one");
  arguments.options.validate();
}

std::vector<BrdfCache> read_families(const std::vector<std::string>& paths) {
  std::vector<BrdfCache> families;
  for (const std::string& path : paths) {
    families.push_back(read_brdf(path).cache);
    const std::vector<MaterialFit>& fits = families.back().materials;
    if (std::all_of(fits.begin(), fits.end(), [](const auto& f) { return f.widths.empty(); }))
      fail("\"{}\": holds no family of widths; make one with --family", path);
  }
  return families;
}

Provenance provenance_of(const ToolRun& run, const ToolInfo& tool,
                         const BrdfFitArguments& arguments, const SceneHash& scene) {
  const uint64_t seed = arguments.options.seed;
  if (!arguments.family.empty()) return provenance_of(run, tool, seed);
  Provenance provenance = provenance_of(run, tool, seed, arguments.scene, scene);
  for (const std::string& path : arguments.families) provenance.parents.push_back(parent_of(path));
  return provenance;
}

}  // namespace

void add_family(CLI::App& app, BrdfFitArguments& arguments) {
  app.get_option("SCENE")->required(false);
  app.add_option("--family", arguments.family, "Fit this family of lobes instead of a scene")
      ->type_name("NAME");
  as_input(
      app.add_option("--family-file", arguments.families, "Family to take fits from; repeatable"))
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void brdf_fit(const ToolRun& run, const ToolInfo& tool, const BrdfFitArguments& arguments) {
  validate(arguments);
  const SceneDescription scene =
      arguments.family.empty() ? load_scene(arguments.scene, run) : SceneDescription();
  const std::vector<BrdfCache> families = read_families(arguments.families);
  const auto start = std::chrono::steady_clock::now();
  BrdfFitResult result = arguments.family.empty()
                             ? fit_brdfs(scene, arguments.options, run.control, families)
                             : fit_family(arguments.family, arguments.options, run.control);
  run.stop_if_interrupted();
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Provenance provenance = provenance_of(run, tool, arguments, scene.hash);
  write_brdf(arguments.output, {provenance, std::move(result.cache)});
  report(run, provenance, result.summary, seconds);
}

}  // namespace waylight
