#include "tools/cache-info/medium_plot.h"

#include <fmt/format.h>

#include "formats/cache_file.h"
#include "formats/image_io.h"
#include "formats/photon_file.h"
#include "libguide/base/error.h"
#include "libguide/directional/focused_mixture.h"
#include "libguide/image/picture.h"
#include "libguide/scene/sphere_view.h"
#include "tools/cache-info/disk_picture.h"
#include "tools/common/provenance_of.h"

namespace waylight {
namespace {

// What guides directions at a position: lobes that point to places are seen from there.
VmfMixture indirect_at(const MediumCacheView& view, const MediumCell& cell, const Vec3& position) {
  const auto focused = view.focused(static_cast<uint32_t>(&cell - view.cells.data()));
  return focused.empty() ? VmfMixture(view.lobes(cell.indirect))
                         : FocusedMixture(focused).seen_from(position);
}

// A mixture's light and its photons, on one scale.
struct LightPictures {
  DiskPicture mixture, photons;
};

LightPictures pictures_of(const VmfMixture& mixture, int size) {
  LightPictures pictures{DiskPicture(size), DiskPicture(size)};
  pictures.mixture.fill(
      [&](const Vec2& y) { return mixture.pdf(disk_to_direction(y)) * kSteradianPerDiskArea; });
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

// All light of the cell, and a picture of `render --sphere` on the same scale.
void append_truth(const std::string& path, const MediumCacheView& view, const MediumCell& cell,
                  const Vec3& position, std::vector<DiskPicture>& pictures) {
  const Bitmap image = color_of(read_image(path));
  require(image.width == image.height, "--truth \"{}\": has {} x {} pixels and should be a square",
          path, image.width, image.height);
  const SphereView sphere(Vec3::Zero(), image.width, image.height);
  const VmfMixture indirect = indirect_at(view, cell, position), direct(view.lobes(cell.direct));
  DiskPicture light(pictures[0].size()), truth = light;
  light.fill([&](const Vec2& y) {
    const Vec3 w = disk_to_direction(y);
    return cell.direct.fluence * direct.pdf(w) + cell.indirect.fluence * indirect.pdf(w);
  });
  truth.fill([&](const Vec2& y) {
    const Eigen::Vector2i pixel = sphere.pixel(y).cast<int>();
    return luminance(image.at(std::clamp(pixel.x(), 0, image.width - 1),
                              std::clamp(pixel.y(), 0, image.height - 1)));
  });
  const double largest = light.largest();
  for (DiskPicture* picture : {&light, &truth}) {
    picture->divide(largest);
    pictures.push_back(*picture);
  }
}

std::string describe(const MediumLight& light) {
  return fmt::format("{} lobes, fluence {:.4g}, {:.0f} effective samples", light.component_count,
                     light.fluence, light.effective_samples);
}

}  // namespace

void plot_medium(const ToolRun& run, const std::string& path, const Vec3& position,
                 const LobePlotArguments& arguments) {
  const MappedCache cache(path);
  const MediumCacheView view = cache.view().medium;
  const MediumCell* cell = view.query(position);
  require(cell != nullptr, "--plot {}: \"{}\" has no cells of media", arguments.target, path);
  const bool with_photons = !arguments.samples.empty();  // which are of all places of the cell
  LightPictures indirect = pictures_of(
      with_photons ? VmfMixture(view.lobes(cell->indirect)) : indirect_at(view, *cell, position),
      arguments.size);
  LightPictures direct = pictures_of(VmfMixture(view.lobes(cell->direct)), arguments.size);
  if (with_photons) add_photons(arguments.samples, cache, cell, indirect, direct, run);
  std::vector<DiskPicture> pictures;
  append(indirect, with_photons, pictures);
  append(direct, with_photons, pictures);
  if (!arguments.truth.empty()) append_truth(arguments.truth, view, *cell, position, pictures);
  write_disks(arguments.output, pictures);
  run.print(fmt::format("{}: cell {}{}", file_name(arguments.output), cell - view.cells.data(),
                        with_photons ? ", photons on the right of each" : ""));
  run.print(fmt::format("indirect light on the left: {}", describe(cell->indirect)));
  run.print(fmt::format("direct light on the right{}: {}",
                        arguments.truth.empty() ? "" : " of it, then all light and the truth",
                        describe(cell->direct)));
}

}  // namespace waylight
