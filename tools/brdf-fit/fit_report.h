#pragma once
// What brdf-fit says of its fits: on the terminal, as JSON, and as a table over entries.

#include <nlohmann/json_fwd.hpp>

#include "libguide/brdf_fit.h"
#include "tools/common/cli.h"
#include "tools/common/csv.h"

namespace waylight {

void print_table(const ToolRun& run, const BrdfFitSummary& summary, double seconds);

// Keys "entries", "bytes", "materials", ...
nlohmann::ordered_json to_json(const BrdfFitSummary& summary);

// One row an entry, in charts' units: degrees and milliseconds.
CsvTable entry_table(const BrdfFitSummary& summary, const BrdfFitOptions& options);

}  // namespace waylight
