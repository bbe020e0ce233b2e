#include "libguide/guiding/medium_guides.h"

#include "libguide/base/parallel.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/medium/phase.h"

namespace waylight {

MediumGuide::MediumGuide(const MediumCacheView& cache, const MediumCell& cell,
                         const PhaseLobes& phase)
    : indirect_(cache.lobes(cell.indirect)),
      direct_(cache.lobes(cell.direct)),
      scattered_indirect_(indirect_, phase),
      indirect_fluence_(cell.indirect.fluence),
      direct_fluence_(direct_.count() > 0 ? cell.direct.fluence : 0),
      known_(indirect_.count() > 0 && cell.indirect.fluence > 0 &&
             cell.indirect.effective_samples >= kMinEffectiveSamples),
      trust_(cell.indirect.effective_samples /
             (cell.indirect.effective_samples + kHalfTrustSamples)) {}

std::array<float, ScatteredBins::kCount> MediumGuide::scattered(const PhaseLobes& phase) const {
  const VmfConvolution direct(direct_, phase);
  std::array<float, ScatteredBins::kCount> radiance;
  for (int i = 0; i < ScatteredBins::kCount; ++i) {
    const Vec3 w = ScatteredBins::centre(i);
    radiance[i] = known_ ? scattered_indirect(w) + direct_fluence_ * direct.pdf(w) : -1;
  }
  return radiance;
}

MediumGuides::MediumGuides(const MediumCacheView& cache, std::span<const Medium> media)
    : nodes_(cache.nodes), cells_(cache.cells.size()) {
  std::vector<float> cosines;
  for (const Medium& medium : media) {
    const float g = mean_cosine(medium.phase);
    const auto known = std::find(cosines.begin(), cosines.end(), g);
    phase_of_medium_.push_back(static_cast<int>(known - cosines.begin()));
    if (known != cosines.end()) continue;
    cosines.push_back(g);
    phases_.push_back(phase_lobes(g));
  }
  guides_.reserve(cells_ * phases_.size());
  for (const PhaseLobes& phase : phases_)
    for (const MediumCell& cell : cache.cells) guides_.emplace_back(cache, cell, phase);
  scattered_.resize(guides_.size() * ScatteredBins::kCount);
  parallel_for(guides_.size(), [&](size_t i) {
    const auto radiance = guides_[i].scattered(phases_[i / cells_]);
    for (int bin = 0; bin < ScatteredBins::kCount; ++bin)
      scattered_[bin * guides_.size() + i] = radiance[bin];
  });
}

}  // namespace waylight
