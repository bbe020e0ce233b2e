#pragma once
// Pictures of a scene side by side, as HTML.

#include "tools/report/pictures.h"
#include "tools/report/report_tool.h"

namespace waylight {

// Reference and methods in columns: picture, enlarged crop, error. `id` tells galleries apart.
std::string gallery(const SceneRuns& scene, const Pictures& pictures, const std::string& id,
                    const ReportOptions& options);

// What made the pictures: commands of render and of the stages before it, and hashes.
std::string provenance(const SceneRuns& scene, const Pictures& pictures);

}  // namespace waylight
