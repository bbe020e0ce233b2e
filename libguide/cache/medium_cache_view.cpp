#include "libguide/cache/medium_cache_view.h"

#include <fmt/format.h>

#include <cmath>

#include "libguide/directional/mixture_check.h"
#include "libguide/spatial/tree_check.h"

namespace waylight {
namespace {

bool finite_and_not_negative(float v) { return std::isfinite(v) && v >= 0; }

std::string check_light(const MediumLight& light, std::span<const VmfComponent> components) {
  for (const float v : {light.fluence, light.photon_count, light.effective_samples})
    if (!finite_and_not_negative(v)) return "a statistic is negative or not finite";
  if (uint64_t{light.first_component} + light.component_count > components.size())
    return fmt::format("components end past the last of {}", components.size());
  return check_mixture(components.subspan(light.first_component, light.component_count));
}

}  // namespace

std::string check(const MediumCacheView& view) {
  if (std::string fault = check_tree(view.nodes, view.cells.size()); !fault.empty()) return fault;
  for (size_t i = 0; i < view.nodes.size(); ++i)
    if (view.nodes[i].axis != kLeafAxis && view.nodes[i].axis >= kNormalAxis)
      return fmt::format("node {}: media have no axis {}", i, view.nodes[i].axis);
  for (size_t i = 0; i < view.cells.size(); ++i)
    for (const MediumLight* light : {&view.cells[i].indirect, &view.cells[i].direct})
      if (const std::string fault = check_light(*light, view.components); !fault.empty())
        return fmt::format("cell {}: {} light: {}", i,
                           light == &view.cells[i].direct ? "direct" : "indirect", fault);
  return {};
}

}  // namespace waylight
