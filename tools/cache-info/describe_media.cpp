#include "tools/cache-info/describe_media.h"

#include "libguide/cache/guide_cache_view.h"
#include "tools/cache-info/range.h"

namespace waylight {
namespace {

using Json = nlohmann::ordered_json;

// What guiding needs, in the file and in memory alike; training has more.
double guide_bytes(const MediumCache& medium) {
  return double(medium.nodes.size() * sizeof(CacheNode) + medium.cells.size() * sizeof(MediumCell) +
                medium.components.size() * sizeof(VmfComponent) +
                medium.focused_cells.size() * sizeof(FocusedCell) +
                medium.focused_lobes.size() * sizeof(FocusedLobe));
}

Json describe_light(const MediumCache& medium, MediumLight MediumCell::*light) {
  uint64_t with_mixture = 0, usable = 0;
  Range fluence, lobes, concentration, effective, photons;
  for (const MediumCell& cell : medium.cells) {
    const MediumLight& l = cell.*light;
    fluence.add(l.fluence);
    if (l.component_count == 0) continue;
    ++with_mixture;
    usable += l.effective_samples >= kMinEffectiveSamples;
    lobes.add(l.component_count);
    effective.add(l.effective_samples);
    photons.add(l.photon_count);
    for (uint32_t k = 0; k < l.component_count; ++k)
      concentration.add(medium.components[l.first_component + k].kappa);
  }
  return {{"cells_with_mixture", with_mixture},
          {"cells_that_guide", usable},
          {"lobes", lobes.json()},
          {"concentration", concentration.json()},
          {"effective_samples", effective.json()},
          {"photons_per_cell", photons.json()},
          {"fluence", fluence.json()}};
}

Json describe_training(const MediumCache& medium) {
  if (medium.training.empty()) return "dropped: training cannot go on";
  Range indirect, direct;
  for (const MediumTraining& t : medium.training)
    indirect.add(t.indirect.step), direct.add(t.direct.step);
  return {{"indirect_steps", indirect.json()}, {"direct_steps", direct.json()}};
}

}  // namespace

Json describe_media(const MediumCache& medium) {
  const Json head = {{"particles", medium.emitted},
                     {"photons", medium.photons},
                     {"cells", medium.cells.size()},
                     {"cells_with_focus", medium.focused_cells.size()},
                     {"bytes_per_cell", guide_bytes(medium) / double(medium.cells.size())}};
  return {{"tree", head},
          {"indirect", describe_light(medium, &MediumCell::indirect)},
          {"direct", describe_light(medium, &MediumCell::direct)},
          {"training", describe_training(medium)}};
}

}  // namespace waylight
