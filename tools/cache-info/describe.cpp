#include "tools/cache-info/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "formats/brdf_file.h"
#include "formats/cache_file.h"
#include "formats/image_io.h"
#include "formats/photon_file.h"
#include "libguide/base/error.h"
#include "tools/cache-info/describe_media.h"
#include "tools/cache-info/range.h"
#include "tools/common/provenance_of.h"

namespace waylight {
namespace {

using Json = nlohmann::ordered_json;

std::string hex(uint64_t hash) { return fmt::format("{:016x}", hash); }

double ratio(double sum, double count) { return count > 0 ? sum / count : 0; }

Json head(const std::string& path, const char* kind) {
  return {{"file", file_name(path)}, {"kind", kind}, {"bytes", std::filesystem::file_size(path)}};
}

void add_provenance(Json& info, const Provenance& p) {
  info.update(stats_of(p));
  info["scene_hash"] = {{"geometry", hex(p.scene.geometry)},
                        {"materials", hex(p.scene.materials)},
                        {"emitters", hex(p.scene.emitters)},
                        {"media", hex(p.scene.media)}};
  Json parents = Json::array();
  for (const ParentFile& parent : p.parents)
    parents.push_back({{"name", parent.name}, {"hash", hex(parent.hash)}});
  info["parents"] = parents;
}

// The series of a material, one where its width is not textured.
std::vector<WidthSeries> series_of(const MaterialFit& fit) {
  if (!fit.widths.empty()) return fit.widths;
  return {{0, fit.first_entry, fit.entry_count}};
}

const char* layout_name(const MaterialFit& fit) {
  if (fit.layout == EntryLayout::fibonacci) return "directions";
  return fit.entry_count > 1 ? "elevations" : "any";
}

Json describe_material(const MaterialFit& fit, const BrdfCache& cache) {
  double entries = 0, components = 0, error = 0;
  const std::vector<WidthSeries> series = series_of(fit);
  for (const WidthSeries& s : series)
    for (uint32_t i = s.first_entry; i < s.first_entry + s.entry_count; ++i) {
      ++entries;
      components += cache.entries[i].component_count;
      error += cache.entries[i].held_out_error;
    }
  return {{"index", fit.material},
          {"name", fit.name},
          {"kind", fit.kind},
          {"textured", fit.textured},
          {"wo", layout_name(fit)},
          {"widths", fit.widths.size()},
          {"entries", static_cast<uint64_t>(entries)},
          {"components", components / entries},
          {"held_out_error", error / entries}};
}

Json describe_brdf(const std::string& path) {
  const BrdfFile file = read_brdf(path);
  Json info = head(path, "brdf");
  add_provenance(info, file.provenance);
  const BrdfCache& cache = file.cache;
  info["entries"] = cache.entries.size();
  info["components"] = cache.components.size();
  Json materials = Json::array();
  for (const MaterialFit& fit : cache.materials) materials.push_back(describe_material(fit, cache));
  info["materials"] = materials;
  return info;
}

// What guiding needs of a cache, in the file and in memory alike; training has more.
double guide_bytes(const GuideCache& cache) {
  return double(cache.nodes.size() * sizeof(CacheNode) + cache.cells.size() * sizeof(CacheCell) +
                cache.reaches.size() * sizeof(CellReach) +
                cache.components.size() * sizeof(GaussianComponent));
}

void add_cells(Json& info, const GuideCache& cache) {
  uint64_t with_mixture = 0, usable = 0;
  Range components, effective, photons, irradiance, mass;
  for (const CacheCell& cell : cache.cells) {
    irradiance.add(cell.irradiance);
    if (cell.component_count == 0) continue;
    ++with_mixture;
    usable += cell.effective_samples >= kMinEffectiveSamples;
    components.add(cell.component_count);
    effective.add(cell.effective_samples);
    photons.add(cell.photon_count);
    mass.add(cell.guided_mass);
  }
  info.update({{"cells", cache.cells.size()},
               {"cells_with_mixture", with_mixture},
               {"cells_that_guide", usable},
               {"bytes_per_cell", ratio(guide_bytes(cache), double(cache.cells.size()))},
               {"components", components.json()},
               {"effective_samples", effective.json()},
               {"photons_per_cell", photons.json()},
               {"guided_mass", mass.json()},
               {"irradiance", irradiance.json()}});
}

Json describe_training(const GuideCache& cache) {
  if (cache.training.empty()) return "dropped: training cannot go on";
  Range steps, samples;
  for (const CellTraining& t : cache.training) steps.add(t.step), samples.add(t.samples);
  return {{"steps", steps.json()}, {"samples", samples.json()}};
}

Json describe_cache(const std::string& path) {
  const CacheFile file = read_cache(path);
  const GuideCache& cache = file.cache;
  Json info = head(path, "cache");
  add_provenance(info, file.provenance);
  info.update({{"quantity", quantity_name(cache.quantity)},
               {"passes", cache.passes},
               {"particles", cache.emitted},
               {"photons", cache.photons},
               {"nodes", cache.nodes.size()}});
  if (cache.paths > 0) info["paths"] = cache.paths;
  add_cells(info, cache);
  if (!cache.escape_bins.empty()) info["escape_bins"] = cache.escape_bins.size();
  info["training"] = describe_training(cache);
  if (!cache.medium.cells.empty()) info["media"] = describe_media(cache.medium);
  return info;
}

struct PhotonTally {
  static constexpr size_t kDepths = 16;  // the last one stands for all deeper ones
  std::array<uint64_t, kDepths> counts{};
  std::array<double, kDepths> power{};  // luminance

