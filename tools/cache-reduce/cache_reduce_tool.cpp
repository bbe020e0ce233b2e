#include "tools/cache-reduce/cache_reduce_tool.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "formats/brdf_file.h"
#include "formats/cache_file.h"
#include "formats/file_kind.h"
#include "libguide/base/error.h"
#include "libguide/base/stopwatch.h"
#include "tools/common/provenance_of.h"

namespace waylight {
namespace {

nlohmann::ordered_json stats_of(const MixtureReduction& s) {
  return {{"mixtures", s.mixtures},
          {"components_before", s.components_before},
          {"components_after", s.components_after},
          {"mean_cost", s.mean_cost}};
}

void print(const ToolRun& run, const char* what, const MixtureReduction& s) {
  run.print(
      fmt::format("{}{} mixtures: {:.2f} -> {:.2f} components at {:.1f} % of the collapse cost",
                  what, s.mixtures, s.components_before, s.components_after, s.mean_cost));
}

void report(const ToolRun& run, const Provenance& provenance, const CacheReduceArguments& arguments,
            const CacheReduceSummary& s, double seconds) {
  const auto before = std::filesystem::file_size(arguments.input);
  const auto after = std::filesystem::file_size(arguments.output);
  print(run, "", s);
  if (s.media.mixtures > 0) print(run, "media: ", s.media);
  run.print(fmt::format("{} -> {} in {:.2f} s", format_bytes(double(before)),
                        format_bytes(double(after)), seconds));
  nlohmann::ordered_json stats = stats_of(provenance);
  stats["seconds"] = seconds;
  stats.update(stats_of(static_cast<const MixtureReduction&>(s)));
  const size_t mixtures = std::max<size_t>(s.mixtures + s.media.mixtures, 1);
  stats.update({{"bytes_before", before},
                {"bytes_after", after},
                {"bytes_per_mixture", double(after) / double(mixtures)}});
  if (s.media.mixtures > 0) stats["media"] = stats_of(s.media);
  run.write_stats(stats);
}

// Both kinds of file: read, reduce, write with the source as parent.
template <typename File>
Provenance reduce_file(const ToolRun& run, const ToolInfo& tool,
                       const CacheReduceArguments& arguments, File file,
                       void (*write)(const std::string&, const File&),
                       CacheReduceSummary* summary) {
  file.provenance = derived_provenance(run, tool, file.provenance, arguments.input);
  file.cache = reduce(std::move(file.cache), arguments.options, summary);
  write(arguments.output, file);
  return file.provenance;
}

}  // namespace

void cache_reduce(const ToolRun& run, const ToolInfo& tool, const CacheReduceArguments& arguments) {
  arguments.options.validate();
  const Stopwatch stopwatch;
  CacheReduceSummary summary;
  Provenance provenance;
  switch (identify_file(arguments.input)) {
    case FileKind::brdf:
      provenance =
          reduce_file(run, tool, arguments, read_brdf(arguments.input), write_brdf, &summary);
      break;
    case FileKind::cache:
      provenance =
          reduce_file(run, tool, arguments, read_cache(arguments.input), write_cache, &summary);
      break;
    default:
      fail("\"{}\": holds no mixtures; give a .brdf or a .cache file", arguments.input);
  }
  const double seconds = stopwatch.seconds();
  report(run, provenance, arguments, summary, seconds);
}

}  // namespace waylight
