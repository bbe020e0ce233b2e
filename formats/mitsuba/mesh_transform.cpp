#include "formats/mesh_io.h"
#include "formats/mitsuba/shape_geometry.h"

namespace waylight::mitsuba {
namespace {

using Matrix3 = Eigen::Matrix3d;

// Inverse transpose up to a positive factor; defined for singular matrices too, such as that which
// flattens a rectangle's unused axis.
Matrix3 normal_matrix(const Matrix3& m) {
  Matrix3 cofactors;
  cofactors << m.col(1).cross(m.col(2)), m.col(2).cross(m.col(0)), m.col(0).cross(m.col(1));
  return m.determinant() < 0 ? Matrix3(-cofactors) : cofactors;
}

double corner_angle(const TriangleMesh& mesh, const std::array<uint32_t, 3>& t, int corner) {
  const Eigen::Vector3d p = mesh.positions[t[corner]].cast<double>();
  const Eigen::Vector3d a = mesh.positions[t[(corner + 1) % 3]].cast<double>() - p;
  const Eigen::Vector3d b = mesh.positions[t[(corner + 2) % 3]].cast<double>() - p;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Eigen::Vector3d face_normal(const TriangleMesh& mesh, const std::array<uint32_t, 3>& t) {
  const Eigen::Vector3d p = mesh.positions[t[0]].cast<double>();
  const Eigen::Vector3d a = mesh.positions[t[1]].cast<double>() - p;
  const Eigen::Vector3d b = mesh.positions[t[2]].cast<double>() - p;
  return a.cross(b).normalized();
}

}  // namespace

void flip_v(TriangleMesh& mesh) {
  for (Vec2& uv : mesh.uvs) uv.y() = 1 - uv.y();
}

void transform_mesh(TriangleMesh& mesh, const Mat4& to_world) {
  const Matrix3 linear = to_world.topLeftCorner<3, 3>().cast<double>();
  const Eigen::Vector3d translation = to_world.topRightCorner<3, 1>().cast<double>();
  const Matrix3 normals = normal_matrix(linear);
  for (Vec3& p : mesh.positions) p = (linear * p.cast<double>() + translation).cast<float>();
  for (Vec3& n : mesh.normals) n = (normals * n.cast<double>()).normalized().cast<float>();
  if (linear.determinant() < 0)
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

void compute_smooth_normals(TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> sums(mesh.positions.size(), Eigen::Vector3d::Zero());
  for (const std::array<uint32_t, 3>& t : mesh.triangles) {
    const Eigen::Vector3d normal = face_normal(mesh, t);
    for (int corner = 0; corner < 3; ++corner)
      sums[t[corner]] += corner_angle(mesh, t, corner) * normal;
  }
  compute_vertex_normals(mesh);  // stays where the faces at a vertex cancel
  for (size_t i = 0; i < sums.size(); ++i)
    if (sums[i].norm() > 1e-6) mesh.normals[i] = sums[i].normalized().cast<float>();
}

}  // namespace waylight::mitsuba
