#pragma once
// The checks that every mesh passes, whatever format it came from.

#include <string>

#include "formats/mesh_io.h"

namespace waylight {

// Makes the mesh that was read from `path` keep the promises of TriangleMesh. Adds to *repairs
// (may be null). Throws Error for indices out of range, for normals or texture coordinates of some
// vertices only, and when no triangle is left.
void finish_mesh(TriangleMesh& mesh, const std::string& path, MeshRepairs* repairs);

// Adds the triangles of a simple polygon, given by indices into positions that are in range. Convex
// ones become fans, others are cut by ears. Throws Error beyond 1024 corners of a concave one: the
// time of cutting ears grows with their cube.
void triangulate_polygon(const std::vector<uint32_t>& corners, const std::vector<Vec3>& positions,
                         const std::string& path, std::vector<std::array<uint32_t, 3>>& triangles);

}  // namespace waylight
