#include "libguide/guiding/emission_guide.h"

#include <numeric>

#include "libguide/math/frame.h"
#include "libguide/math/warp.h"

namespace waylight {
namespace {

const Vec2 kCentre(0.5f, 0.5f);

// Of a mesh, slices of u are about its triangles: large ones are cut into many cells.
struct Grid {
  int slices = 1, side = 1;
  int cells() const { return slices * side * side; }
};

constexpr Grid kDistantGrid{1, 64};
constexpr int kMaxSlices = 4096;

Grid area_grid(const Shape& shape) {
  const TriangleMesh* mesh = std::get_if<TriangleMesh>(&shape.geometry);
  if (!mesh) return {1, 32};
  const int slices = std::clamp(static_cast<int>(mesh->triangles.size()), 1, kMaxSlices);
  return {slices, slices <= 16 ? 16 : slices <= 256 ? 4 : 1};
}

constexpr int kParts = 2;  // along each axis of a cell, where it is looked at

}  // namespace

EmissionGuide::EmissionGuide(const Scene& scene, const GuideCacheView& importance)
    : scene_(scene), importance_(importance), escapes_(importance) {
  const std::vector<EmitterDescription>& emitters = scene.description().emitters;
  sources_.resize(emitters.size());
  contributions_.resize(emitters.size());
  for (int i = 0; i < static_cast<int>(emitters.size()); ++i) {
    if (!(scene.emission_prob(i) > 0)) continue;
    emitted_power_ += mean_power(i);
    if (std::holds_alternative<AreaLight>(emitters[i]))
      add_area(i);
    else if (!std::holds_alternative<PointLight>(emitters[i]) &&
             !std::holds_alternative<SpotLight>(emitters[i]))
      add_distant(i);
  }
  choose();
}

// Contribution int Le E_W dA with E_W the cells' int W cos: the power of a sample is pi Le / pdf.
void EmissionGuide::add_area(int emitter) {
  const AreaLight& light = std::get<AreaLight>(scene_.description().emitters[emitter]);
  const Grid grid = area_grid(scene_.description().shapes[light.shape]);
  std::vector<float> weights(grid.cells());
  for (int cell = 0; cell < grid.cells(); ++cell)
    for (int part = 0; part < kParts * kParts; ++part)
      weights[cell] +=
          importance_at(emitter, PrimaryTable::middle(cell, grid.slices, grid.side, part, kParts));
  sources_[emitter] = {Kind::area, PrimaryTable(weights, grid.slices, grid.side)};
  contributions_[emitter] =
      std::accumulate(weights.begin(), weights.end(), 0.0) / (grid.cells() * kParts * kParts);
}

float EmissionGuide::importance_at(int emitter, const PrimaryTable::Point& at) const {
  const auto along_normal = scene_.emit(emitter, at.u, at.v, kCentre);
  if (!along_normal) return 0;
  const Ray& ray = along_normal->ray;
  const CacheCell* cell = importance_.query(ray.origin, ray.direction);
  return cell ? cell->irradiance * luminance(along_normal->power) * kInvPi : 0;
}

// Contribution int int Le W dA dw: the power of a sample is Le A / pdf.
void EmissionGuide::add_distant(int emitter) {
  const int cells = kDistantGrid.cells(), parts = kParts * kParts;
  std::vector<float> weights(cells);
  for (int i = 0; i < cells * parts; ++i) {
    const Vec2 v = PrimaryTable::middle(i / parts, 1, kDistantGrid.side, i % parts, kParts).v;
    const auto emission = scene_.emit(emitter, 0.5f, kCentre, v);
    if (emission)
      weights[i / parts] +=
          luminance(emission->power) * escapes_.importance(-emission->ray.direction);
  }
  sources_[emitter] = {Kind::distant, PrimaryTable(weights, 1, kDistantGrid.side)};
  contributions_[emitter] = std::accumulate(weights.begin(), weights.end(), 0.0) / (cells * parts);
}

// Over a grid in u and position, or in direction: power depends on no more than these.
double EmissionGuide::mean_power(int emitter) const {
  constexpr int kSide = 16;
  double sum = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const PrimaryTable::Point at = PrimaryTable::middle(i, 1, kSide, 0, 1);
    const float u = (i + 0.5f) / (kSide * kSide);
    const auto emission = scene_.emit(emitter, u, at.v, at.v);
    if (emission) sum += luminance(emission->power);
  }
  return sum / (kSide * kSide);
}

