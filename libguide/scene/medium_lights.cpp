#include "libguide/scene/medium_lights.h"

#include <numeric>

#include "libguide/math/warp.h"
#include "libguide/scene/scene_check.h"

namespace waylight {
namespace {

constexpr int kMaxSide = 24;         // cells along an axis of a medium that varies
constexpr int kParts = 3;            // places along an axis at which a cell is looked at
constexpr float kEvenShare = 0.05f;  // of the cells' weights: what the places miss is found too

using Grid = std::shared_ptr<const VolumeGrid>;

const Grid* grid_of(const VolumeTexture& texture) { return std::get_if<Grid>(&texture); }

// The density grid of a medium, null without one.
const Grid* density_grid(const Medium& medium) {
  const auto* varying = std::get_if<HeterogeneousMedium>(&medium.coefficients);
  return varying ? grid_of(varying->density) : nullptr;
}

bool varies(const Medium& medium) {
  const auto* varying = std::get_if<HeterogeneousMedium>(&medium.coefficients);
  return grid_of(medium.emission.radiance) || density_grid(medium) ||
         (varying && grid_of(varying->albedo));
}

bool names(const Shape& shape, int medium) {
  return shape.interior_medium == medium || shape.exterior_medium == medium;
}

Mat4 box_of(const Bounds& bounds) {
  return bounds.empty() ? Mat4(Mat4::Zero()) : box_between(bounds.min, bounds.max);
}

Color emitted_at(const MediumTracker& medium, const Vec3& p) {
  const MediumCoefficients here = medium.at(p);
  return 4 * kPi * (1 - here.albedo) * here.sigma_t * medium.emitted_at(p);
}

}  // namespace

Bounds medium_bounds(const Scene& scene, int medium) {
  const SceneDescription& description = scene.description();
  for (const Shape& shape : description.group_shapes)
    if (names(shape, medium)) return scene.bounds();
  Bounds bounds;
  for (const Shape& shape : description.shapes)
    if (names(shape, medium)) bounds.extend(shape_bounds(shape));
  return bounds;
}

MediumLights::MediumLights(const Scene& scene) : scene_(scene) {
  for (int i = 0; i < static_cast<int>(scene.description().media.size()); ++i)
    if (scene.medium(i).emits()) add(i);
  std::vector<float> powers;
  for (const Region& region : regions_) powers.push_back(static_cast<float>(region.cells.total()));
  chosen_ = Discrete(powers);
}

void MediumLights::add(int medium) {
  const Medium& description = scene_.description().media[medium];
  const Grid* grid = density_grid(description);
  Region region{medium,
                grid ? (*grid)->grid_to_world : box_of(medium_bounds(scene_, medium)),
                0,
                Eigen::Vector3i::Constant(varies(description) ? kMaxSide : 1),
                {}};
  region.volume = std::abs(region.to_world.topLeftCorner<3, 3>().cast<double>().determinant());
  std::vector<float> weights(region.side.prod());
  for (int cell = 0; cell < static_cast<int>(weights.size()); ++cell) {
    const Color power = emitted(region, cell) * (region.volume / weights.size());
    weights[cell] = power.mean();
    luminance_ += luminance(power);
  }
  const float mean = std::accumulate(weights.begin(), weights.end(), 0.0) / weights.size();
  if (!(mean > 0) || !std::isfinite(mean)) return;
  for (float& weight : weights) weight = (1 - kEvenShare) * weight + kEvenShare * mean;
  region.cells = Discrete(weights);
  regions_.push_back(std::move(region));
}

// W/m^3, mean over places of a cell.
Color MediumLights::emitted(const Region& region, int cell) const {
  Color sum = Color::Zero();
  for (int z = 0; z < kParts; ++z)
    for (int y = 0; y < kParts; ++y)
      for (int x = 0; x < kParts; ++x)
        sum += emitted_at(scene_.medium(region.medium),
                          region.place(cell, (Vec3(x, y, z).array() + 0.5f) / kParts));
  return sum / (kParts * kParts * kParts);
}

// inside: of the cell, in the unit cube.
Vec3 MediumLights::Region::place(int cell, const Vec3& inside) const {
  const Eigen::Vector3i index(cell % side.x(), cell / side.x() % side.y(),
                              cell / (side.x() * side.y()));
  const Vec3 unit = (index.cast<float>() + inside).cwiseQuotient(side.cast<float>());
  return (to_world * unit.homogeneous()).head<3>();
}

std::optional<MediumLights::Sample> MediumLights::sample(Sampler& sampler) const {
  if (chosen_.empty()) return std::nullopt;
  const Discrete::Sample chosen = chosen_.sample(sampler.next());
  const Region& region = regions_[chosen.index];
  const Discrete::Sample cell = region.cells.sample(sampler.next());
  const Vec2 u = sampler.next_2d();
  const Vec3 p = region.place(cell.index, {u.x(), u.y(), sampler.next()});
  const Vec3 direction = square_to_sphere(sampler.next_2d());
  if (scene_.medium_at(p) != region.medium) return std::nullopt;
  const double volume = region.volume / region.cells.size();
  const Color power = emitted_at(scene_.medium(region.medium), p) *
                      static_cast<float>(volume / (double(chosen.prob) * cell.prob));
  return Sample{{p, direction}, power, region.medium};
}

}  // namespace waylight
