#include "libguide/medium/cloud.h"

#include "libguide/base/error.h"
#include "libguide/base/parallel.h"
#include "libguide/base/sampler.h"
#include "libguide/math/warp.h"
#include "libguide/medium/cell_noise.h"

namespace waylight {
namespace {

const Vec3 kHalf(1, 0.6f, 0.75f);  // of the box
constexpr float kFloor = -0.42f;   // of the cloud: cumuli are flat below
constexpr int kBuds = 9;           // that grow on a puff

struct Puff {
  Vec3 center;
  float radius;
};

// The smaller the farther from the middle, along x.
Puff grow_puff(const CloudOptions& options, int number, Sampler& random) {
  const float along = options.puffs > 1 ? 2.0f * number / (options.puffs - 1) - 1 : 0;
  const float swell = 1 - 0.6f * along * along;
  const float radius = (0.12f + 0.4f * options.coverage) * swell * lerp(0.75f, 1, random.next());
  const float reach = kHalf.x() - 0.35f;
  return {{reach * along * lerp(0.8f, 1, random.next()), kFloor + radius * random.next(),
           0.35f * (2 * random.next() - 1)},
          radius};
}

// On the upper half of its puff, half sunk into it.
Puff grow_bud(const Puff& puff, Sampler& random) {
  Vec3 direction = square_to_sphere(random.next_2d());
  direction.y() = std::abs(direction.y());
  const float radius = puff.radius * lerp(0.35f, 0.6f, random.next());
  return {puff.center + puff.radius * direction, radius};
}

std::vector<Puff> grow(const CloudOptions& options) {
  std::vector<Puff> puffs;
  for (int i = 0; i < options.puffs; ++i) {
    Sampler random(options.seed, 0, static_cast<uint32_t>(i));
    const Puff puff = grow_puff(options, i, random);
    puffs.push_back(puff);
    for (int bud = 0; bud < kBuds; ++bud) puffs.push_back(grow_bud(puff, random));
  }
  return puffs;
}

// How deep inside of the puffs, above the floor; negative outside.
float depth_in(const std::vector<Puff>& puffs, const Vec3& p) {
  float depth = -kInfinity;
  for (const Puff& puff : puffs) depth = std::max(depth, puff.radius - (p - puff.center).norm());
  return std::min(depth, 1.5f * (p.y() - kFloor));
}

float smooth_step(float t) {
  t = std::clamp(t, 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

// Billows push the hull outwards where the noise is high and cut creases where it is low.
float density_at(const CloudOptions& options, const std::vector<Puff>& puffs, float border,
                 const Vec3& p) {
  const float room = (kHalf - p.cwiseAbs()).minCoeff() - border;
  const float depth = std::min(depth_in(puffs, p), room), push = 0.3f * options.billows;
  if (depth < -push || room <= 0) return 0;
  const float noise = billow_noise(6 * p, 4, hash_combine(options.seed, 1));
  const float hull = std::min(depth + push * (2 * noise - 1), room);
  return smooth_step(hull / options.edge) * lerp(0.55f, 1, noise);
}

// [0,1]^3 to a box about the origin.
Mat4 box_of(const Vec3& side) {
  Mat4 to_world = Mat4::Identity();
  to_world.topLeftCorner<3, 3>() = side.asDiagonal();
  to_world.topRightCorner<3, 1>() = -side / 2;
  return to_world;
}

}  // namespace

void CloudOptions::validate() const {
  require(resolution >= 16 && resolution <= 1024, "--resolution {}: must be within 16..1024",
          resolution);
  require(puffs >= 1 && puffs <= 64, "--puffs {}: must be within 1..64", puffs);
  require(coverage >= 0 && coverage <= 1, "--coverage {}: must be within 0..1", coverage);
  require(billows >= 0 && billows <= 1, "--billows {}: must be within 0..1", billows);
  require(edge > 0 && edge <= 1, "--edge {}: must be above 0 and at most 1", edge);
}

VolumeGrid make_cloud(const CloudOptions& options) {
  options.validate();
  const std::vector<Puff> puffs = grow(options);
  const float voxel = 2 * kHalf.x() / options.resolution;
  const Eigen::Vector3i size = (2 / voxel * kHalf).array().round().cast<int>();
  const Vec3 side = voxel * size.cast<float>(), corner = -side / 2;
  std::vector<float> values(size_t(size.x()) * size.y() * size.z());
  parallel_for(size.z(), [&](size_t z) {
    float* value = &values[z * size.x() * size.y()];
    for (int y = 0; y < size.y(); ++y)
      for (int x = 0; x < size.x(); ++x) {
        const Vec3 index(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
        const Vec3 p = corner + voxel * (index + Vec3::Constant(0.5f));
        *value++ = density_at(options, puffs, 1.5f * voxel, p);
      }
  });
  return {VoxelBricks(size, 1, values), false, box_of(side)};
}

}  // namespace waylight
