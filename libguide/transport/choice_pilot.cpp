#include "libguide/transport/choice_pilot.h"

#include <cmath>
#include <numeric>

#include "libguide/base/parallel.h"

namespace waylight {
namespace {

constexpr int kSpp = 4;        // of a place in one round
constexpr int kMaxRounds = 2;  // over the whole frame
constexpr int kTilesPerTurn = 32;
// A path's radiance is held to this many times the value of its surroundings: what is beyond would
// decide alone, and by chance.
constexpr double kMostOfAPath = 32;

// What the paths of one tile tell, relative to the tile's mean.
struct TileRecord {
  std::vector<GuidedSample> samples;
  double variance = 0, work = 0;
};

class ChoicePilot {
 public:
  ChoicePilot(const PathTracer& tracer, const PilotFrame& frame, const ChoicePilotOptions& options)
      : tracer_(tracer), frame_(frame), both_(options.guides.size() > 1) {}

  void trace_tile(int tile, int round, TileRecord* record) const {
    std::vector<GuidedVertex> vertices;
    std::vector<double> values;
    *record = {};
    frame_.for_places(tile, [&](int place) {
      for (int s = 0; s < kSpp; ++s)
        values.push_back(trace(place, round * kSpp + s, vertices, record));
    });
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
    const double scale = relative_scale(mean);
    for (const double value : values)
      record->variance += sqr(std::min(value * scale, kMostOfAPath) - mean * scale);
    for (GuidedSample& s : record->samples)
      s.contribution = static_cast<float>(std::min(s.contribution * scale, kMostOfAPath));
  }

 private:
  // Appends what the path's vertices tell; returns the luminance of its radiance.
  float trace(int place, int sample, std::vector<GuidedVertex>& vertices,
              TileRecord* record) const {
    // Not the numbers by which what is learned is compared afterwards (method_pilot.cpp).
    Sampler sampler = frame_.sampler(place, sample, 2);
    vertices.clear();
    PathContext context;
    context.guided = &vertices;
    const Ray ray = frame_.ray(place, sample, sampler);
    const PathRecord path = tracer_.trace(ray, sampler, context);
    const float radiance = luminance(path.radiance);
    record->work += path.rays;
    if (!std::isfinite(radiance)) return 0;
    for (const GuidedVertex& v : vertices)
      record->samples.push_back({v.cell,
                                 v.bsdf_pdf,
                                 {both_ ? v.light_pdf : v.guide_pdf, v.guide_pdf},
                                 v.pdf,
                                 std::max(radiance - v.radiance_before, 0.0f)});
    return radiance;
  }

  const PathTracer& tracer_;
  const PilotFrame& frame_;
  bool both_;
};

}  // namespace

std::vector<CellChoice> learn_choices(const PathTracer& tracer, const PilotFrame& frame,
                                      size_t cells, const ChoicePilotOptions& options,
                                      const std::function<bool()>& stop) {
  const ChoicePilot pilot(tracer, frame, options);
  const double tiles_affordable = double(options.max_paths) / kSpp * frame.tiles() / frame.places();
  const FrameTurns turns(frame.tiles(), kTilesPerTurn, kMaxRounds, tiles_affordable);
  if (turns.count() == 0) return {};
  CellChoiceLearner learner(cells, options.guides, options.default_share);
  std::vector<TileRecord> records(kTilesPerTurn);
  for (int turn = 0; turn < turns.count() && (turn == 0 || !stop()); ++turn) {
    parallel_for(turns.tiles(turn), [&](size_t i) {
      pilot.trace_tile(turns.tile(turn, int(i)), turns.round(turn), &records[i]);
    });
    for (int i = 0; i < turns.tiles(turn); ++i) {
      for (const GuidedSample& sample : records[i].samples) learner.add(sample);
      if (options.priced) learner.add_paths(records[i].variance, records[i].work);
    }
  }
  return learner.choices();
}

}  // namespace waylight
