#include "formats/mesh_io.h"
#include "formats/mitsuba/shape_geometry.h"

namespace waylight::mitsuba {
namespace {

TriangleMesh read_mesh(const Document& document, Properties& properties, MeshRepairs& repairs) {
  const Element& shape = properties.element();
  const std::string filename = properties.text("filename", "");
  if (filename.empty()) fail_at(shape, "needs a <string name=\"filename\">");
  const std::string path = document.find_file(shape, filename);
  try {
    if (shape.type == "obj") return read_obj(path, &repairs);
    if (shape.type == "ply") return read_ply(path, &repairs);
    const int index = properties.integer("shape_index", 0);
    if (index < 0) fail_at(shape, "its shape_index must not be negative");
    return read_serialized(path, index, &repairs);
  } catch (const Error& error) {
    fail_at(shape, "{}", error.what());
  }
}

void warn_of_repairs(const ImportContext& context, const Element& shape,
                     const MeshRepairs& repairs) {
  if (repairs.any())
    context.warn(fmt::format(
        "{}: {} triangles left out, {} normals and {} texture coordinates "
        "replaced: they were not finite or zero",
        shape.where(), repairs.dropped_triangles, repairs.replaced_normals, repairs.replaced_uvs));
}

void ignore_loader_options(const ImportContext& context, Properties& properties) {
  // How Mitsuba splits and shares what it loads; `subdiv` and `srgb` are about what is not
  // rendered.
  properties.ignore({"collapse", "load_materials", "srgb", "subdiv"});
  if (properties.has("max_smooth_angle"))
    context.warn(fmt::format("{}: max_smooth_angle is ignored, the normals of the file are kept",
                             properties.element().where()));
}

}  // namespace

TriangleMesh import_mesh_file(ImportContext& context, Properties& properties) {
  const Element& shape = properties.element();
  MeshRepairs repairs;
  TriangleMesh mesh = read_mesh(context.document, properties, repairs);
  warn_of_repairs(context, shape, repairs);
  // Mitsuba takes the v of a file for its own, but for obj files turns it over first by default, in
  // both dialects, since most of them have v = 0 at the bottom: which is ours.
  if (!properties.boolean("flip_tex_coords", shape.type == "obj")) flip_v(mesh);
  if (properties.boolean("face_normals", false))
    mesh.normals.clear();
  else if (mesh.normals.empty())
    compute_smooth_normals(mesh);
  ignore_loader_options(context, properties);
  transform_mesh(mesh, properties.transform("to_world"));
  return mesh;
}

void warn_of_unread_materials(const ImportContext& context, Properties& properties) {
  const Element& shape = properties.element();
  const Document& document = context.document;
  if (shape.type != "obj" || !properties.boolean("load_materials", document.old_dialect)) return;
  if (has_obj_materials(document.find_file(shape, properties.text("filename", ""))))
    context.warn(fmt::format(
        "{}: the materials of its file are not read, all of it has the default material; give it a "
        "<bsdf>, or make it one shape for each material",
        shape.where()));
}

}  // namespace waylight::mitsuba
