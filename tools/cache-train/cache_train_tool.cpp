#include "tools/cache-train/cache_train_tool.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "formats/cache_file.h"
#include "formats/photon_file.h"
#include "libguide/base/error.h"
#include "tools/common/provenance_of.h"

namespace waylight {
namespace {

CacheFile read_previous(const CacheTrainArguments& arguments, const PhotonHeader& header) {
  if (arguments.previous.empty()) return {};
  CacheFile previous = read_cache(arguments.previous);
  require_same_scene(arguments.previous, previous.provenance, header.provenance.scene_name,
                     header.provenance.scene, SceneParts::all);
  if (previous.cache.quantity != header.stream.quantity)
    fail("\"{}\": holds {}, and \"{}\" {}: train each in a cache of its own", arguments.previous,
         quantity_name(previous.cache.quantity), arguments.photons,
         quantity_name(header.stream.quantity));
  if (previous.cache.training.empty() && previous.cache.medium.training.empty())
    fail("\"{}\": is a reduced cache, which cannot be trained further; give the file it came from",
         arguments.previous);
  return previous;
}

// take(photons, escapes, photons in media) of all of the file.
template <typename Take>
void read_all(PhotonReader& reader, const ToolRun& run, const char* what, const Take& take) {
  std::vector<Photon> photons;
  std::vector<Escape> escapes;
  std::vector<MediumPhoton> in_media;
  for (double done = 0; reader.read(&photons, &escapes, &in_media);) {
    run.stop_if_interrupted();
    take(photons, escapes, in_media);
    done += static_cast<double>(photons.size() + in_media.size());
    run.control.progress(done, reader.share() > 0 ? done / reader.share() : 0, what);
  }
}

void train(PhotonReader& reader, CacheTrainer& trainer, const ToolRun& run) {
  read_all(reader, run, "photons",
           [&](const auto& photons, const auto& escapes, const auto& in_media) {
             trainer.consume(photons);
             trainer.consume(escapes);
             trainer.consume(in_media);
           });
}

void refit(const PhotonReader& first, const std::string& path, CacheTrainer& trainer,
           const ToolRun& run) {
  PhotonReader reader(path);
  read_all(reader, run, "photons again",
           [&](const auto& photons, const auto& /*escapes*/, const auto& in_media) {
             trainer.refit(photons);
             trainer.refit(in_media);
           });
  if (reader.content_hash() != first.content_hash())
    fail("\"{}\": changed while it was read: run the training again", path);
}

// A pipe can be read but once.
bool reads_again(const CacheTrainArguments& arguments, const PhotonReader& reader) {
  return !arguments.once && arguments.photons != "-" && reader.share() > 0;
}

Provenance provenance(const ToolRun& run, const ToolInfo& tool,
                      const CacheTrainArguments& arguments, const PhotonReader& reader) {
  const Provenance& source = reader.header().provenance;
  Provenance result = provenance_of(run, tool, source.seed);
  result.scene_name = source.scene_name;
  result.scene = source.scene;
  const std::string name = arguments.photons == "-" ? "stdin" : file_name(arguments.photons);
  result.parents.push_back({name, reader.content_hash()});
  if (!arguments.previous.empty()) result.parents.push_back(parent_of(arguments.previous));
  return result;
}

nlohmann::ordered_json stats_of(const MediumLightSummary& s) {
  return {{"cells_with_mixture", s.cells_with_mixture},
          {"mean_components", s.mean_components},
          {"mean_effective_samples", s.mean_effective_samples}};
}

nlohmann::ordered_json stats_of(const MediumTrainSummary& s) {
  return {{"photons", s.photons},
          {"rejected", s.rejected},
          {"weights_capped", s.weights_capped},
          {"cells", s.cells},
          {"cells_before_merging", s.cells_before_merging},
          {"cells_with_focus", s.cells_with_focus},
          {"indirect", stats_of(s.indirect)},
          {"direct", stats_of(s.direct)},
          {"training_bytes", s.bytes}};
}

nlohmann::ordered_json stats_of(const Provenance& provenance, Quantity quantity,
                                const CacheTrainSummary& s) {
  nlohmann::ordered_json stats = stats_of(provenance);
  stats.update({{"seconds", s.seconds},
                {"quantity", quantity_name(quantity)},
                {"photons", s.photons},
                {"escapes", s.escapes},
                {"rejected", s.rejected},
                {"dropped_direct", s.dropped_direct},
                {"weights_capped", s.weights_capped},
                {"cells", s.cells},
                {"cells_made", s.cells_made},
                {"mixtures_refitted", s.mixtures_refitted},
                {"cells_before_merging", s.cells_before_merging},
                {"bytes_saved", s.bytes_saved},
                {"cells_with_mixture", s.cells_with_mixture},
                {"mean_components", s.mean_components},
                {"mean_effective_samples", s.mean_effective_samples},
                {"lost_mass", s.lost_mass},
                {"training_bytes", s.bytes},
                {"peak_memory_bytes", peak_memory_bytes()}});
  if (s.media.cells > 0) stats["media"] = stats_of(s.media);
  return stats;
}

void report_media(const ToolRun& run, const MediumTrainSummary& s, bool merges) {
  run.print(
      fmt::format("media: {} photons, {} cells, lobes of indirect light {:.1f}, of direct {:.1f}",
                  format_count(double(s.photons)), s.cells, s.indirect.mean_components,
                  s.direct.mean_components));
  if (merges)
    run.print(fmt::format("media: {} cells became {} where their light is the same",
                          s.cells_before_merging, s.cells));
  if (s.cells_with_focus > 0)
    run.print(fmt::format("media: in {} cells lobes of indirect light point to places",
                          s.cells_with_focus));
  run.print(fmt::format("media: {:.0f} effective samples of indirect light, {:.0f} of direct; {}",
                        s.indirect.mean_effective_samples, s.direct.mean_effective_samples,
                        format_bytes(double(s.bytes))));
}

void warn_of(const ToolRun& run, const CacheTrainSummary& s) {
  const uint64_t rejected = s.rejected + s.media.rejected;
  if (rejected > 0)
    run.control.warn(fmt::format("{} photons made no sense and were left out", rejected));
  if (s.cells_with_mixture + s.media.indirect.cells_with_mixture +
          s.media.direct.cells_with_mixture ==
      0)
    run.control.warn("no cell saw enough photons for a mixture");
}

void report(const ToolRun& run, const PhotonStreamInfo& stream, const CacheTrainSummary& s,
            bool read_again, bool merges) {
  const double photons = static_cast<double>(s.photons + s.media.photons);
  const char* particles = stream.quantity == Quantity::importance ? "importons"
                          : stream.paths == 0                     ? "photons"
                          : stream.emitted == 0                   ? "samples of camera paths"
                                                : "photons and samples of camera paths";
  run.print(fmt::format("{} {} in {:.1f} s ({}/s)", format_count(photons), particles, s.seconds,
                        format_count(photons / std::max(s.seconds, 1e-9))));
  run.print(
      fmt::format("{} cells, {} with a mixture of {:.1f} components and {:.0f} effective samples",
                  s.cells, s.cells_with_mixture, s.mean_components, s.mean_effective_samples));
  if (read_again)
    run.print(
        fmt::format("{} mixtures of surfaces fitted again to at most 512 photons of each cell",
                    s.mixtures_refitted));
  else
    run.print("photons were read once: no mixture was fitted again");
  if (merges)
    run.print(fmt::format("{} cells became {} where their light is the same: {} saved",
                          s.cells_before_merging, s.cells, format_bytes(double(s.bytes_saved))));
  run.print(fmt::format(
      "{:.2f} % of the mixtures' mass lies outside the sphere; {} in training, peak {}",
      100 * s.lost_mass, format_bytes(double(s.bytes)), format_bytes(double(peak_memory_bytes()))));
  if (s.media.cells > 0) report_media(run, s.media, merges);
  warn_of(run, s);
}

}  // namespace

void cache_train(const ToolRun& run, const ToolInfo& tool, const CacheTrainArguments& arguments) {
  arguments.options.validate();
  PhotonReader reader(arguments.photons);
  const PhotonHeader& header = reader.header();
  CacheFile previous = read_previous(arguments, header);
  CacheTrainer trainer(arguments.options, header.stream, std::move(previous.cache));
  train(reader, trainer, run);
  const bool again = reads_again(arguments, reader);
  if (again) refit(reader, arguments.photons, trainer, run);
  CacheTrainSummary summary;
  CacheFile file;
  file.cache = trainer.finish(&summary, run.control);
  file.provenance = provenance(run, tool, arguments, reader);
  run.stop_if_interrupted();
  write_cache(arguments.output, file);
  report(run, header.stream, summary, again, arguments.options.merge_alike);
  run.write_stats(stats_of(file.provenance, file.cache.quantity, summary));
}

}  // namespace waylight
