#pragma once
// Provenance of what a tool is about to write.

#include "formats/provenance.h"
#include "tools/common/cli.h"
#include "tools/common/scene_arguments.h"

namespace waylight {

Provenance provenance_of(const ToolRun& run, const ToolInfo& tool, uint64_t seed);
// With the scene behind it.
Provenance provenance_of(const ToolRun& run, const ToolInfo& tool, uint64_t seed,
                         const SceneArguments& arguments, const SceneHash& scene);
// With the scene and seed of the file that it was made from, which becomes its parent.
Provenance derived_provenance(const ToolRun& run, const ToolInfo& tool, const Provenance& source,
                              const std::string& source_path);

ParentFile parent_of(const std::string& path);
std::string file_name(const std::string& path);  // without folders

// "tool", "version", "command", "scene": how every --stats file begins.
nlohmann::ordered_json stats_of(const Provenance& provenance);

}  // namespace waylight
