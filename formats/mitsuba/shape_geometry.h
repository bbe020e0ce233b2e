#pragma once
// Geometry of the single kinds of shapes, with to_world applied.
//
// Texture coordinates are 1 - v of Mitsuba's: here v = 0 is the bottom row of a bitmap.

#include "formats/mitsuba/import_context.h"

namespace waylight::mitsuba {

using Geometry = std::variant<TriangleMesh, Sphere>;

// obj, ply, serialized. Warns of repairs.
TriangleMesh import_mesh_file(ImportContext& context, Properties& properties);
// Of a shape without <bsdf>: Mitsuba 0.6 takes the materials of an OBJ file for it.
void warn_of_unread_materials(const ImportContext& context, Properties& properties);
TriangleMesh import_rectangle(Properties& properties);
TriangleMesh import_cube(Properties& properties);
TriangleMesh import_disk(Properties& properties);
TriangleMesh import_cylinder(const ImportContext& context, Properties& properties);
// A Sphere where to_world is a similarity, else a fine mesh.
Geometry import_sphere(Properties& properties);

void flip_v(TriangleMesh& mesh);  // v -> 1 - v

// Normals by the inverse transpose. Under a reflection triangles are wound the other way, so that
// what was outside stays outside.
void transform_mesh(TriangleMesh& mesh, const Mat4& to_world);

// Weighted by the angle of each face at the vertex, as both Mitsubas make them where a file has
// none [Thuermer, Wuethrich 1998].
void compute_smooth_normals(TriangleMesh& mesh);

}  // namespace waylight::mitsuba
