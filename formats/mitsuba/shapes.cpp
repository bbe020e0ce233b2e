// <shape>: geometry, and what hangs on it.

#include <algorithm>

#include "formats/mitsuba/shape_geometry.h"
#include "formats/mitsuba/types.h"
#include "libguide/scene/scene_check.h"

namespace waylight::mitsuba {
namespace {

const std::vector<std::string> kShapeTypes = {"obj",        "ply",     "serialized", "rectangle",
                                              "cube",       "disk",    "cylinder",   "sphere",
                                              "shapegroup", "instance"};

Geometry import_geometry(ImportContext& context, Properties& properties) {
  const std::string& type = properties.element().type;
  if (type == "rectangle") return import_rectangle(properties);
  if (type == "cube") return import_cube(properties);
  if (type == "disk") return import_disk(properties);
  if (type == "cylinder") return import_cylinder(context, properties);
  if (type == "sphere") return import_sphere(properties);
  return import_mesh_file(context, properties);
}

int import_boundary(ImportContext& context, Properties& properties, const std::string& side) {
  const Element* medium = properties.object(side);
  if (!medium && properties.has(side))
    fail_at(properties.element(), "its {} should be a <medium>", side);
  if (!medium) return kNone;
  if (medium->tag != "medium") fail_at(*medium, "is no <medium>, but used as {}", side);
  return import_medium(context, *medium);
}

int black_material(ImportContext& context) {
  if (context.black_material == kNone) {
    context.black_material = static_cast<int>(context.scene.materials.size());
    context.scene.materials.push_back({"black", DiffuseMaterial{Texture(0.0f)}});
  }
  return context.black_material;
}

// Without BSDF an emitter reflects nothing, the boundary of a medium is index-matched in the old
// dialect, and anything else is grey.
int choose_material(ImportContext& context, const Element* bsdf, const Element* emitter,
                    bool bounds_medium) {
  if (bsdf) return import_material(context, *bsdf);
  if (bounds_medium && context.document.old_dialect) return null_material(context);
  return emitter ? black_material(context) : grey_material(context);
}

// Squares of these and areas stay far from the largest float.
constexpr float kMostCoordinate = 1e15f;

bool is_near(const Vec3& p) { return (p.array().abs() <= kMostCoordinate).all(); }
bool is_near(const Sphere& sphere) {
  return is_near(sphere.center) && sphere.radius <= kMostCoordinate;
}
bool is_near(const TriangleMesh& mesh) {
  return std::all_of(mesh.positions.begin(), mesh.positions.end(),
                     [](const Vec3& p) { return is_near(p); });
}

// Whether a box is, where a transform puts it.
bool is_near(const Bounds& box, const Mat4& to_world) {
  if (!(to_world.array().abs() <= kMostCoordinate).all()) return false;
  for (int corner = 0; corner < 8 && !box.empty(); ++corner) {
    Eigen::Vector4f p = Eigen::Vector4f::Ones();
    for (int i = 0; i < 3; ++i) p[i] = corner >> i & 1 ? box.max[i] : box.min[i];
    if (!is_near(Vec3((to_world * p).head<3>()))) return false;
  }
  return true;
}

void check_coordinates(const Element& element, bool near) {
  if (!near)
    fail_at(element,
            "reaches beyond {:g} of the origin; give it smaller coordinates or a smaller scale",
            kMostCoordinate);
}

// A shape, and the <emitter type="area"> on it.
struct ImportedShape {
  Shape shape;
  const Element* emitter = nullptr;
};

ImportedShape import_single(ImportContext& context, const Element& element) {
  Properties properties(context.document, element);
  ImportedShape result;
  Shape& shape = result.shape;
  shape.name = element.id.empty() ? fmt::format("{}:{}", element.type, element.line) : element.id;
  shape.geometry = import_geometry(context, properties);
  check_coordinates(element, std::visit([](const auto& g) { return is_near(g); }, shape.geometry));
  shape.flip_normals = properties.boolean("flip_normals", false);
  shape.interior_medium = import_boundary(context, properties, "interior");
  shape.exterior_medium = import_boundary(context, properties, "exterior");
  const Element* bsdf = single(properties, "bsdf");
  if (!bsdf) warn_of_unread_materials(context, properties);
  result.emitter = single(properties, "emitter");
  properties.finish();
  const bool bounds_medium = shape.interior_medium != kNone || shape.exterior_medium != kNone;
  shape.material = choose_material(context, bsdf, result.emitter, bounds_medium);
  return result;
}

void make_area_light(ImportContext& context, const Element& emitter, Shape& shape) {
  if (emitter.type != "area") fail_at(emitter, "only an area emitter can stand on a shape");
  AreaLight light;
  light.radiance = import_area_radiance(context, emitter);
  light.shape = static_cast<uint32_t>(context.scene.shapes.size());
  shape.emitter = static_cast<int>(context.scene.emitters.size());
  context.scene.emitters.emplace_back(std::move(light));
}

bool is_known(ImportContext& context, const Element& shape) {
  for (const std::string& type : kShapeTypes)
    if (type == shape.type) return true;
  if (!context.options.lenient)
    fail_at(shape, "unknown shape{}", did_you_mean(shape.type, kShapeTypes));
  context.warn(fmt::format("{}: unknown shape, left out", shape.where()));
  return false;
}

void add_to_group(ImportContext& context, const Element& element, ShapeGroup& group,
                  Bounds& bounds) {
  if (!is_known(context, element)) return;
  if (element.type == "shapegroup" || element.type == "instance")
    fail_at(element, "a shape group cannot contain groups or instances");
  ImportedShape member = import_single(context, element);
  if (member.emitter) fail_at(*member.emitter, "a shape that is instanced cannot emit");
  bounds.extend(shape_bounds(member.shape));
  group.shapes.push_back(static_cast<uint32_t>(context.scene.group_shapes.size()));
  context.scene.group_shapes.push_back(std::move(member.shape));
}

uint32_t import_group(ImportContext& context, const Element& element) {
  const auto known = context.groups.find(&element);
  if (known != context.groups.end()) return known->second;
  Properties properties(context.document, element);
  ShapeGroup group;
  Bounds bounds;
  for (const Element* shape : properties.objects("shape"))
    add_to_group(context, *shape, group, bounds);
  properties.finish();
  const auto index = static_cast<uint32_t>(context.scene.groups.size());
  context.scene.groups.push_back(std::move(group));
  context.group_bounds.push_back(bounds);
  context.groups[&element] = index;
  return index;
}

void import_instance(ImportContext& context, const Element& element) {
  Properties properties(context.document, element);
  const Element* group = single(properties, "shape");
  if (!group || group->type != "shapegroup")
    fail_at(element, "needs a <ref> to a <shape type=\"shapegroup\">");
  Instance instance;
  instance.group = import_group(context, *group);
  instance.to_world = properties.transform("to_world");
  check_coordinates(element, is_near(context.group_bounds[instance.group], instance.to_world));
  properties.finish();
  context.scene.instances.push_back(instance);
}

}  // namespace

void import_shape(ImportContext& context, const Element& element) {
  if (!is_known(context, element)) return;
  if (element.type == "shapegroup") return void(import_group(context, element));
  if (element.type == "instance") return import_instance(context, element);
  ImportedShape imported = import_single(context, element);
  if (imported.emitter) make_area_light(context, *imported.emitter, imported.shape);
  context.scene.shapes.push_back(std::move(imported.shape));
}

}  // namespace waylight::mitsuba
