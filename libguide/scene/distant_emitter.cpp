#include "libguide/scene/distant_emitter.h"

#include "libguide/math/frame.h"
#include "libguide/math/warp.h"
#include "libguide/scene/cone.h"
#include "libguide/scene/delta_emitter.h"

namespace waylight {
namespace {

// What enters the scene from where a light sample points.
std::optional<EmissionSample> enter_from(const std::optional<LightSample>& sample,
                                         const SceneSphere& sphere, const Vec2& u_position) {
  if (!sample) return std::nullopt;
  return EmissionSample{enter_scene(sphere, -sample->wi, u_position),
                        sample->radiance * (sphere.cross_section() / sample->pdf)};
}

}  // namespace

std::optional<LightSample> ConstantEmitter::sample(const Vec3& /*from*/, float /*u*/,
                                                   const Vec2& u2) const {
  return LightSample{square_to_sphere(u2), kInfinity, light.radiance, kSpherePdf};
}

float ConstantEmitter::pdf(const Vec3& /*direction*/) const { return kSpherePdf; }

std::optional<EmissionSample> ConstantEmitter::emit(float u, const Vec2& u_position,
                                                    const Vec2& u_direction) const {
  return enter_from(sample(sphere.center, u, u_direction), sphere, u_position);
}

MapEmitter::MapEmitter(const EnvironmentMap& map, const SceneSphere& sphere)
    : bitmap_(map.bitmap), scale_(map.scale), to_world_(map.to_world), sphere_(sphere) {
  const bool at_poles = map.rows_at_poles && bitmap_->height > 1;
  row_scale_ = (at_poles ? bitmap_->height - 1 : bitmap_->height) / std::numbers::pi;
  row_offset_ = at_poles ? 1 : 0.5;
  std::vector<float> weights;
  weights.reserve(static_cast<size_t>(bitmap_->width) * (bitmap_->height + 1));
  for (int row = 0; row <= bitmap_->height; ++row)
    for (int column = 0; column < bitmap_->width; ++column)
      weights.push_back(cell_mean(column, row).mean() * cell_solid_angle(row));
  cells_ = PiecewiseConstant2d(weights, bitmap_->width, bitmap_->height + 1);
  power_ = cells_.total() * scale_ * sphere_.cross_section();
}

const Color& MapEmitter::pixel(int column, int row) const {
  return bitmap_->at(column == bitmap_->width ? 0 : column,
                     std::clamp(row, 0, bitmap_->height - 1));
}

Color MapEmitter::cell_mean(int column, int row) const {
  return 0.25f * (pixel(column, row - 1) + pixel(column + 1, row - 1) + pixel(column, row) +
                  pixel(column + 1, row));
}

double MapEmitter::row_edge(int row) const {
  return std::clamp((row - row_offset_) / row_scale_, 0.0, std::numbers::pi);
}

// Delta phi (cos a - cos b), the difference as a product to keep its digits at the poles.
float MapEmitter::cell_solid_angle(int row) const {
  const double a = row_edge(row), b = row_edge(row + 1);
  const double cosines = 2 * std::sin(0.5 * (a + b)) * std::sin(0.5 * (b - a));
  return static_cast<float>(2 * std::numbers::pi / bitmap_->width * cosines);
}

MapEmitter::Place MapEmitter::locate(const Vec3& direction) const {
  const Vec3 w = to_world_.transpose() * direction;
  const float turn = std::atan2(w.x(), -w.z()) / (2 * kPi);
  const float polar = std::atan2(std::hypot(w.x(), w.z()), w.y());
  const float x = (turn < 0 ? turn + 1 : turn) * bitmap_->width - 0.5f;
  const float y = static_cast<float>(polar * row_scale_ + row_offset_);
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(y);
  const int wrapped = column < 0 ? bitmap_->width - 1 : std::min(column, bitmap_->width - 1);
  const int first = static_cast<int>(row_offset_);  // that has height
  return {wrapped, std::clamp(row, first, bitmap_->height - first), x - column, y - row};
}

Color MapEmitter::radiance(const Vec3& direction) const { return radiance(locate(direction)); }

Color MapEmitter::radiance(const Place& at) const {
  const Color top =
      (1 - at.x) * pixel(at.column, at.row - 1) + at.x * pixel(at.column + 1, at.row - 1);
  const Color bottom = (1 - at.x) * pixel(at.column, at.row) + at.x * pixel(at.column + 1, at.row);
  return scale_ * ((1 - at.y) * top + at.y * bottom);
}

float MapEmitter::pdf(const Vec3& direction) const { return pdf(locate(direction)); }

float MapEmitter::pdf(const Place& at) const {
  return cells_.cell_prob(at.column, at.row) / cell_solid_angle(at.row);
}

std::optional<LightSample> MapEmitter::sample(const Vec3& /*from*/, float /*u*/,
                                              const Vec2& u2) const {
  const PiecewiseConstant2d::Sample cell = cells_.sample(u2);
  const double phi = 2 * std::numbers::pi * (cell.column + 0.5 + cell.inside.x()) / bitmap_->width;
  const double first = std::cos(row_edge(cell.row)), last = std::cos(row_edge(cell.row + 1));
  const double cosine = first + cell.inside.y() * (last - first);
  const double sine = std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
  const Vec3 local(static_cast<float>(std::sin(phi) * sine), static_cast<float>(cosine),
                   static_cast<float>(-std::cos(phi) * sine));
  const Vec3 wi = (to_world_ * local).normalized();
  const Place at = locate(wi);  // in the cell that rounding puts it in
  const float density = pdf(at);
  if (density <= 0) return std::nullopt;
  return LightSample{wi, kInfinity, radiance(at), density};
}

std::optional<EmissionSample> MapEmitter::emit(float u, const Vec2& u_position,
                                               const Vec2& u_direction) const {
  return enter_from(sample(sphere_.center, u, u_direction), sphere_, u_position);
}

Color DiskEmitter::radiance(const Vec3& direction) const {
  const bool inside = inside_cone_of_height(direction, light.to_light, height());
  return inside ? light.radiance : Color(Color::Zero());
}

std::optional<LightSample> DiskEmitter::sample(const Vec3& /*from*/, float /*u*/,
                                               const Vec2& u2) const {
  const Vec3 local = square_to_cone_of_height(u2, height());
  const Vec3 wi = Frame(light.to_light).to_world(local).normalized();
  return LightSample{wi, kInfinity, light.radiance, cone_of_height_pdf(height())};
}

float DiskEmitter::pdf(const Vec3& direction) const {
  const bool inside = inside_cone_of_height(direction, light.to_light, height());
  return inside ? cone_of_height_pdf(height()) : 0.0f;
}

std::optional<EmissionSample> DiskEmitter::emit(float u, const Vec2& u_position,
                                                const Vec2& u_direction) const {
  return enter_from(sample(sphere.center, u, u_direction), sphere, u_position);
}

}  // namespace waylight
