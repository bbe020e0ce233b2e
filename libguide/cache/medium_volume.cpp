#include "libguide/cache/medium_volume.h"

#include <bit>

namespace waylight {
namespace {

// The volume of n photons has a relative standard deviation of about 0.8 / sqrt(n), and the lesser
// of it and of the box is low by 0.3 / sqrt(n) where the medium fills the box: a cell that has a
// parent waits until it would know that it is full.
constexpr float kOwnVolumePhotons = 256, kFirstVolumePhotons = 32;

constexpr int kPartsOfFullBox = 60;

// The parts of a box whose index along an axis is within [first, last].
uint64_t slab(int axis, int first, int last) {
  uint64_t parts = 0;
  for (int part = 0; part < 64; ++part) {
    const int index = part >> 2 * axis & 3;
    if (index >= first && index <= last) parts |= uint64_t{1} << part;
  }
  return parts;
}

// Every quarter of the box along each axis, and each of its octants, saw a photon.
bool spans_box(uint64_t occupied) {
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < 4; ++i)
      if (!(occupied & slab(axis, i, i))) return false;
  for (int octant = 0; octant < 8; ++octant) {
    uint64_t parts = occupied;
    for (int axis = 0; axis < 3; ++axis) {
      const int first = octant >> axis & 1 ? 2 : 0;
      parts &= slab(axis, first, first + 1);
    }
    if (!parts) return false;
  }
  return true;
}

int part_along(float low, float high, float x) {
  const float extent = high - low;
  return extent > 0 ? static_cast<int>(std::clamp(4 * (x - low) / extent, 0.0f, 3.0f)) : 0;
}

}  // namespace

uint64_t part_of_box(const Bounds& box, const Vec3& position) {
  int part = 0;
  for (int axis = 2; axis >= 0; --axis)
    part = 4 * part + part_along(box.min[axis], box.max[axis], position[axis]);
  return uint64_t{1} << part;
}

uint64_t parts_of_both(const Bounds& lower, uint64_t lower_parts, const Bounds& upper,
                       uint64_t upper_parts) {
  Bounds both = lower;
  both.extend(upper);
  uint64_t parts = 0;
  for (int part = 0; part < 64; ++part) {
    const Vec3 index(part & 3, part >> 2 & 3, part >> 4);
    const Vec3 centre =
        both.min + (both.max - both.min).cwiseProduct((index.array() + 0.5f).matrix() / 4);
    const bool is_lower = (centre.array() <= lower.max.array()).all();
    if (part_of_box(is_lower ? lower : upper, centre) & (is_lower ? lower_parts : upper_parts))
      parts |= uint64_t{1} << part;
  }
  return parts;
}

double box_volume(const Bounds& box) {
  return (box.max - box.min).cwiseMax(0).cast<double>().prod();
}

double photon_volume(const MediumTraining& cell) {
  if (cell.count < 2) return 0;
  const Eigen::Vector3d v = cell.position_m2.cast<double>() / (cell.count - 1.0);
  const Eigen::Vector3d c = cell.position_cross.cast<double>() / (cell.count - 1.0);
  const double det = v.prod() + 2 * c.prod() - v.x() * c.z() * c.z() - v.y() * c.y() * c.y() -
                     v.z() * c.x() * c.x();
  return std::sqrt(12.0 * 12.0 * 12.0 * std::max(det, 0.0));
}

bool fills_box(const MediumTraining& cell) {
  return std::popcount(cell.occupied) >= kPartsOfFullBox;
}

double medium_volume(const MediumTraining& cell, const Bounds& box) {
  const double whole = box_volume(box);
  if (fills_box(cell)) return whole;
  const bool child = cell.inherited_volume > 0;
  if (cell.count >= (child ? kOwnVolumePhotons : kFirstVolumePhotons)) {
    const double least = spans_box(cell.occupied) ? 0.5 * whole : 0;
    return std::clamp(photon_volume(cell), least, whole);
  }
  return child ? std::min<double>(whole, cell.inherited_volume) : whole;
}

}  // namespace waylight
