#pragma once
// What is wrong with a mesh is put right, or counted and left out, before anything is built from
// it.

#include <string>
#include <vector>

#include "libguide/scene/scene_description.h"

namespace waylight {

// Afterwards: every triangle has finite corners and a finite normal, winds about the side of its
// vertex normals where there are any (they decide, as in Mitsuba), and flip_normals is applied and
// cleared. Vertex normals that cannot be normalised become zero. Appends one sentence per kind of
// repair; throws Error where an index or an array's size makes no sense.
void prepare_mesh(Shape& shape, std::vector<std::string>& warnings);

// Unit normal by winding (counter-clockwise seen from outside), in double precision so that slivers
// and distant scenes keep it; zero when the triangle has no extent.
Vec3 triangle_normal(const Vec3& a, const Vec3& b, const Vec3& c);
double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace waylight
