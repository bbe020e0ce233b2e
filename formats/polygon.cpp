// Triangulation of simple polygons.

#include "formats/mesh_repair.h"
#include "libguide/base/error.h"

namespace waylight {
namespace {

constexpr size_t kMaxConcaveCorners = 1024;

using Point = Eigen::Vector3d;

struct Polygon {
  std::vector<uint32_t> corners;
  std::vector<Point> points;
  Point normal = Point::Zero();

  size_t size() const { return corners.size(); }
  size_t before(size_t i) const { return (i + size() - 1) % size(); }
  size_t after(size_t i) const { return (i + 1) % size(); }

  // Twice the signed area of the corner's triangle, seen along the normal.
  double turn(size_t i) const { return area(points[before(i)], points[i], points[after(i)]); }
  double area(const Point& a, const Point& b, const Point& c) const {
    const Point ab = b - a, ac = c - a;
    return normal.dot(ab.cross(ac));
  }
  void remove(size_t i) {
    corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(i));
  }
};

// Newell's normal: exact for planar polygons, a mean for others.
Polygon make_polygon(const std::vector<uint32_t>& corners, const std::vector<Vec3>& positions) {
  Polygon polygon{corners, {}, Point::Zero()};
  for (uint32_t corner : corners) polygon.points.push_back(positions[corner].cast<double>());
  for (size_t i = 0; i < polygon.size(); ++i)
    polygon.normal += polygon.points[i].cross(polygon.points[polygon.after(i)]);
  return polygon;
}

bool is_convex(const Polygon& polygon) {
  for (size_t i = 0; i < polygon.size(); ++i)
    if (polygon.turn(i) < 0) return false;
  return true;
}

bool is_ear(const Polygon& polygon, size_t ear) {
  if (!(polygon.turn(ear) > 0)) return false;
  const size_t from = polygon.before(ear), to = polygon.after(ear);
  const Point &a = polygon.points[from], &b = polygon.points[ear], &c = polygon.points[to];
  for (size_t i = 0; i < polygon.size(); ++i) {
    if (i == from || i == ear || i == to || polygon.turn(i) > 0) continue;
    const Point& p = polygon.points[i];
    if (polygon.area(a, b, p) >= 0 && polygon.area(b, c, p) >= 0 && polygon.area(c, a, p) >= 0)
      return false;
  }
  return true;
}

// Any corner serves when there is no ear: the polygon is degenerate or crosses itself.
size_t find_ear(const Polygon& polygon) {
  for (size_t i = 0; i < polygon.size(); ++i)
    if (is_ear(polygon, i)) return i;
  return 1;
}

}  // namespace

void triangulate_polygon(const std::vector<uint32_t>& corners, const std::vector<Vec3>& positions,
                         const std::string& path, std::vector<std::array<uint32_t, 3>>& triangles) {
  if (corners.size() > 3) {
    Polygon polygon = make_polygon(corners, positions);
    if (!is_convex(polygon)) {
      if (corners.size() > kMaxConcaveCorners)
        fail("\"{}\": a concave polygon has {} corners, more than {}; triangulate it", path,
             corners.size(), kMaxConcaveCorners);
      while (polygon.size() > 3) {
        const size_t ear = find_ear(polygon);
        triangles.push_back({polygon.corners[polygon.before(ear)], polygon.corners[ear],
                             polygon.corners[polygon.after(ear)]});
        polygon.remove(ear);
      }
      triangles.push_back({polygon.corners[0], polygon.corners[1], polygon.corners[2]});
      return;
    }
  }
  for (size_t i = 2; i < corners.size(); ++i)
    triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

}  // namespace waylight
