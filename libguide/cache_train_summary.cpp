#include <algorithm>

#include "libguide/cache_train.h"

namespace waylight {

void MediumLightSummary::add(const MediumLight& light) {
  if (light.component_count == 0) return;
  const double n = static_cast<double>(++cells_with_mixture);
  mean_components += (light.component_count - mean_components) / n;
  mean_effective_samples += (light.effective_samples - mean_effective_samples) / n;
}

void CacheTrainSummary::count_cells(const GuideCache& cache) {
  cells = cache.cells.size();
  for (const CacheCell& cell : cache.cells) {
    if (cell.component_count == 0) continue;
    const double n = static_cast<double>(++cells_with_mixture);
    mean_components += (cell.component_count - mean_components) / n;
    mean_effective_samples += (cell.effective_samples - mean_effective_samples) / n;
    lost_mass += (std::max(0.0f, 1 - cell.guided_mass) - lost_mass) / n;
  }
  media.cells = cache.medium.cells.size();
  media.cells_with_focus = cache.medium.focused_cells.size();
  for (const MediumCell& cell : cache.medium.cells) {
    media.indirect.add(cell.indirect);
    media.direct.add(cell.direct);
  }
}

}  // namespace waylight