  void add(uint32_t path_depth, const Color& weight) {
    const size_t depth = std::min<size_t>(path_depth, kDepths - 1);
    ++counts[depth];
    power[depth] += luminance(weight);
  }
  // what: the name of the sums of weights.
  Json json(const char* what) const {
    Json rows = Json::array();
    for (size_t i = 0; i < kDepths; ++i)
      if (counts[i] > 0)
        rows.push_back({{"depth", fmt::format("{}{}", i, i + 1 < kDepths ? "" : "+")},
                        {"photons", counts[i]},
                        {what, power[i]}});
    return rows;
  }
};

struct PhotonTallies {
  PhotonTally photons, samples, in_media;
};

PhotonTallies tally_all(PhotonReader& reader, const ToolRun& run) {
  PhotonTallies tallies;
  uint64_t done = 0;
  std::vector<MediumPhoton> in_media;
  for (std::vector<Photon> photons; reader.read(&photons, nullptr, &in_media);) {
    run.stop_if_interrupted();
    run.control.progress(double(done += photons.size() + in_media.size()), 0, "photons");
    for (const Photon& photon : photons)
      (photon.from == TracedFrom::lights ? tallies.photons : tallies.samples)
          .add(photon.path_depth, photon.power);
    for (const MediumPhoton& photon : in_media)
      tallies.in_media.add(photon.path_depth, photon.weight);
  }
  return tallies;
}

Json describe_photons(const std::string& path, const ToolRun& run) {
  PhotonReader reader(path);
  const PhotonTallies tallies = tally_all(reader, run);
  Json info = head(path, "photons");
  add_provenance(info, reader.header().provenance);
  const PhotonCounts& c = reader.counts();
  info.update({{"hash", hex(reader.content_hash())},
               {"quantity", quantity_name(reader.header().stream.quantity)},
               {"pass", reader.header().stream.pass},
               {"particles", c.emitted},
               {"photons", c.stored},
               {"escapes", c.escapes},
               {"left_scene", c.left_scene},
               {"absorbed", c.absorbed},
               {"too_deep", c.too_deep},
               {"invalid", c.invalid},
               {"depths", tallies.photons.json("power")}});
  if (reader.header().stream.paths > 0) {
    info["paths"] = c.paths;
    info["samples"] = c.samples;
    info["depths_of_samples"] = tallies.samples.json("irradiance");
  }
  if (reader.header().stream.media) {
    info["in_media"] = c.in_media;
    info["depths_in_media"] = tallies.in_media.json("weight");
  }
  return info;
}

Json describe_channels(const Image& image) {
  Json rows = Json::array();
  for (size_t c = 0; c < image.channels.size(); ++c) {
    Range range;
    for (size_t i = c; i < image.pixels.size(); i += image.channels.size())
      if (std::isfinite(image.pixels[i])) range.add(image.pixels[i]);
    Json row = {{"channel", image.channels[c]}};
    row.update(range.json());
    rows.push_back(row);
  }
  return rows;
}

Json describe_image(const std::string& path) {
  std::map<std::string, std::string> attributes;
  const Image image = read_image(path, &attributes);
  Json info = head(path, "exr");
  for (const auto& [name, value] : attributes)
    if (name.starts_with("waylight.")) info[name.substr(9)] = value;
  info["width"] = image.width;
  info["height"] = image.height;
  info["not_finite"] = std::count_if(image.pixels.begin(), image.pixels.end(),
                                     [](float v) { return !std::isfinite(v); });
  info["channels"] = describe_channels(image);
  return info;
}

}  // namespace

Json describe_content(const std::string& path, FileKind kind, const ToolRun& run) {
  switch (kind) {
    case FileKind::brdf:
      return describe_brdf(path);
    case FileKind::cache:
      return describe_cache(path);
    case FileKind::photons:
      return describe_photons(path, run);
    case FileKind::exr:
      return describe_image(path);
    case FileKind::unknown:
      break;
  }
  fail("\"{}\": is {}", path, describe(kind));
}

}  // namespace waylight
