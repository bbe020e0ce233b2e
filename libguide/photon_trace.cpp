#include "libguide/photon_trace.h"

#include <array>
#include <chrono>
#include <vector>

#include "libguide/base/error.h"
#include "libguide/base/parallel.h"
#include "libguide/transport/photon_tracer.h"

namespace waylight {

void PhotonTraceOptions::validate() const {
  require(count >= 1 && count <= 4'000'000'000ull, "--count must be in [1, 4e9], not {}", count);
  require(max_depth >= 1 && max_depth <= 10000, "--max-depth must be in [1, 10000], not {}",
          max_depth);
  require(rr_depth >= 0, "--rr-depth must not be negative, but is {}", rr_depth);
}

namespace {

constexpr uint64_t kParticlesPerBlock = 1024;
constexpr uint64_t kBlocksPerRound = 64;

// Importons draw other numbers than the photons of the same pass.
uint64_t stream_of(const PhotonTraceOptions& options) {
  return options.pass | uint64_t{options.quantity == Quantity::importance} << 32;
}

// One block's records are kept apart so that the order is that of the particles.
void trace_block(const PhotonTracer& tracer, const PhotonTraceOptions& options, uint64_t first,
                 PhotonRecords* block) {
  block->photons.clear();
  block->escapes.clear();
  block->in_media.clear();
  block->counts = {};
  const uint64_t last = std::min(first + kParticlesPerBlock, options.count);
  for (uint64_t i = first; i < last; ++i) {
    Sampler sampler(options.seed, stream_of(options), static_cast<uint32_t>(i));
    tracer.trace(sampler, block);
  }
}

}  // namespace

PhotonTraceSummary trace_photons(const Scene& scene, const PhotonTraceOptions& options,
                                 const PhotonSink& photons, const RunControl& control,
                                 const EscapeSink& escapes, const GuideCacheView& importance,
                                 const MediumPhotonSink& in_media) {
  options.validate();
  require(importance.cells.empty() || options.quantity == Quantity::radiance,
          "--importance guides photons: it does not go with --from camera");
  if (!importance.cells.empty() && importance.quantity != Quantity::importance)
    fail("photons are guided by a cache of importance, and this one holds radiance");
  const auto start = std::chrono::steady_clock::now();
  const PhotonTracer tracer(scene,
                            {options.quantity, options.max_depth, options.rr_depth,
                             1.0f / static_cast<float>(options.count)},
                            importance);
  PhotonTraceSummary summary;
  std::vector<PhotonRecords> blocks(kBlocksPerRound);
  const uint64_t round = kParticlesPerBlock * kBlocksPerRound;
  for (uint64_t first = 0; first < options.count && !control.stopped(); first += round) {
    const uint64_t left = options.count - first;
    const size_t used =
        std::min(kBlocksPerRound, (left + kParticlesPerBlock - 1) / kParticlesPerBlock);
    parallel_for(used, [&](size_t b) {
      trace_block(tracer, options, first + b * kParticlesPerBlock, &blocks[b]);
    });
    for (size_t b = 0; b < used; ++b) {
      photons(blocks[b].photons);
      if (escapes) escapes(blocks[b].escapes);
      if (in_media) in_media(blocks[b].in_media);
      summary += blocks[b].counts;
    }
    control.progress(double(summary.emitted), double(options.count), "particles");
  }
  summary.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return summary;
}

}  // namespace waylight
