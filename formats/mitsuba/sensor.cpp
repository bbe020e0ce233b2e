#include "formats/mitsuba/film.h"
#include "formats/mitsuba/parse_value.h"
#include "formats/mitsuba/types.h"

namespace waylight::mitsuba {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
// Diagonal of 35 mm film in mm, to which focal lengths refer.
const double kFilmDiagonal = std::hypot(36.0, 24.0);

// "50mm", or a number of mm.
double focal_length(const Element& sensor, Properties& properties) {
  double length = 50;
  if (properties.tag("focal_length") == "string") {
    std::string text = properties.text("focal_length", "");
    if (text.ends_with("mm")) text.resize(text.size() - 2);
    length = parse_number(sensor, text);
  } else {
    length = properties.number("focal_length", 50);
  }
  if (!(length > 0)) fail_at(sensor, "its focal_length must be above 0");
  return length;
}

FovAxis import_axis(Properties& properties) {
  static const std::map<std::string, FovAxis> kAxes = {{"x", FovAxis::x},
                                                       {"y", FovAxis::y},
                                                       {"diagonal", FovAxis::diagonal},
                                                       {"smaller", FovAxis::smaller},
                                                       {"larger", FovAxis::larger}};
  return choose(properties, "fov_axis", kAxes, "x");
}

void import_fov(const Element& sensor, Properties& properties, SensorDescription& result) {
  result.fov_axis = import_axis(properties);
  if (properties.has("fov") && properties.has("focal_length"))
    fail_at(sensor, "has both fov and focal_length");
  if (!properties.has("fov")) {
    const double half = std::atan(kFilmDiagonal / (2 * focal_length(sensor, properties)));
    result.fov = static_cast<float>(2 * half);
    result.fov_axis = FovAxis::diagonal;
    return;
  }
  const double degrees = properties.number("fov", 0);
  if (!(degrees > 0 && degrees < 180)) fail_at(sensor, "its fov must lie between 0 and 180");
  result.fov = static_cast<float>(degrees * kDegree);
}

// Mitsuba refuses a scale. For directions a uniform one is without effect, so it is taken out.
Mat4 without_scale(const ImportContext& context, const Element& sensor, Mat4 to_world) {
  const Mat3 linear = to_world.topLeftCorner<3, 3>();
  const Vec3 lengths = linear.colwise().norm();
  const Mat3 rotation = linear * lengths.cwiseInverse().asDiagonal();
  const Mat3 rest = rotation.transpose() * rotation - Mat3::Identity();
  if (!(lengths.maxCoeff() <= 1.001f * lengths.minCoeff() && rest.cwiseAbs().maxCoeff() < 1e-3f))
    fail_at(sensor, "its to_world must be a rotation and a translation");
  if (std::abs(lengths.mean() - 1) > 1e-3f)
    context.warn(fmt::format("{}: the scale of its to_world is left out", sensor.where()));
  to_world.topLeftCorner<3, 3>() = rotation;
  return to_world;
}

void import_lens(const Element& sensor, Properties& properties, SensorDescription& result) {
  if (sensor.type != "thinlens") return properties.ignore({"focus_distance"});
  for (const char* name : {"aperture_radius", "focus_distance"})
    if (!properties.has(name)) fail_at(sensor, "needs {}", name);
  result.aperture_radius = properties.number("aperture_radius", 0);
  result.focus_distance = properties.number("focus_distance", 1);
  if (!(result.aperture_radius >= 0 && result.focus_distance > 0))
    fail_at(sensor, "needs an aperture_radius of at least 0 and a focus_distance above 0");
}

// `shift` is another name of the same offset.
void import_principal_point(Properties& properties, SensorDescription& result) {
  const Vec3 shift = properties.vector("shift", Vec3::Zero());
  result.principal_x =
      properties.number("principal_point_offset_x", properties.number("shift_x", shift.x()));
  result.principal_y =
      properties.number("principal_point_offset_y", properties.number("shift_y", shift.y()));
}

}  // namespace

void import_sensor(ImportContext& context, const Element& sensor) {
  if (sensor.type != "perspective" && sensor.type != "thinlens")
    fail_at(sensor, "unknown sensor{}", did_you_mean(sensor.type, {"perspective", "thinlens"}));
  Properties properties(context.document, sensor);
  SensorDescription& result = context.scene.sensor;
  if (const Element* film = single(properties, "film")) result.film = import_film(context, *film);
  import_fov(sensor, properties, result);
  result.to_world = without_scale(context, sensor, properties.transform("to_world"));
  import_lens(sensor, properties, result);
  import_principal_point(properties, result);
  if (const Element* medium = single(properties, "medium"))
    result.medium = import_medium(context, *medium);
  properties.ignore({"near_clip", "far_clip", "shutter_open", "shutter_close"});
  properties.ignore_objects({"sampler"});
  properties.finish();
}

}  // namespace waylight::mitsuba
