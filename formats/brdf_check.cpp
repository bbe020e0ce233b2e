#include "formats/brdf_check.h"

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "libguide/directional/mixture_check.h"

namespace waylight {
namespace {

std::string check_entry(const BrdfCacheEntry& entry,
                        std::span<const GaussianComponent> components) {
  if (uint64_t{entry.first_component} + entry.component_count > components.size())
    return fmt::format("components end past the last of {}", components.size());
  if (!(entry.held_out_error >= 0 && entry.held_out_error <= 2.001f))
    return fmt::format("held-out error {} is not in 0..2", entry.held_out_error);
  return check_mixture(components.subspan(entry.first_component, entry.component_count));
}

}  // namespace

std::string check(const BrdfCache& cache) {
  for (const MaterialFit& fit : cache.materials) {
    if (fit.entry_count == 0) return fmt::format("material \"{}\": no entry", fit.name);
    if (uint64_t{fit.first_entry} + fit.entry_count > cache.entries.size())
      return fmt::format("material \"{}\": entries end past the last of {}", fit.name,
                         cache.entries.size());
  }
  for (size_t i = 0; i < cache.entries.size(); ++i)
    if (const std::string fault = check_entry(cache.entries[i], cache.components); !fault.empty())
      return fmt::format("entry {}: {}", i, fault);
  return {};
}

}  // namespace waylight
