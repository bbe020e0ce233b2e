#include "tools/make-cloud/make_cloud_tool.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "formats/volume_io.h"
#include "libguide/base/stopwatch.h"
#include "tools/common/provenance_of.h"

namespace waylight {
namespace {

struct CloudSummary {
  double filled = 0, mean = 0;  // share of the voxels that hold something, and their density
};

CloudSummary summarise(const VolumeGrid& grid) {
  const VoxelBox all{Eigen::Vector3i::Zero(), grid.size() - Eigen::Vector3i::Ones()};
  double sum = 0, filled = 0;
  grid.voxels.visit(all, [&](const float* value, int64_t count) {
    sum += double(count) * *value;
    if (*value > 0) filled += double(count);
  });
  return {filled / double(all.count()), filled > 0 ? sum / filled : 0};
}

void report(const ToolRun& run, const Provenance& provenance, const std::string& output,
            const VolumeGrid& grid, double seconds) {
  const CloudSummary summary = summarise(grid);
  const auto bytes = std::filesystem::file_size(output);
  run.print(fmt::format("{} x {} x {} voxels, {:.1f} % filled with a mean density of {:.3f}",
                        grid.size().x(), grid.size().y(), grid.size().z(), 100 * summary.filled,
                        summary.mean));
  run.print(fmt::format("{} in {:.2f} s", format_bytes(double(bytes)), seconds));
  nlohmann::ordered_json stats = stats_of(provenance);
  stats.update({{"seconds", seconds},
                {"width", grid.size().x()},
                {"height", grid.size().y()},
                {"depth", grid.size().z()},
                {"filled", summary.filled},
                {"mean_density", summary.mean},
                {"bytes", bytes}});
  run.write_stats(stats);
}

std::map<std::string, std::string> metadata_of(const Provenance& provenance) {
  return {{"waylight.tool", provenance.tool},
          {"waylight.version", provenance.version},
          {"waylight.command", provenance.command_line}};
}

}  // namespace

void make_cloud(const ToolRun& run, const ToolInfo& tool, const MakeCloudArguments& arguments) {
  const Stopwatch stopwatch;
  const Provenance provenance = provenance_of(run, tool, arguments.options.seed);
  const VolumeGrid grid = make_cloud(arguments.options);
  write_vdb(arguments.output, grid, "density", metadata_of(provenance));
  const double seconds = stopwatch.seconds();
  report(run, provenance, arguments.output, grid, seconds);
}

}  // namespace waylight
