#include <fmt/format.h>

#include "tools/common/cli.h"

namespace waylight {
namespace {

std::string with_prefix(double value, const char* unit) {
  static constexpr const char* kPrefixes[] = {"", "k", "M", "G", "T"};
  int i = 0;
  for (; std::abs(value) >= 999.5 && i < 4; ++i) value /= 1000;
  const int digits = i == 0 || std::abs(value) >= 99.95 ? 0 : std::abs(value) >= 9.995 ? 1 : 2;
  const char* gap = i > 0 || *unit ? " " : "";
  return fmt::format("{:.{}f}{}{}{}", value, digits, gap, kPrefixes[i], unit);
}

}  // namespace

std::string format_bytes(double bytes) { return with_prefix(bytes, "B"); }
std::string format_count(double count) { return with_prefix(count, ""); }

}  // namespace waylight
