#include "formats/mitsuba/shape_geometry.h"
#include "libguide/math/frame.h"

namespace waylight::mitsuba {
namespace {

// A polygon of this many sides has 1 - 2.5e-5 of the area of its circle.
constexpr int kCircleSegments = 512;
constexpr int kSphereRows = 128, kSphereColumns = 256;

Vec2 unit_circle(int i, int count) {
  const double phi = 2 * std::numbers::pi * i / count;
  return Vec2(static_cast<float>(std::cos(phi)), static_cast<float>(std::sin(phi)));
}

void add_quad(TriangleMesh& mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

// From the unit mesh with Mitsuba's texture coordinates.
TriangleMesh placed(TriangleMesh mesh, Properties& properties) {
  flip_v(mesh);
  transform_mesh(mesh, properties.transform("to_world"));
  return mesh;
}

// u is azimuth about z / 2 pi, v is polar angle / pi.
TriangleMesh tessellated_sphere() {
  TriangleMesh mesh;
  for (int row = 0; row <= kSphereRows; ++row)
    for (int column = 0; column <= kSphereColumns; ++column) {
      const double theta = std::numbers::pi * row / kSphereRows;
      const Vec2 around = static_cast<float>(std::sin(theta)) * unit_circle(column, kSphereColumns);
      mesh.positions.emplace_back(around.x(), around.y(), static_cast<float>(std::cos(theta)));
      mesh.uvs.emplace_back(static_cast<float>(column) / kSphereColumns,
                            static_cast<float>(row) / kSphereRows);
    }
  mesh.normals = mesh.positions;
  for (uint32_t row = 0; row < kSphereRows; ++row)
    for (uint32_t column = 0; column < kSphereColumns; ++column) {
      const uint32_t a = row * (kSphereColumns + 1) + column, b = a + kSphereColumns + 1;
      if (row + 1 < kSphereRows) mesh.triangles.push_back({a, b, b + 1});
      if (row > 0) mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

// Where azimuth about n begins: along the first tangent of the frame that Mitsuba puts around it,
// which in the old dialect is a matter of the larger of x and y.
Vec3 first_tangent(const Vec3& n, bool old_dialect) {
  if (!old_dialect) return Frame(n).s;
  const bool x_is_larger = std::abs(n.x()) > std::abs(n.y());
  const Vec3 t = x_is_larger ? Vec3(n.z(), 0, -n.x()) : Vec3(0, n.z(), -n.y());
  return t.normalized().cross(n);
}

// Length that the transform gives every unit vector, or 0 when it is not the same for all.
double similarity_scale(const Eigen::Matrix3d& linear) {
  const Eigen::Matrix3d gram = linear.transpose() * linear;
  const double scale2 = gram.trace() / 3;
  const Eigen::Matrix3d rest = gram - scale2 * Eigen::Matrix3d::Identity();
  return rest.cwiseAbs().maxCoeff() <= 1e-5 * scale2 ? std::sqrt(scale2) : 0;
}

}  // namespace

TriangleMesh import_rectangle(Properties& properties) {
  TriangleMesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  add_quad(mesh, 0, 1, 2, 3);
  return placed(mesh, properties);
}

// [-1, 1]^3, each face with the unit square of texture coordinates as both Mitsubas have it.
TriangleMesh import_cube(Properties& properties) {
  const Vec3 right[] = {{0, 1, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 1, 0}};
  TriangleMesh mesh;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const Vec3 n = (face % 2 ? 1 : -1) * Vec3::Unit(axis), s = Vec3::Unit((axis + 1) % 3);
    const Vec3 t = n.cross(s), u = right[face], v = u.cross(n);
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const Vec2& corner : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}) {
      const Vec3 p = n + corner.x() * s + corner.y() * t;
      mesh.positions.push_back(p);
      mesh.uvs.push_back(0.5f * (Vec2(p.dot(u), p.dot(v)) + Vec2::Ones()));
    }
    add_quad(mesh, first, first + 1, first + 2, first + 3);
  }
  return placed(mesh, properties);
}

// The unit disk about +z; u is the radius, v is azimuth / 2 pi.
TriangleMesh import_disk(Properties& properties) {
  TriangleMesh mesh;
  for (int i = 0; i <= kCircleSegments; ++i) {
    const Vec2 edge = unit_circle(i, kCircleSegments);
    const float v = static_cast<float>(i) / kCircleSegments;
    mesh.positions.emplace_back(edge.x(), edge.y(), 0.0f);
    mesh.uvs.emplace_back(1.0f, v);
    mesh.positions.emplace_back(0.0f, 0.0f, 0.0f);
    mesh.uvs.emplace_back(0.0f, v + 0.5f / kCircleSegments);
  }
  for (uint32_t i = 0; i < kCircleSegments; ++i)
    mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
  return placed(mesh, properties);
}

// The open tube from p0 to p1; u is azimuth / 2 pi, v runs along the axis.
TriangleMesh import_cylinder(const ImportContext& context, Properties& properties) {
  const Vec3 p0 = properties.vector("p0", Vec3::Zero());
  const Vec3 p1 = properties.vector("p1", Vec3::UnitZ());
  const float radius = properties.number("radius", 1);
  if (!(radius > 0) || p0 == p1)
    fail_at(properties.element(), "needs a radius above 0 and p0 apart from p1");
  const Vec3 axis = (p1 - p0).normalized();
  const Vec3 s = first_tangent(axis, context.document.old_dialect), t = axis.cross(s);
  TriangleMesh mesh;
  for (int i = 0; i <= kCircleSegments; ++i) {
    const Vec2 around = unit_circle(i, kCircleSegments);
    const Vec3 normal = around.x() * s + around.y() * t;
    for (const Vec3& end : {p0, p1}) {
      mesh.positions.push_back(end + radius * normal);
      mesh.normals.push_back(normal);
      mesh.uvs.emplace_back(static_cast<float>(i) / kCircleSegments, end == p1 ? 1.0f : 0.0f);
    }
  }
  for (uint32_t i = 0; i < 2 * kCircleSegments; i += 2) add_quad(mesh, i, i + 2, i + 3, i + 1);
  return placed(mesh, properties);
}

Geometry import_sphere(Properties& properties) {
  const Vec3 center = properties.vector("center", Vec3::Zero());
  const float radius = properties.number("radius", 1);
  properties.ignore({"subdiv"});
  if (!(radius > 0)) fail_at(properties.element(), "its radius must be above 0");
  Mat4 to_world = properties.transform("to_world");
  to_world.topRightCorner<3, 1>() += to_world.topLeftCorner<3, 3>() * center;
  to_world.topLeftCorner<3, 3>() *= radius;
  const Eigen::Matrix3d linear = to_world.topLeftCorner<3, 3>().cast<double>();
  const double scale = similarity_scale(linear);
  if (!(scale > 0)) {
    TriangleMesh mesh = tessellated_sphere();
    flip_v(mesh);
    transform_mesh(mesh, to_world);
    return mesh;
  }
  // Sphere counts v from its +z as Mitsuba does; a frame with z reversed makes that 1 - v.
  const Eigen::Matrix3d frame = linear / scale * Eigen::DiagonalMatrix<double, 3>(1, 1, -1);
  return Sphere{to_world.topRightCorner<3, 1>(), static_cast<float>(scale), frame.cast<float>()};
}

}  // namespace waylight::mitsuba
