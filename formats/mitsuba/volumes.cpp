#include "formats/mitsuba/media.h"
#include "formats/mitsuba/types.h"
#include "formats/volume_io.h"

namespace waylight::mitsuba {
namespace {

bool is_vdb(const std::string& path) { return path.ends_with(".vdb"); }

VolumeTexture import_constant(ImportContext& /*context*/, Properties& properties) {
  if (!properties.has("value")) fail_at(properties.element(), "needs a value");
  const Color value = properties.color("value", Color::Zero());
  if (value.minCoeff() < 0) fail_at(properties.element(), "its value is negative");
  return value;
}

// [0,1]^3 of the grid to the volume's own space: the box of the file, unless the old dialect's min
// and max say otherwise, or the new dialect leaves the file's box out, as it does by default.
Mat4 box_property(ImportContext& context, Properties& properties, const Mat4& of_file, bool vdb) {
  const bool old = context.document.old_dialect;
  const bool from_file = properties.boolean("use_grid_bbox", old || vdb);
  if (!from_file) return Mat4::Identity();
  if (!properties.has("min") && !properties.has("max")) return of_file;
  const Vec3 low = of_file.topRightCorner<3, 1>();
  const Vec3 size = of_file.diagonal().head<3>();
  const Vec3 min = properties.vector("min", low), max = properties.vector("max", low + size);
  if (!(max.array() > min.array()).all())
    fail_at(properties.element(), "its max must be above its min on every axis");
  return box_between(min, max);
}

// The new dialect's `max_value`: what the largest value of the file stands for.
void rescale(Properties& properties, VolumeGrid& grid) {
  if (!properties.has("max_value")) return;
  const float wanted = properties.number("max_value", 1);
  const float most = grid.voxels.range().most;
  if (!(wanted >= 0)) fail_at(properties.element(), "its max_value is negative");
  if (!(most > 0)) return;
  if (!std::isfinite(wanted / most))
    fail_at(properties.element(), "its max_value is too large for a grid of at most {:g}", most);
  grid.voxels.scale(wanted / most);
}

void read_lookup(Properties& properties, VolumeGrid& grid) {
  static const std::map<std::string, bool> kNearest = {{"trilinear", false}, {"nearest", true}};
  static const std::map<std::string, bool> kModes = {{"clamp", true}};
  grid.nearest = choose(properties, "filter_type", kNearest, "trilinear");
  choose(properties, "wrap_mode", kModes, "clamp");
  properties.ignore({"send_data", "raw", "accel"});
}

VolumeGrid read_grid(const Element& element, const std::string& path, const std::string& gridname) {
  try {
    return is_vdb(path) ? read_vdb(path, gridname) : read_vol(path);
  } catch (const Error& error) {
    fail_at(element, "{}", error.what());
  }
}

VolumeTexture import_grid(ImportContext& context, Properties& properties) {
  const std::string name = properties.text("filename", "");
  if (name.empty()) fail_at(properties.element(), "needs a filename");
  const std::string path = context.document.find_file(properties.element(), name);
  const std::string gridname = properties.text("gridname", "");
  if (!is_vdb(path) && !gridname.empty())
    fail_at(properties.element(), "gridname is for .vdb files, a .vol file has one grid");
  auto grid = std::make_shared<VolumeGrid>(read_grid(properties.element(), path, gridname));
  const Mat4 box = box_property(context, properties, grid->grid_to_world, is_vdb(path));
  grid->grid_to_world = properties.transform("to_world") * box;
  if (!(std::abs(grid->grid_to_world.determinant()) > 0))
    fail_at(properties.element(), "its to_world has no inverse");
  // As the renderers of the old dialect have it; those of the new one, and OpenVDB, have the values
  // at the centres of voxels.
  grid->values_on_sides = context.document.old_dialect && !is_vdb(path);
  rescale(properties, *grid);
  read_lookup(properties, *grid);
  return grid;
}

using VolumeImporter = VolumeTexture (*)(ImportContext&, Properties&);
const std::map<std::string, VolumeImporter> kImporters = {{"gridvolume", import_grid},
                                                          {"constvolume", import_constant}};

}  // namespace

VolumeTexture import_volume(ImportContext& context, const Element& element) {
  if (element.tag != "volume") fail_at(element, "stands where a <volume> is needed");
  const auto known = context.volumes.find(&element);
  if (known != context.volumes.end()) return known->second;
  Properties properties(context.document, element);
  const VolumeImporter importer = importer_of(element, kImporters, "volume");
  const VolumeTexture volume = importer(context, properties);
  properties.finish();
  return context.volumes[&element] = volume;
}

VolumeTexture volume_property(ImportContext& context, Properties& properties,
                              const std::string& name, const Color& otherwise) {
  if (const Element* object = properties.object(name)) return import_volume(context, *object);
  const Color color = properties.color(name, otherwise);
  if (color.minCoeff() < 0) fail_at(properties.element(), "its {} is negative", name);
  return color;
}

}  // namespace waylight::mitsuba
