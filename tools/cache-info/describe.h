#pragma once
// What is in a file, as JSON: the one source of all that cache-info prints.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "formats/file_kind.h"
#include "tools/common/cli.h"

namespace waylight {

// Reads and verifies all of the file. Provenance first, then statistics.
nlohmann::ordered_json describe_content(const std::string& path, FileKind kind, const ToolRun& run);

}  // namespace waylight
