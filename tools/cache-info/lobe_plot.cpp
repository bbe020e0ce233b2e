#include "tools/cache-info/lobe_plot.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "formats/brdf_file.h"
#include "formats/cache_file.h"
#include "formats/photon_file.h"
#include "libguide/base/error.h"
#include "libguide/directional/entry_layout.h"
#include "libguide/fit/fit_plan.h"
#include "libguide/fit/lobe_target.h"
#include "libguide/math/frame.h"
#include "tools/cache-info/disk_picture.h"
#include "tools/common/provenance_of.h"

namespace waylight {
namespace {

std::optional<uint32_t> parse_index(const std::string& text) {
  uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

DiskPicture picture_of(std::span<const GaussianComponent> components, int size) {
  const GaussianMixture mixture(components);
  DiskPicture picture(size);
  picture.fill([&](const Vec2& y) { return mixture.pdf(y); });
  return picture;
}

// About 64 blocks along the side: a cell saw a few thousand photons.
DiskPicture picture_of_photons(const LobePlotArguments& arguments, const MappedCache& cache,
                               uint32_t index, const ToolRun& run) {
  const std::string& path = arguments.samples;
  const int size = arguments.size;
  PhotonReader reader(path);
  const PhotonHeader& header = reader.header();
  require_same_scene(path, header.provenance, cache.provenance().scene_name,
                     cache.provenance().scene, SceneParts::all);
  const GuideCacheView view = cache.view();
  if (header.stream.quantity != view.quantity)
    fail("\"{}\": holds {}, and the cache {}", path, quantity_name(header.stream.quantity),
         quantity_name(view.quantity));
  const Frame frame(view.cells[index].normal);
  DiskPicture picture(size);
  for (std::vector<Photon> photons; reader.read(&photons);) {
    run.stop_if_interrupted();
    for (const Photon& p : photons)
      if ((arguments.direct || p.path_depth > 0) &&
          find_leaf(view.nodes, p.position, p.normal) == index)
        picture.add(direction_to_disk(frame.to_local(p.direction)), luminance(p.power));
  }
  picture.average_blocks(std::max(size / 64, 1));
  picture.normalize();
  return picture;
}

const MaterialFit& find_fit(const BrdfCache& cache, const std::string& target) {
  for (const MaterialFit& fit : cache.materials)
    if (fit.name == target) return fit;
  if (const std::optional<uint32_t> index = parse_index(target))
    for (const MaterialFit& fit : cache.materials)
      if (fit.material == *index) return fit;
  std::string names;
  for (const MaterialFit& fit : cache.materials)
    names += fmt::format("{} {}", names.empty() ? "" : ",", fit.name);
  throw Misuse(fmt::format("--plot {}: no fitted material has that name or number; there are{}",
                           target, names.empty() ? " none" : names));
}

// Of the lobe that the fit stands for.
DiskPicture picture_of_bsdf(const Bsdf& bsdf, const Vec3& wo, int size) {
  const LobeTarget target(bsdf, wo);
  DiskPicture picture(size);
  picture.fill([&](const Vec2& y) { return target.evaluate(disk_to_direction(y)).f; });
  picture.normalize();
  return picture;
}

// At its mean or, where the width is textured, at the width that the fit shows.
Bsdf fitted_bsdf(const SceneDescription& scene, const MaterialFit& fit) {
  const FitPlan plan = plan_fits(scene, 0);
  for (const PlannedFit& planned : plan.fits) {
    if (static_cast<uint32_t>(planned.material) != fit.material) continue;
    for (const WidthSeries& s : fit.widths)
      if (s.first_entry == fit.first_entry)
        return resolve_at_width(scene.materials, planned.material, s.width);
    return planned.bsdf;
  }
  fail("material \"{}\" (number {}) of the scene has no lobe to draw", fit.name, fit.material);
}

void report(const ToolRun& run, const LobePlotArguments& arguments, const std::string& what) {
  run.print(fmt::format("{}: {}", file_name(arguments.output), what));
}

}  // namespace

void plot_cell(const ToolRun& run, const std::string& path, const LobePlotArguments& arguments) {
  const MappedCache cache(path);
  const GuideCacheView view = cache.view();
  const std::optional<uint32_t> index = parse_index(arguments.target);
  require(index && *index < view.cells.size(), "--plot {}: \"{}\" has the cells 0 to {}",
          arguments.target, path, static_cast<int64_t>(view.cells.size()) - 1);
  const CacheCell& cell = view.cells[*index];
  std::vector<DiskPicture> pictures = {picture_of(
      view.components.subspan(cell.first_component, cell.component_count), arguments.size)};
  if (!arguments.samples.empty())
    pictures.push_back(picture_of_photons(arguments, cache, *index, run));
  write_disks(arguments.output, pictures);
  report(run, arguments,
         fmt::format("cell {}, {} components, {:.0f} effective samples{}", *index,
                     cell.component_count, cell.effective_samples,
                     pictures.size() > 1 ? "; its photons on the right" : ""));
}

void plot_material(const ToolRun& run, const std::string& path,
                   const LobePlotArguments& arguments) {
  const BrdfFile file = read_brdf(path);
  const MaterialFit& fit = find_fit(file.cache, arguments.target);
  const int count = static_cast<int>(fit.entry_count);
  const float asked = arguments.elevation.value_or(45) * (kPi / 180);
  const Vec3 from(std::sin(asked), 0, std::cos(asked));
  const int row = nearest_entry(fit.layout, from, count);
  const bool any_wo = fit.layout == EntryLayout::elevations && count == 1;
  const Vec3 wo = any_wo ? from : entry_wo(fit.layout, row, count);
  const BrdfCacheEntry& entry = file.cache.entries[fit.first_entry + row];
  std::vector<DiskPicture> pictures = {picture_of(
      std::span(file.cache.components).subspan(entry.first_component, entry.component_count),
      arguments.size)};
  if (!arguments.scene.path.empty()) {
    const SceneDescription scene = load_scene(arguments.scene, run);
    require_same_scene(path, file.provenance, file_name(arguments.scene.path), scene.hash,
                       SceneParts::materials);
    pictures.push_back(picture_of_bsdf(fitted_bsdf(scene, fit), wo, arguments.size));
  }
  write_disks(arguments.output, pictures);
  report(run, arguments,
         fmt::format("{} at {:.1f} degrees, {} components, held-out error {:.3f}{}", fit.name,
                     std::acos(wo.z()) * (180 / kPi), entry.component_count, entry.held_out_error,
                     pictures.size() > 1 ? "; the BSDF on the right" : ""));
}

}  // namespace waylight
