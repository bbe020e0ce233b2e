#include "tools/brdf-fit/brdf_fit_tool.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "formats/atomic_file.h"
#include "formats/brdf_file.h"
#include "libguide/base/error.h"
#include "libguide/base/stopwatch.h"
#include "tools/brdf-fit/fit_report.h"
#include "tools/common/provenance_of.h"

namespace waylight {
namespace {

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
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
}

void brdf_fit(const ToolRun& run, const ToolInfo& tool, const BrdfFitArguments& arguments) {
  validate(arguments);
  const SceneDescription scene =
      arguments.family.empty() ? load_scene(arguments.scene, run) : SceneDescription();
  const std::vector<BrdfCache> families = read_families(arguments.families);
  const Stopwatch stopwatch;
  BrdfFitResult result = arguments.family.empty()
                             ? fit_brdfs(scene, arguments.options, run.control, families)
                             : fit_family(arguments.family, arguments.options, run.control);
  run.stop_if_interrupted();
  const double seconds = stopwatch.seconds();
  const Provenance provenance = provenance_of(run, tool, arguments, scene.hash);
  write_brdf(arguments.output, {provenance, std::move(result.cache)});
  if (!arguments.report.empty())
    write_text_atomically(arguments.report,
                          to_text(entry_table(result.summary, arguments.options)));
  print_table(run, result.summary, seconds);
  nlohmann::ordered_json stats = stats_of(provenance);
  stats["seconds"] = seconds;
  stats.update(to_json(result.summary));
  run.write_stats(stats);
}

}  // namespace waylight
