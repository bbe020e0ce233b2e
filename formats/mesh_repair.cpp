#include "formats/mesh_repair.h"

#include "libguide/base/error.h"

namespace waylight {
namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

// Sums of face normals times twice the area, in double: squares of 1e-20 would underflow a float.
std::vector<Eigen::Vector3d> summed_normals(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> sums(mesh.positions.size(), Eigen::Vector3d::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d origin = mesh.positions[a].cast<double>();
    const Eigen::Vector3d ab = mesh.positions[b].cast<double>() - origin;
    const Eigen::Vector3d ac = mesh.positions[c].cast<double>() - origin;
    const Eigen::Vector3d normal = ab.cross(ac);
    for (uint32_t corner : {a, b, c}) sums[corner] += normal;
  }
  return sums;
}

Vec3 unit_or_z(const Eigen::Vector3d& v) {
  const double length = v.norm();
  if (!(length > 0) || !std::isfinite(length)) return Vec3::UnitZ();
  return (v / length).cast<float>();
}

void check_indices(const TriangleMesh& mesh, const std::string& path) {
  for (size_t i = 0; i < mesh.triangles.size(); ++i)
    for (uint32_t corner : mesh.triangles[i])
      if (corner >= mesh.positions.size())
        fail("\"{}\": triangle {} uses vertex {}, but there are {} vertices", path, i, corner,
             mesh.positions.size());
}

void check_sizes(const TriangleMesh& mesh, const std::string& path) {
  const auto check = [&](size_t count, const char* what) {
    if (count != 0 && count != mesh.positions.size())
      fail("\"{}\": there are {} {} for {} vertices", path, count, what, mesh.positions.size());
  };
  check(mesh.normals.size(), "normals");
  check(mesh.uvs.size(), "texture coordinates");
}

// Keeps only vertices that a triangle uses, in their order.
void compact_vertices(TriangleMesh& mesh) {
  std::vector<uint32_t> new_index(mesh.positions.size(), 0);
  for (const auto& triangle : mesh.triangles)
    for (uint32_t corner : triangle) new_index[corner] = 1;
  uint32_t count = 0;
  for (size_t i = 0; i < new_index.size(); ++i) {
    if (!new_index[i]) continue;
    mesh.positions[count] = mesh.positions[i];
    if (!mesh.normals.empty()) mesh.normals[count] = mesh.normals[i];
    if (!mesh.uvs.empty()) mesh.uvs[count] = mesh.uvs[i];
    new_index[i] = count++;
  }
  mesh.positions.resize(count);
  if (!mesh.normals.empty()) mesh.normals.resize(count);
  if (!mesh.uvs.empty()) mesh.uvs.resize(count);
  for (auto& triangle : mesh.triangles)
    for (uint32_t& corner : triangle) corner = new_index[corner];
}

size_t drop_unusable_triangles(TriangleMesh& mesh) {
  const auto finite = [&](const Vec3& p) { return p.allFinite(); };
  if (std::all_of(mesh.positions.begin(), mesh.positions.end(), finite)) return 0;
  const size_t before = mesh.triangles.size();
  std::erase_if(mesh.triangles, [&](const std::array<uint32_t, 3>& t) {
    return !std::all_of(t.begin(), t.end(), [&](uint32_t i) { return finite(mesh.positions[i]); });
  });
  compact_vertices(mesh);
  return before - mesh.triangles.size();
}

size_t repair_normals(TriangleMesh& mesh) {
  size_t replaced = 0;
  std::vector<Eigen::Vector3d> sums;
  for (size_t i = 0; i < mesh.normals.size(); ++i) {
    const double length = mesh.normals[i].cast<double>().norm();
    if (length > 0 && std::isfinite(length)) {
      mesh.normals[i] = (mesh.normals[i].cast<double>() / length).cast<float>();
      continue;
    }
    if (sums.empty()) sums = summed_normals(mesh);
    mesh.normals[i] = unit_or_z(sums[i]);
    ++replaced;
  }
  return replaced;
}

size_t repair_uvs(TriangleMesh& mesh) {
  size_t replaced = 0;
  for (Vec2& uv : mesh.uvs) {
    if (uv.allFinite()) continue;
    uv.setZero();
    ++replaced;
  }
  return replaced;
}

}  // namespace

void compute_vertex_normals(TriangleMesh& mesh) {
  const std::vector<Eigen::Vector3d> sums = summed_normals(mesh);
  mesh.normals.resize(sums.size());
  for (size_t i = 0; i < sums.size(); ++i) mesh.normals[i] = unit_or_z(sums[i]);
}

void finish_mesh(TriangleMesh& mesh, const std::string& path, MeshRepairs* repairs) {
  check_sizes(mesh, path);
  check_indices(mesh, path);
  MeshRepairs mended;
  mended.dropped_triangles = drop_unusable_triangles(mesh);
  if (mesh.triangles.empty()) fail("\"{}\": there is no usable triangle in it", path);
  mended.replaced_normals = repair_normals(mesh);
  mended.replaced_uvs = repair_uvs(mesh);
  if (!repairs) return;
  repairs->dropped_triangles += mended.dropped_triangles;
  repairs->replaced_normals += mended.replaced_normals;
  repairs->replaced_uvs += mended.replaced_uvs;
}

}  // namespace waylight
