#include "libguide/cache/cell_moments.h"

#include <cmath>

namespace waylight {
namespace {

void forget_half_of_all(CellTraining& cell) {
  forget_half(cell);
  cell.normal_m2 *= 0.5f;
}

}  // namespace

void MomentBatch::merge_into(CellTraining& cell) const {
  if (count_ == 0) return;
  const float n = cell.count + count_, mix = cell.count / n;
  const Vec3 dn = normal_ / count_;
  const float between = count_ * mix - count_;
  positions_.merge_into(cell, count_, between, count_ / n);
  cell.normal_m2 += normal2_ + between * dn.cwiseProduct(dn);
  cell.normal_m2 = cell.normal_m2.cwiseMax(0);
  cell.normal_mean = normal_shift_ + dn * (count_ / n);
  cell.count = n;
  cell.flux += flux_;
  if (cell.count > kMaxMomentCount) forget_half_of_all(cell);
}

void add_moments(CellTraining& cell, const CellTraining& other) {
  if (other.count == 0) return;
  const float n = cell.count + other.count, share = other.count / n;
  const Vec3 dn = other.normal_mean - cell.normal_mean;
  add_position_moments(cell, other);
  cell.normal_m2 += other.normal_m2 + cell.count * share * dn.cwiseProduct(dn);
  cell.normal_mean += share * dn;
  cell.count = n;
  if (cell.count > kMaxMomentCount) forget_half_of_all(cell);
}

// The determinant of the covariance C projected on the plane of n is n^T adj(C) n.
double photon_area(const CellTraining& cell) {
  if (cell.count < 2) return 0;
  const Eigen::Vector3d v = cell.position_m2.cast<double>() / (cell.count - 1.0);
  const Eigen::Vector3d c = cell.position_cross.cast<double>() / (cell.count - 1.0);
  const Eigen::Vector3d n = mean_normal(cell, Vec3::UnitZ()).cast<double>();
  const double xx = v.y() * v.z() - c.z() * c.z(), yy = v.x() * v.z() - c.y() * c.y();
  const double zz = v.x() * v.y() - c.x() * c.x(), xy = c.y() * c.z() - c.x() * v.z();
  const double xz = c.x() * c.z() - c.y() * v.y(), yz = c.x() * c.y() - c.z() * v.x();
  const double det = n.x() * n.x() * xx + n.y() * n.y() * yy + n.z() * n.z() * zz +
                     2 * (n.x() * n.y() * xy + n.x() * n.z() * xz + n.y() * n.z() * yz);
  return 12 * std::sqrt(std::max(det, 0.0));
}

Vec3 mean_normal(const CellTraining& cell, const Vec3& fallback) {
  const float length = cell.normal_mean.norm();
  return length > 1e-3f ? Vec3(cell.normal_mean / length) : fallback;
}

}  // namespace waylight
