#include "libguide/scene/mesh_prepare.h"

#include "libguide/base/error.h"

namespace waylight {
namespace {

using Triangle = std::array<uint32_t, 3>;

Eigen::Vector3d edge_cross(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Eigen::Vector3d origin = a.cast<double>();
  const Eigen::Vector3d e1 = b.cast<double>() - origin, e2 = c.cast<double>() - origin;
  return e1.cross(e2);
}

void check_sizes(const Shape& shape, const TriangleMesh& mesh) {
  const size_t count = mesh.positions.size();
  if (!mesh.normals.empty() && mesh.normals.size() != count)
    fail("shape \"{}\": {} normals for {} positions; give one each or none", shape.name,
         mesh.normals.size(), count);
  if (!mesh.uvs.empty() && mesh.uvs.size() != count)
    fail("shape \"{}\": {} texture coordinates for {} positions; give one each or none", shape.name,
         mesh.uvs.size(), count);
  for (const Triangle& t : mesh.triangles)
    if (std::max({t[0], t[1], t[2]}) >= count)
      fail("shape \"{}\": a triangle refers to vertex {} of {}; the file is damaged", shape.name,
           std::max({t[0], t[1], t[2]}), count);
}

// Embree leaves out what exceeds this in magnitude [embree 3.13, FLT_LARGE].
bool usable(const Vec3& p) { return p.allFinite() && p.cwiseAbs().maxCoeff() < 1e18f; }

size_t drop_degenerate(TriangleMesh& mesh) {
  const auto degenerate = [&](const Triangle& t) {
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    return !usable(a) || !usable(b) || !usable(c) || triangle_normal(a, b, c).isZero(0);
  };
  return std::erase_if(mesh.triangles, degenerate);
}

size_t normalise_normals(TriangleMesh& mesh, bool flip) {
  size_t bad = 0;
  for (Vec3& n : mesh.normals) {
    const double length = n.cast<double>().norm();
    const bool good = std::isfinite(length) && length > 1e-30;
    bad += !good;
    n = good ? Vec3((n.cast<double>() / (flip ? -length : length)).cast<float>()) : Vec3::Zero();
  }
  return bad;
}

void wind_with_normals(TriangleMesh& mesh) {
  for (Triangle& t : mesh.triangles) {
    const Vec3 ng =
        triangle_normal(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
    const Vec3 sum = mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]];
    if (ng.dot(sum) < 0) std::swap(t[1], t[2]);
  }
}

void replace_bad_uvs(TriangleMesh& mesh) {
  for (Vec2& uv : mesh.uvs)
    if (!uv.allFinite()) uv = Vec2::Zero();
}

}  // namespace

Vec3 triangle_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Eigen::Vector3d n = edge_cross(a, b, c);
  const double length = n.norm();
  return length > 1e-140 ? Vec3((n / length).cast<float>()) : Vec3(Vec3::Zero());
}

double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 0.5 * edge_cross(a, b, c).norm();
}

void prepare_mesh(Shape& shape, std::vector<std::string>& warnings) {
  TriangleMesh& mesh = std::get<TriangleMesh>(shape.geometry);
  check_sizes(shape, mesh);
  const size_t all = mesh.triangles.size();
  if (const size_t dropped = drop_degenerate(mesh))
    warnings.push_back(
        fmt::format("shape \"{}\": left out {} of {} triangles (no area, or corners not finite)",
                    shape.name, dropped, all));
  if (const size_t bad = normalise_normals(mesh, shape.flip_normals))
    warnings.push_back(fmt::format("shape \"{}\": {} of {} vertex normals have no direction",
                                   shape.name, bad, mesh.normals.size()));
  replace_bad_uvs(mesh);
  if (shape.flip_normals)
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  if (!mesh.normals.empty()) wind_with_normals(mesh);
  shape.flip_normals = false;
}

}  // namespace waylight
