#include "libguide/cache/medium_cache_view.h"

#include <fmt/format.h>

#include <algorithm>

#include "libguide/directional/focused_mixture.h"
#include "libguide/directional/mixture_check.h"
#include "libguide/math/finite.h"
#include "libguide/spatial/tree_check.h"

namespace waylight {
namespace {

std::string check_light(const MediumLight& light, std::span<const VmfComponent> components) {
  if (!finite_and_not_negative({light.fluence, light.photon_count, light.effective_samples}))
    return "a statistic is negative or not finite";
  if (uint64_t{light.first_component} + light.component_count > components.size())
    return fmt::format("components end past the last of {}", components.size());
  return check_mixture(components.subspan(light.first_component, light.component_count));
}

std::string check_focused(const MediumCacheView& view) {
  for (size_t i = 0; i < view.focused_cells.size(); ++i) {
    const FocusedCell& f = view.focused_cells[i];
    if (f.cell >= view.cells.size())
      return fmt::format("there is no cell {} to be focused", f.cell);
    if (i > 0 && f.cell <= view.focused_cells[i - 1].cell) return "focused cells out of order";
    if (f.lobe_count < 1 || f.lobe_count > FocusedMixture::kMaxLobes)
      return fmt::format("cell {}: {} focused lobes", f.cell, f.lobe_count);
    if (uint64_t{f.first_lobe} + f.lobe_count > view.focused_lobes.size())
      return fmt::format("focused lobes end past the last of {}", view.focused_lobes.size());
  }
  const auto bad = std::ranges::find_if_not(view.focused_lobes, is_focused_lobe);
  if (bad == view.focused_lobes.end()) return {};
  return fmt::format("focused lobe {} is none", bad - view.focused_lobes.begin());
}

}  // namespace

std::span<const FocusedLobe> MediumCacheView::focused(uint32_t cell) const {
  const auto found = std::ranges::lower_bound(focused_cells, cell, {}, &FocusedCell::cell);
  if (found == focused_cells.end() || found->cell != cell) return {};
  return focused_lobes.subspan(found->first_lobe, found->lobe_count);
}

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
  return check_focused(view);
}

}  // namespace waylight
