#include "libguide/scene/placement.h"

#include "libguide/math/frame.h"

namespace waylight {

using Vec3d = Eigen::Vector3d;

Placement::Placement(const Mat4& to_world)
    : linear_(to_world.topLeftCorner<3, 3>().cast<double>()),
      inverse_(linear_.inverse()),
      translation_(to_world.topRightCorner<3, 1>().cast<double>()) {}

bool Placement::invertible(const Mat4& to_world) {
  const Eigen::Matrix3d linear = to_world.topLeftCorner<3, 3>().cast<double>();
  return to_world.allFinite() && linear.inverse().cast<float>().allFinite();
}

Vec3d Placement::local_origin(const Ray& ray) const {
  return inverse_ * (ray.origin.cast<double>() - translation_);
}

Vec3d Placement::local_direction(const Ray& ray) const {
  return inverse_ * ray.direction.cast<double>();
}

// A local coordinate is a sum of four float products, M^-1 p - M^-1 t: off by at most four half
// ulps of the sum of their magnitudes.
float Placement::local_error(const Vec3& p) const {
  const Vec3d terms =
      inverse_.cwiseAbs() * p.cast<double>().cwiseAbs() + (inverse_ * translation_).cwiseAbs();
  return 4 * kRounding * static_cast<float>(terms.maxCoeff());
}

void Placement::to_world(SurfacePoint& point) const {
  const Vec3d p = linear_ * point.p.cast<double>() + translation_;
  const double stretch = linear_.cwiseAbs().rowwise().sum().maxCoeff();
  point.p_error = static_cast<float>(stretch * point.p_error) + position_error(p);
  point.p = p.cast<float>();
  const Eigen::Matrix3d normals = inverse_.transpose();
  point.ng = (normals * point.ng.cast<double>()).normalized().cast<float>();
  point.ns = (normals * point.ns.cast<double>()).normalized().cast<float>();
  point.dpdu = (linear_ * point.dpdu.cast<double>()).cast<float>();
  point.dpdv = (linear_ * point.dpdv.cast<double>()).cast<float>();
}

Bounds Placement::to_world(const Bounds& bounds) const {
  Bounds result;
  if (bounds.empty()) return result;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 local((corner & 1 ? bounds.max : bounds.min).x(),
                     (corner & 2 ? bounds.max : bounds.min).y(),
                     (corner & 4 ? bounds.max : bounds.min).z());
    result.extend(Vec3((linear_ * local.cast<double>() + translation_).cast<float>()));
  }
  return result;
}

}  // namespace waylight
