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

// What one block of particles left behind; kept apart so that the order is that of the particles.
struct Block {
  std::vector<Photon> photons;
  PhotonCounts counts;
};

void trace_block(const PhotonTracer& tracer, const PhotonTraceOptions& options, uint64_t first,
                 Block* block) {
  block->photons.clear();
  block->counts = {};
  const uint64_t last = std::min(first + kParticlesPerBlock, options.count);
  for (uint64_t i = first; i < last; ++i) {
    Sampler sampler(options.seed, options.pass, static_cast<uint32_t>(i));
    tracer.trace(sampler, &block->photons, &block->counts);
  }
}

}  // namespace

PhotonTraceSummary trace_photons(const Scene& scene, const PhotonTraceOptions& options,
                                 const PhotonSink& sink, const RunControl& control) {
  options.validate();
  if (!scene.has_lights()) fail("the scene has no emitter, so there are no photons to trace");
  const auto start = std::chrono::steady_clock::now();
  const PhotonTracer tracer(scene, options.max_depth, options.rr_depth,
                            1.0f / static_cast<float>(options.count));
  PhotonTraceSummary summary;
  std::vector<Block> blocks(kBlocksPerRound);
  const uint64_t round = kParticlesPerBlock * kBlocksPerRound;
  for (uint64_t first = 0; first < options.count && !control.stopped(); first += round) {
    const uint64_t left = options.count - first;
    const size_t used =
        std::min(kBlocksPerRound, (left + kParticlesPerBlock - 1) / kParticlesPerBlock);
    parallel_for(used, [&](size_t b) {
      trace_block(tracer, options, first + b * kParticlesPerBlock, &blocks[b]);
    });
    for (size_t b = 0; b < used; ++b) {
      sink(blocks[b].photons);
      summary += blocks[b].counts;
    }
    control.progress(double(summary.emitted), double(options.count), "particles");
  }
  summary.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return summary;
}

}  // namespace waylight
