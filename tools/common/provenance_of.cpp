#include "tools/common/provenance_of.h"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace waylight {

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

ParentFile parent_of(const std::string& path) { return {file_name(path), hash_file(path)}; }

Provenance provenance_of(const ToolRun& run, const ToolInfo& tool, uint64_t seed) {
  Provenance provenance;
  provenance.tool = tool.name;
  provenance.version = version();
  provenance.command_line = run.command_line();
  provenance.seed = seed;
  return provenance;
}

Provenance provenance_of(const ToolRun& run, const ToolInfo& tool, uint64_t seed,
                         const SceneArguments& arguments, const SceneHash& scene) {
  Provenance provenance = provenance_of(run, tool, seed);
  provenance.scene_name = file_name(arguments.path);
  provenance.scene = scene;
  return provenance;
}

Provenance derived_provenance(const ToolRun& run, const ToolInfo& tool, const Provenance& source,
                              const std::string& source_path) {
  Provenance provenance = provenance_of(run, tool, source.seed);
  provenance.scene_name = source.scene_name;
  provenance.scene = source.scene;
  provenance.parents = {parent_of(source_path)};
  return provenance;
}

nlohmann::ordered_json stats_of(const Provenance& provenance) {
  return {{"tool", provenance.tool},
          {"version", provenance.version},
          {"command", provenance.command_line},
          {"scene", provenance.scene_name},
          {"seed", provenance.seed}};
}

}  // namespace waylight
