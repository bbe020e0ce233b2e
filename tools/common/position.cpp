#include "tools/common/position.h"

#include <charconv>

namespace waylight {

std::optional<Vec3> parse_position(const std::string& text) {
  Vec3 position;
  const char *at = text.data(), *end = at + text.size();
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0 && (at == end || *at++ != ',')) return std::nullopt;
    const auto [rest, error] = std::from_chars(at, end, position[axis]);
    if (error != std::errc() || !std::isfinite(position[axis])) return std::nullopt;
    at = rest;
  }
  return at == end ? std::optional(position) : std::nullopt;
}

}  // namespace waylight
