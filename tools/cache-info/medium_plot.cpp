#include "tools/cache-info/medium_plot.h"

#include <fmt/format.h>

#include <charconv>

#include "formats/cache_file.h"
#include "formats/photon_file.h"
#include "libguide/base/error.h"
#include "libguide/directional/vmf_mixture.h"
#include "tools/cache-info/disk_picture.h"
#include "tools/common/provenance_of.h"

namespace waylight {
namespace {

// A mixture's light and its photons, on one scale.
struct LightPictures {
  DiskPicture mixture, photons;
};

LightPictures pictures_of(std::span<const VmfComponent> lobes, int size) {
  const VmfMixture mixture(lobes);
  LightPictures pictures{DiskPicture(size), DiskPicture(size)};
  pictures.mixture.fill(
      [&](const Vec2& y) { return mixture.pdf(disk_to_direction(y)) / kSteradianPerDiskArea; });
  return pictures;
}

void add_photons(const std::string& path, const MappedCache& cache, const MediumCell* cell,
                 LightPictures& indirect, LightPictures& direct, const ToolRun& run) {
  PhotonReader reader(path);
  require_same_scene(path, reader.header().provenance, cache.provenance().scene_name,
                     cache.provenance().scene, SceneParts::all);
  const MediumCacheView view = cache.view().medium;
  std::vector<MediumPhoton> in_media;
  for (std::vector<Photon> photons; reader.read(&photons, nullptr, &in_media);) {
    run.stop_if_interrupted();
    for (const MediumPhoton& p : in_media)
      if (view.query(p.position) == cell)
        (p.path_depth == 0 ? direct : indirect)
            .photons.add(direction_to_disk(p.direction), luminance(p.weight));
  }
}

// The mixture, and its photons if there are any to compare with, relative to its largest density.
void append(LightPictures& light, bool with_photons, std::vector<DiskPicture>& pictures) {
  const double largest = light.mixture.largest();
  light.mixture.divide(largest);
  pictures.push_back(light.mixture);
  if (!with_photons) return;
  light.photons.average_blocks(std::max(light.photons.size() / 64, 1));
  light.photons.normalize();
  light.photons.divide(largest);
  pictures.push_back(light.photons);
}

std::string describe(const MediumLight& light) {
  return fmt::format("{} lobes, fluence {:.4g}, {:.0f} effective samples", light.component_count,
                     light.fluence, light.effective_samples);
}

}  // namespace

std::optional<Vec3> parse_position(const std::string& text) {
  Vec3 position;
  const char *at = text.data(), *end = at + text.size();
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0 && (at == end || *at++ != ',')) return std::nullopt;
    const auto [rest, error] = std::from_chars(at, end, position[axis]);
    if (error != std::errc() || !std::isfinite(position[axis])) return std::nullopt;
    at = rest;
  }
  return at == end ? std::optional(position) : std::nullopt;
}

void plot_medium(const ToolRun& run, const std::string& path, const Vec3& position,
                 const LobePlotArguments& arguments) {
  const MappedCache cache(path);
  const MediumCacheView view = cache.view().medium;
  const MediumCell* cell = view.query(position);
  require(cell != nullptr, "--plot {}: \"{}\" has no cells of media", arguments.target, path);
  LightPictures indirect = pictures_of(view.lobes(cell->indirect), arguments.size);
  LightPictures direct = pictures_of(view.lobes(cell->direct), arguments.size);
  const bool with_photons = !arguments.samples.empty();
  if (with_photons) add_photons(arguments.samples, cache, cell, indirect, direct, run);
  std::vector<DiskPicture> pictures;
  append(indirect, with_photons, pictures);
  append(direct, with_photons, pictures);
  write_disks(arguments.output, pictures);
  run.print(fmt::format("{}: cell {}{}", file_name(arguments.output), cell - view.cells.data(),
                        with_photons ? ", photons on the right of each" : ""));
  run.print(fmt::format("indirect light on the left: {}", describe(cell->indirect)));
  run.print(fmt::format("direct light on the right: {}", describe(cell->direct)));
}

}  // namespace waylight
