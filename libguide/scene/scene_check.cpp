#include "libguide/scene/scene_check.h"

#include "libguide/base/error.h"
#include "libguide/scene/mesh_prepare.h"
#include "libguide/scene/placement.h"

namespace waylight {
namespace {

void check_index(const std::string& name, const char* what, int index, size_t count) {
  if (index != kNone && (index < 0 || static_cast<size_t>(index) >= count))
    fail("shape \"{}\": refers to {} {} of {}", name, what, index, count);
}

void check_sphere(const Shape& shape) {
  const Sphere* sphere = std::get_if<Sphere>(&shape.geometry);
  if (sphere && !(sphere->center.allFinite() && sphere->radius > 0 &&
                  std::isfinite(sphere->radius) && sphere->frame.allFinite()))
    fail("shape \"{}\": a sphere needs a finite centre and a radius above 0", shape.name);
}

void prepare_shape(Shape& shape, const SceneDescription& scene,
                   std::vector<std::string>& warnings) {
  check_index(shape.name, "material", shape.material, scene.materials.size());
  check_index(shape.name, "emitter", shape.emitter, scene.emitters.size());
  check_index(shape.name, "medium", shape.interior_medium, scene.media.size());
  check_index(shape.name, "medium", shape.exterior_medium, scene.media.size());
  if (shape.emitter != kNone && !std::holds_alternative<AreaLight>(scene.emitters[shape.emitter]))
    fail("shape \"{}\": its emitter {} is not an area light", shape.name, shape.emitter);
  check_sphere(shape);
  if (std::holds_alternative<TriangleMesh>(shape.geometry)) prepare_mesh(shape, warnings);
}

void check_groups(const SceneDescription& scene) {
  for (const ShapeGroup& group : scene.groups)
    for (const uint32_t shape : group.shapes)
      if (shape >= scene.group_shapes.size())
        fail("a shape group refers to shape {} of {}", shape, scene.group_shapes.size());
  for (const Instance& instance : scene.instances)
    if (instance.group >= scene.groups.size())
      fail("an instance refers to shape group {} of {}", instance.group, scene.groups.size());
}

bool good_pixel(const Color& c) { return is_finite(c) && c.minCoeff() >= 0; }

// Pictures stored as differences or resized with a sharpening filter hold negative pixels.
void prepare_map(EnvironmentMap& map, size_t index, std::vector<std::string>& warnings) {
  if (!map.bitmap) return;
  const auto bad = std::count_if(map.bitmap->pixels.begin(), map.bitmap->pixels.end(),
                                 [](const Color& c) { return !good_pixel(c); });
  if (bad == 0) return;
  auto clean = std::make_shared<Bitmap>(*map.bitmap);
  for (Color& c : clean->pixels)
    c = c.unaryExpr([](float v) { return std::isfinite(v) && v > 0 ? v : 0.0f; });
  map.bitmap = clean;
  warnings.push_back(
      fmt::format("emitter {}: {} of {} pixels of its environment map are negative or not finite; "
                  "those values are taken as 0",
                  index, bad, clean->pixels.size()));
}

}  // namespace

std::vector<std::string> prepare_scene(SceneDescription& scene) {
  std::vector<std::string> warnings;
  check_groups(scene);
  for (size_t i = 0; i < scene.emitters.size(); ++i)
    if (EnvironmentMap* map = std::get_if<EnvironmentMap>(&scene.emitters[i]))
      prepare_map(*map, i, warnings);
  for (Shape& shape : scene.shapes) prepare_shape(shape, scene, warnings);
  for (Shape& shape : scene.group_shapes) {
    if (shape.emitter != kNone)
      fail(
          "shape \"{}\": an area light in a shape group would shine from each instance, which is "
          "not supported; place the shape itself",
          shape.name);
    prepare_shape(shape, scene, warnings);
  }
  return warnings;
}

std::vector<bool> placed_instances(const SceneDescription& scene,
                                   std::vector<std::string>& warnings) {
  std::vector<bool> placed;
  for (const Instance& instance : scene.instances)
    placed.push_back(Placement::invertible(instance.to_world));
  if (const auto dropped = std::count(placed.begin(), placed.end(), false))
    warnings.push_back(fmt::format("left out {} of {} instances (their transform has no inverse)",
                                   dropped, placed.size()));
  return placed;
}

Bounds shape_bounds(const Shape& shape) {
  Bounds result;
  if (const Sphere* sphere = std::get_if<Sphere>(&shape.geometry)) {
    result.extend(Vec3(sphere->center.array() - sphere->radius));
    result.extend(Vec3(sphere->center.array() + sphere->radius));
    return result;
  }
  const TriangleMesh& mesh = std::get<TriangleMesh>(shape.geometry);
  for (const auto& triangle : mesh.triangles)
    for (const uint32_t corner : triangle) result.extend(mesh.positions[corner]);
  return result;
}

Bounds scene_bounds(const SceneDescription& scene, const std::vector<bool>& placed) {
  Bounds result;
  for (const Shape& shape : scene.shapes) result.extend(shape_bounds(shape));
  std::vector<Bounds> groups(scene.groups.size());
  for (size_t g = 0; g < groups.size(); ++g)
    for (const uint32_t shape : scene.groups[g].shapes)
      groups[g].extend(shape_bounds(scene.group_shapes[shape]));
  for (size_t i = 0; i < scene.instances.size(); ++i)
    if (placed[i])
      result.extend(
          Placement(scene.instances[i].to_world).to_world(groups[scene.instances[i].group]));
  return result;
}

}  // namespace waylight
