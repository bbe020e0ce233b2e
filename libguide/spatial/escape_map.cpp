#include "libguide/spatial/escape_map.h"

#include "libguide/math/frame.h"
#include "libguide/math/warp.h"

namespace waylight {
namespace {

uint32_t cell_of(const Vec2& square, uint32_t cells) {
  const auto axis = [cells](float x) {
    return static_cast<uint32_t>(std::clamp(static_cast<int>(x * cells), 0, int(cells) - 1));
  };
  return axis(square.y()) * cells + axis(square.x());
}

}  // namespace

EscapeMap::EscapeMap(const Bounds& scene) {
  if (scene.empty()) return;
  center_ = scene.center();
  radius_ = scene.radius() * kSceneMargin;
}

uint32_t EscapeMap::bin(const Vec3& to_light) {
  const Vec3 upper(to_light.x(), to_light.y(), std::abs(to_light.z()));
  const Vec2 square = disk_to_square(direction_to_disk(upper));
  return cell_of(square, kDirections) + (to_light.z() < 0 ? kBins / 2 : 0);
}

Vec2 EscapeMap::position(const Vec3& origin, const Vec3& to_light) const {
  if (!(radius_ > 0)) return {0.5f, 0.5f};
  const Frame frame(Vec3(-to_light));
  const Vec3 from_center = (origin - center_) / radius_;
  Vec2 disk(from_center.dot(frame.s), from_center.dot(frame.t));
  disk /= std::max(1.0f, disk.norm());
  return disk_to_square(disk).cwiseMax(0.0f).cwiseMin(kOneMinusEpsilon);
}

uint32_t EscapeMap::cell(const Vec2& position) { return cell_of(position, kPositions); }

}  // namespace waylight
