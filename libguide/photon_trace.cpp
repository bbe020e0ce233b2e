#include "libguide/photon_trace.h"

#include <optional>
#include <vector>

#include "libguide/base/error.h"
#include "libguide/base/parallel.h"
#include "libguide/base/stopwatch.h"
#include "libguide/transport/photon_tracer.h"
#include "libguide/transport/radiance_tracer.h"

namespace waylight {

void PhotonTraceOptions::validate() const {
  require(count <= 4'000'000'000ull, "--count must be in [0, 4e9], not {}", count);
  require(paths <= 4'000'000'000ull, "--paths must be in [0, 4e9], not {}", paths);
  require(count > 0 || paths > 0, "--count is 0: without --paths there is nothing to trace");
  require(paths == 0 || quantity == Quantity::radiance,
          "--paths carry radiance and --from camera importance: trace each into a file of its own");
  require(max_depth >= 1 && max_depth <= 10000, "--max-depth must be in [1, 10000], not {}",
          max_depth);
  require(rr_depth >= 0 && rr_depth <= 10000, "--rr-depth must be in [0, 10000], not {}", rr_depth);
}

namespace {

constexpr uint64_t kParticlesPerBlock = 1024;
constexpr uint64_t kBlocksPerRound = 64, kRound = kParticlesPerBlock * kBlocksPerRound;

// Random numbers: importons and camera paths draw others than the photons of the same pass.
enum class Stream : uint64_t { photons, importons, paths };
uint64_t number_of(const PhotonTraceOptions& options, Stream stream) {
  return options.pass | static_cast<uint64_t>(stream) << 32;
}

// What particles, or camera paths, leave behind, block by block.
struct Block {
  PhotonRecords records;
  RadiancePath path;  // scratch
};

class Tracing {
 public:
  Tracing(const Scene& scene, const PhotonTraceOptions& options, const TraceGuides& guides);

  // The particles first .. last - 1, or paths; in blocks of which each is for one thread. One
  // block's records are kept apart so that the order is that of the particles.
  std::span<const Block> particles(uint64_t first, uint64_t last);
  std::span<const Block> paths(uint64_t first, uint64_t last);

 private:
  template <typename TraceOne>
  std::span<const Block> trace(uint64_t first, uint64_t last, Stream stream,
                               std::vector<Block>& blocks, const TraceOne& trace_one) const;

  PhotonTraceOptions options_;
  std::optional<PhotonTracer> particles_;
  std::optional<RadianceTracer> paths_;
  std::vector<Block> particle_blocks_, path_blocks_;
};

Tracing::Tracing(const Scene& scene, const PhotonTraceOptions& options, const TraceGuides& guides)
    : options_(options), particle_blocks_(kBlocksPerRound), path_blocks_(kBlocksPerRound) {
  const PhotonTracerOptions particles{options.quantity, options.max_depth, options.rr_depth,
                                      1.0f / static_cast<float>(options.count)};
  if (options.count > 0) particles_.emplace(scene, particles, guides.importance);
  const RadianceTracerOptions paths{options.max_depth, options.rr_depth};
  if (options.paths > 0) paths_.emplace(scene, paths, guides.radiance);
}

template <typename TraceOne>
std::span<const Block> Tracing::trace(uint64_t first, uint64_t last, Stream stream,
                                      std::vector<Block>& blocks, const TraceOne& trace_one) const {
  const size_t used = (last - first + kParticlesPerBlock - 1) / kParticlesPerBlock;
  parallel_for(used, [&](size_t b) {
    Block& block = blocks[b];
    block.records.clear();
    const uint64_t begin = first + b * kParticlesPerBlock;
    const uint64_t end = std::min(begin + kParticlesPerBlock, last);
    for (uint64_t i = begin; i < end; ++i) {
      Sampler sampler(options_.seed, number_of(options_, stream), static_cast<uint32_t>(i));
      trace_one(sampler, block);
    }
  });
  return std::span(blocks).first(used);
}

std::span<const Block> Tracing::particles(uint64_t first, uint64_t last) {
  const bool photons = options_.quantity == Quantity::radiance;
  return trace(first, last, photons ? Stream::photons : Stream::importons, particle_blocks_,
               [&](Sampler& sampler, Block& block) { particles_->trace(sampler, &block.records); });
}

std::span<const Block> Tracing::paths(uint64_t first, uint64_t last) {
  return trace(first, last, Stream::paths, path_blocks_, [&](Sampler& sampler, Block& block) {
    paths_->trace(sampler, block.path, &block.records);
  });
}

// In turns, each in proportion to how many there are: a cell that is made in between has seen
// both kinds for about as long.
template <typename Sink>
void take_turns(std::span<const Block> a, std::span<const Block> b, const Sink& sink) {
  for (size_t i = 0, j = 0; i < a.size() || j < b.size();)
    sink(i * b.size() <= j * a.size() && i < a.size() ? a[i++] : b[j++]);
}

// Each round has its share of both.
uint64_t begin_of(uint64_t round, uint64_t rounds, uint64_t total) {
  return total / rounds * round + total % rounds * round / rounds;
}

void check_guides(const PhotonTraceOptions& options, const TraceGuides& guides) {
  const bool photons = options.count > 0 && options.quantity == Quantity::radiance;
  require(guides.importance.cells.empty() || photons,
          "--importance guides photons: it does not go with --from camera or --count 0");
  require(guides.radiance.cells.empty() || options.paths > 0,
          "--cache guides camera paths: it needs --paths");
  if (!guides.importance.cells.empty() && guides.importance.quantity != Quantity::importance)
    fail("photons are guided by a cache of importance, and this one holds radiance");
  if (!guides.radiance.cells.empty() && guides.radiance.quantity != Quantity::radiance)
    fail("camera paths are guided by a cache of radiance, and this one holds importance");
}

// For `total` of them, by those in the blocks.
double expected_records(std::span<const Block> blocks, uint64_t traced, uint64_t total) {
  double records = 0;
  for (const Block& block : blocks) records += static_cast<double>(block.records.photons.size());
  return records * static_cast<double>(total) / static_cast<double>(std::max<uint64_t>(traced, 1));
}

}  // namespace

uint64_t expected_records(const Scene& scene, const PhotonTraceOptions& options,
                          const TraceGuides& guides) {
  if (options.paths == 0) return 0;
  constexpr uint64_t kTried = 4 * kParticlesPerBlock;
  Tracing tracing(scene, options, guides);
  const uint64_t particles = std::min(options.count, kTried);
  const uint64_t paths = std::min(options.paths, kTried);
  const double photons =
      expected_records(tracing.particles(0, particles), particles, options.count);
  return static_cast<uint64_t>(photons +
                               expected_records(tracing.paths(0, paths), paths, options.paths));
}

PhotonTraceSummary trace_photons(const Scene& scene, const PhotonTraceOptions& options,
                                 const PhotonSink& photons, const RunControl& control,
                                 const EscapeSink& escapes, const TraceGuides& guides,
                                 const MediumPhotonSink& in_media) {
  options.validate();
  check_guides(options, guides);
  const Stopwatch stopwatch;
  Tracing tracing(scene, options, guides);
  PhotonTraceSummary summary;
  const auto pass_on = [&](const Block& block) {
    photons(block.records.photons);
    if (escapes) escapes(block.records.escapes);
    if (in_media) in_media(block.records.in_media);
    summary += block.records.counts;
  };
  const uint64_t rounds = (std::max(options.count, options.paths) + kRound - 1) / kRound;
  for (uint64_t i = 0; i < rounds && !control.stopped(); ++i) {
    const auto particles = tracing.particles(begin_of(i, rounds, options.count),
                                             begin_of(i + 1, rounds, options.count));
    const auto paths =
        tracing.paths(begin_of(i, rounds, options.paths), begin_of(i + 1, rounds, options.paths));
    take_turns(particles, paths, pass_on);
    control.progress(double(summary.emitted + summary.paths), double(options.count + options.paths),
                     "particles");
  }
  summary.seconds = stopwatch.seconds();
  return summary;
}

}  // namespace waylight
