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

std::string check_series(uint32_t first, uint32_t count, size_t entries) {
  if (count == 0) return "no entry";
  if (uint64_t{first} + count > entries)
    return fmt::format("entries end past the last of {}", entries);
  return {};
}

std::string check_fit(const MaterialFit& fit, size_t entries) {
  if (fit.layout > EntryLayout::fibonacci)
    return fmt::format("layout {} is unknown", static_cast<int>(fit.layout));
  std::string fault = check_series(fit.first_entry, fit.entry_count, entries);
  float last = 0;
  uint64_t sum = 0;
  for (size_t i = 0; i < fit.widths.size() && fault.empty(); ++i) {
    const WidthSeries& s = fit.widths[i];
    if (!(s.width > last && std::isfinite(s.width))) return "widths do not ascend";
    last = s.width;
    fault = check_series(s.first_entry, s.entry_count, entries);
    sum += s.entry_count;
  }
  if (fault.empty() && sum > entries) return "its widths share entries";
  return fault;
}

}  // namespace

std::string check(const BrdfCache& cache) {
  for (const MaterialFit& fit : cache.materials)
    if (const std::string fault = check_fit(fit, cache.entries.size()); !fault.empty())
      return fmt::format("material \"{}\": {}", fit.name, fault);
  for (size_t i = 0; i < cache.entries.size(); ++i)
    if (const std::string fault = check_entry(cache.entries[i], cache.components); !fault.empty())
      return fmt::format("entry {}: {}", i, fault);
  return {};
}

}  // namespace waylight
