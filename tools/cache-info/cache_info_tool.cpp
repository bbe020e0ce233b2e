#include "tools/cache-info/cache_info_tool.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "formats/file_kind.h"
#include "libguide/base/error.h"
#include "tools/cache-info/describe.h"
#include "tools/cache-info/medium_plot.h"
#include "tools/cache-info/text_report.h"
#include "tools/common/position.h"
#include "tools/common/provenance_of.h"

namespace waylight {
namespace {

void validate(const CacheInfoArguments& arguments, FileKind kind) {
  const LobePlotArguments& plot = arguments.plot;
  require(plot.target.empty() == plot.output.empty(),
          "--plot CELL|X,Y,Z|MATERIAL and -o PICTURE belong together");
  require(plot.samples.empty() || kind == FileKind::cache,
          "--samples belongs to the --plot of an illumination cache");
  require(!plot.elevation || kind == FileKind::brdf,
          "--elevation belongs to the --plot of a BRDF cache");
  require(!plot.elevation || (*plot.elevation >= 0 && *plot.elevation <= 90),
          "--elevation must be a number from 0 to 90, not {}", plot.elevation.value_or(0));
  require(plot.truth.empty() || parse_position(plot.target),
          "--truth belongs to the --plot of a place in a medium, X,Y,Z");
  require(plot.scene.path.empty() || kind == FileKind::brdf,
          "--scene belongs to the --plot of a BRDF cache");
  require(plot.target.empty() || kind == FileKind::cache || kind == FileKind::brdf,
          "--plot draws lobes of caches, and \"{}\" is {}", arguments.file, describe(kind));
  if (kind == FileKind::unknown && std::filesystem::is_empty(arguments.file))
    fail("\"{}\": is empty", arguments.file);
  if (kind == FileKind::unknown)
    fail("\"{}\": is {} (fitted BSDFs, photons, an illumination cache or an EXR image)",
         arguments.file, describe(kind));
}

// Reading has verified everything already; what remains is what a reader may let pass.
void require_sound(const std::string& path, const nlohmann::ordered_json& info) {
  if (const auto found = info.find("not_finite"); found != info.end() && *found != 0)
    fail("\"{}\": {} numbers are not finite", path, found->get<uint64_t>());
}

void plot(const ToolRun& run, const CacheInfoArguments& arguments, FileKind kind) {
  if (kind == FileKind::brdf) return plot_material(run, arguments.file, arguments.plot);
  if (const std::optional<Vec3> position = parse_position(arguments.plot.target))
    return plot_medium(run, arguments.file, *position, arguments.plot);
  plot_cell(run, arguments.file, arguments.plot);
}

}  // namespace

void cache_info(const ToolRun& run, const CacheInfoArguments& arguments) {
  const FileKind kind = identify_file(arguments.file);
  validate(arguments, kind);
  nlohmann::ordered_json info = describe_content(arguments.file, kind, run);
  if (arguments.check) {
    require_sound(arguments.file, info);
    info["sound"] = true;
  }
  run.write_stats(info);
  if (!arguments.plot.target.empty())
    plot(run, arguments, kind);
  else if (arguments.json)
    run.print(json_text(info));
  else if (arguments.check)
    run.print(fmt::format("\"{}\" is sound: {}", file_name(arguments.file), describe(kind)));
  else
    for (const std::string& line : text_report(info)) run.print(line);
}

}  // namespace waylight
