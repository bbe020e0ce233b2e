#pragma once
// Readers of triangle meshes. Polygons are triangulated; attributes are per vertex afterwards.
// All throw Error naming the file and what is wrong with it: truncation, indices out of range, no
// usable triangle. Texture coordinates are those of the file: v is not flipped.

#include <string>

#include "libguide/scene/scene_description.h"

namespace waylight {

// What a reader had to mend; worth a warning when any is not zero.
struct MeshRepairs {
  size_t dropped_triangles = 0;  // those that use a position that is not finite
  size_t replaced_normals = 0;   // missing, zero or not finite: area-weighted ones instead
  size_t replaced_uvs = 0;       // not finite: zero instead

  bool any() const { return dropped_triangles || replaced_normals || replaced_uvs; }
};

// Vertices are unified by their (position, uv, normal) triple of indices; groups are merged.
TriangleMesh read_obj(const std::string& path, MeshRepairs* repairs = nullptr);
// Whether its faces have materials of a library (.mtl), which read_obj leaves out.
bool has_obj_materials(const std::string& path);
// ascii, binary little and big endian
TriangleMesh read_ply(const std::string& path, MeshRepairs* repairs = nullptr);
// Mitsuba's zlib-compressed format, versions 3 and 4, float and double.
TriangleMesh read_serialized(const std::string& path, int shape_index,
                             MeshRepairs* repairs = nullptr);

// Area-weighted vertex normals; degenerate faces contribute nothing, and a vertex that has no other
// gets +z.
void compute_vertex_normals(TriangleMesh& mesh);

}  // namespace waylight
