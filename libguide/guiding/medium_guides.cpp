#include "libguide/guiding/medium_guides.h"

#include "libguide/base/parallel.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/directional/vmf_product.h"
#include "libguide/medium/phase.h"

namespace waylight {
namespace {

// int p^2 dw of the density.
float concentration(const VmfMixture& p) { return VmfProduct(p, p).z(); }

float narrowness(const PhaseLobes& phase, const VmfMixture& light) {
  const float of_phase = concentration(phase.about(Vec3::UnitZ()));
  return of_phase / (of_phase + concentration(light));
}

}  // namespace

MediumGuide::MediumGuide(const MediumCacheView& cache, uint32_t index, const PhaseLobes& phase)
    : indirect_(cache.lobes(cache.cells[index].indirect)),
      direct_(cache.lobes(cache.cells[index].direct)),
      scattered_indirect_(indirect_, phase) {
  const MediumCell& cell = cache.cells[index];
  indirect_fluence_ = cell.indirect.fluence;
  direct_fluence_ = direct_.count() > 0 ? cell.direct.fluence : 0;
  const float samples = cell.indirect.effective_samples;
  known_ = indirect_.count() > 0 && indirect_fluence_ > 0 && samples >= kMinEffectiveSamples;
  trust_ = samples / (samples + kHalfTrustSamples);
  phase_narrowness_ = narrowness(phase, indirect_);
  if (const auto lobes = cache.focused(index); !lobes.empty()) focused_.emplace(lobes);
}

std::vector<float> MediumGuide::scattered(const PhaseLobes& phase,
                                          const ScatteredBins& bins) const {
  const VmfConvolution direct(direct_, phase);
  std::vector<float> radiance(bins.count());
  for (int i = 0; i < bins.count(); ++i) {
    const Vec3 w = bins.centre(i);
    radiance[i] = known_ ? scattered_indirect(w) + direct_fluence_ * direct.pdf(w) : -1;
  }
  return radiance;
}

MediumGuides::PhaseGuides::PhaseGuides(const MediumCacheView& cache, float mean_cosine)
    : lobes(phase_lobes(mean_cosine)), bins(mean_cosine) {
  guides.reserve(cache.cells.size());
  for (uint32_t i = 0; i < cache.cells.size(); ++i) guides.emplace_back(cache, i, lobes);
}

MediumGuides::MediumGuides(const MediumCacheView& cache, std::span<const Medium> media)
    : finder_(cache.nodes) {
  std::vector<float> cosines;
  for (const Medium& medium : media) {
    const float g = mean_cosine(medium.phase);
    const auto known = std::find(cosines.begin(), cosines.end(), g);
    phase_of_medium_.push_back(static_cast<int>(known - cosines.begin()));
    if (known != cosines.end()) continue;
    cosines.push_back(g);
    phases_.emplace_back(cache, g);
  }
  if (phases_.empty() || cache.nodes.empty()) return;
  FlightCells cells = merge_for_flights(cache.nodes, scattered_light());
  flight_nodes_ = std::move(cells.nodes);
  set_tables(cells.light);
}

// Of each cell, the tables of all phases one after the other.
std::vector<ScatteredLight> MediumGuides::scattered_light() const {
  std::vector<ScatteredLight> light(phases_.front().guides.size());
  parallel_for(light.size(), [&](size_t i) {
    light[i].direct_share = phases_.front().guides[i].direct_share();
    for (const PhaseGuides& phase : phases_) {
      const std::vector<float> table = phase.guides[i].scattered(phase.lobes, phase.bins);
      light[i].radiance.insert(light[i].radiance.end(), table.begin(), table.end());
    }
  });
  return light;
}

void MediumGuides::set_tables(const std::vector<ScatteredLight>& light) {
  for (const ScatteredLight& cell : light) direct_shares_.push_back(cell.direct_share);
  size_t first = 0;
  for (PhaseGuides& phase : phases_) {
    for (int bin = 0; bin < phase.bins.count(); ++bin)
      for (const ScatteredLight& cell : light)
        phase.scattered.push_back(cell.radiance[first + bin]);
    first += phase.bins.count();
  }
}

}  // namespace waylight
