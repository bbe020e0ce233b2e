#include "libguide/transport/pilot_frame.h"

#include <cmath>

namespace waylight {
namespace {

constexpr double kPlaces = 16384;
constexpr uint64_t kPilotStream = 0x70696c6f74;  // apart from the numbers of the render
constexpr uint64_t kWhereStream = 0x7768657265;  // apart from those of the paths

}  // namespace

PilotFrame::PilotFrame(const SensorDescription& sensor, uint64_t seed)
    : camera_(sensor), seed_(hash_combine(seed, kPilotStream)) {
  const double pixels = double(camera_.width()) * camera_.height();
  const double scale = std::min(1.0, std::sqrt(kPlaces / pixels));
  columns_ = std::max(1, static_cast<int>(camera_.width() * scale));
  rows_ = std::max(1, static_cast<int>(camera_.height() * scale));
  tiles_x_ = (columns_ + kTile - 1) / kTile;
}

Sampler PilotFrame::sampler(int place, int round, int sample) const {
  return {hash_combine(seed_, uint64_t(round) << 32 | uint32_t(sample)), uint64_t(place), 0};
}

Ray PilotFrame::ray(int place, int round, Sampler& sampler) const {
  Sampler where(hash_combine(seed_ ^ kWhereStream, uint64_t(round)), uint64_t(place), 0);
  const Vec2 cell = Vec2(place % columns_, place / columns_) + where.next_2d();
  const Vec2 pixel = (cell.array() / Vec2(columns_, rows_).array() *
                      Vec2(camera_.width(), camera_.height()).array())
                         .floor();
  const Vec2 position = pixel + sampler.next_2d();
  return camera_.ray(position, sampler.next_2d());
}

}  // namespace waylight