void EmissionGuide::choose() {
  const double known = std::accumulate(contributions_.begin(), contributions_.end(), 0.0);
  std::vector<float> plain(sources_.size()), guided(sources_.size());
  double unknown_prob = 0;
  for (size_t i = 0; i < sources_.size(); ++i) {
    plain[i] = scene_.emission_prob(static_cast<int>(i));
    if (sources_[i].kind == Kind::unknown) unknown_prob += guided[i] = plain[i];
  }
  plain_ = Discrete(plain);
  if (!(known > 0) || !std::isfinite(known)) return;
  for (size_t i = 0; i < sources_.size(); ++i)
    if (sources_[i].kind != Kind::unknown)
      guided[i] = static_cast<float>((1 - unknown_prob) * contributions_[i] / known);
  guided_ = Discrete(guided);
  expected_image_ = known / std::max(1 - unknown_prob, 1e-6);
}

std::optional<EmissionSample> EmissionGuide::sample(Sampler& sampler) const {
  if (plain_.empty()) return std::nullopt;
  const bool guided = sampler.next() >= kPlainShare && !guided_.empty();
  const Discrete::Sample chosen = (guided ? guided_ : plain_).sample(sampler.next());
  Primary at;
  at.u = chosen.u;
  at.u_table = sampler.next();
  at.u_lobe = sampler.next();
  at.position = sampler.next_2d();
  at.direction = sampler.next_2d();
  float ratio = 1;
  std::optional<EmissionSample> emission = emit(chosen.index, at, guided, &ratio);
  if (!emission) return std::nullopt;
  emission->emitter = chosen.index;
  const float plain = plain_.prob(chosen.index);
  const float density =
      guided_.empty()
          ? plain
          : kPlainShare * plain + (1 - kPlainShare) * guided_.prob(chosen.index) * ratio;
  emission->power /= density;
  return emission;
}

// ratio: of the guided density of the random numbers to the plain one, which is 1.
std::optional<EmissionSample> EmissionGuide::emit(int emitter, Primary at, bool guided,
                                                  float* ratio) const {
  switch (sources_[emitter].kind) {
    case Kind::area:
      return emit_area(emitter, at, guided, ratio);
    case Kind::distant:
      return emit_distant(emitter, at, guided, ratio);
    case Kind::unknown:
      break;
  }
  return scene_.emit(emitter, at.u, at.position, at.direction);
}

// The power does not depend on the direction: radiance is constant over it, plain emission follows
// the cosine.
std::optional<EmissionSample> EmissionGuide::emit_area(int emitter, Primary at, bool guided,
                                                       float* ratio) const {
  const PrimaryTable& table = sources_[emitter].table;
  PrimaryTable::Point place{at.u, at.position};
  if (guided) place = table.sample(at.u_table, at.position);
  *ratio = table.pdf(place);
  const auto along_normal = scene_.emit(emitter, place.u, place.v, kCentre);
  std::optional<EmissionSample> result = scene_.emit(emitter, place.u, place.v, at.direction);
  if (!result || !along_normal) return std::nullopt;
  const Vec3 normal = along_normal->ray.direction;
  const CacheCell* cell = importance_.query(result->ray.origin, normal);
  if (!cell) return result;
  const GaussianMixture mixture = importance_.mixture(*cell);
  const Frame frame(cell->normal);
  if (guided && at.u_lobe < kDirectionShare) {
    const std::optional<Vec2> y = mixture.sample(at.u_lobe / kDirectionShare, at.direction);
    if (!y) return std::nullopt;
    result->ray.direction = frame.to_world(disk_to_direction(*y)).normalized();
  }
  const float cosine = result->ray.direction.dot(normal);
  if (!(cosine > 0)) return std::nullopt;
  const float density =
      mixture.pdf(direction_to_disk(frame.to_local(result->ray.direction))) / kSteradianPerDiskArea;
  *ratio *= 1 - kDirectionShare + kDirectionShare * density * kPi / cosine;
  return result;
}

std::optional<EmissionSample> EmissionGuide::emit_distant(int emitter, Primary at, bool guided,
                                                          float* ratio) const {
  const PrimaryTable& table = sources_[emitter].table;
  if (guided) at.direction = table.sample(at.u_table, at.direction).v;
  const auto central = scene_.emit(emitter, at.u, kCentre, at.direction);
  if (!central) return std::nullopt;
  const Vec3 to_light = -central->ray.direction;
  if (guided) at.position = escapes_.sample(to_light, at.u_lobe, at.position);
  *ratio = table.pdf({0, at.direction}) * escapes_.pdf(to_light, at.position);
  return scene_.emit(emitter, at.u, at.position, at.direction);
}

}  // namespace waylight
