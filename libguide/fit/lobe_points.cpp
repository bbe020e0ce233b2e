#include "libguide/fit/lobe_points.h"

namespace waylight {
std::vector<UnitPoint> unit_points(uint64_t seed, uint64_t stream, int count) {
  std::vector<UnitPoint> points(count);
  for (int i = 0; i < count; ++i) {
    Sampler sampler(seed, stream, i);
    points[i].u = sampler.next();
    points[i].u2 = sampler.next_2d();
  }
  return points;
}

std::optional<LobePoint> sample_lobe(const LobeTarget& target, const UnitPoint& u) {
  const std::optional<LobeTarget::Sample> s = target.sample_value(u.u, u.u2);
  if (!s) return std::nullopt;
  if (!std::isfinite(s->value.f) || !std::isfinite(s->value.pdf)) return std::nullopt;
  return LobePoint{direction_to_disk(s->wi), s->value.f, s->value.pdf};
}

LobePoint evaluate_lobe(const LobeTarget& target, const Vec2& y) {
  const LobeTarget::Value at = target.evaluate(disk_to_direction(y));
  const bool finite = std::isfinite(at.f) && std::isfinite(at.pdf);
  return finite ? LobePoint{y, at.f, at.pdf} : LobePoint{y, 0, 0};
}

std::vector<LobeRow> lobe_rows(std::span<const LobePoint> points, int drawn) {
  double integral = 0;  // of f over the disk
  for (const LobePoint& p : points) integral += p.f / (kSteradianPerDiskArea * p.pdf);
  if (!(integral > 0)) return {};
  const double normalise = drawn / integral;
  std::vector<LobeRow> rows((points.size() + kLanes - 1) / kLanes);
  for (size_t i = 0; i < points.size(); ++i) {
    LobeRow& row = rows[i / kLanes];
    row.x[i % kLanes] = points[i].y.x(), row.y[i % kLanes] = points[i].y.y();
    row.target[i % kLanes] = static_cast<float>(points[i].f * normalise);
    row.area[i % kLanes] = 1 / (drawn * kSteradianPerDiskArea * points[i].pdf);
  }
  return rows;
}

}  // namespace waylight
