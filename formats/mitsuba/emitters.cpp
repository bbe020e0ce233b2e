#include "formats/mitsuba/emitters.h"

#include "formats/mitsuba/textures.h"
#include "formats/mitsuba/types.h"

namespace waylight::mitsuba {
namespace {

float radians(float degrees) { return degrees * kPi / 180; }

// What a light gives off; one of unit strength where the scene says nothing.
Color emission_property(Properties& properties, const std::string& name) {
  const Color color = properties.color(name, Color::Ones());
  if (color.minCoeff() < 0) fail_at(properties.element(), "its {} is negative", name);
  return color;
}

// Where a transform puts the +z axis.
Vec3 forward_property(Properties& properties, const Mat4& to_world) {
  const Vec3 forward = to_world.topLeftCorner<3, 3>() * Vec3::UnitZ();
  if (!(forward.norm() > 0)) fail_at(properties.element(), "its to_world has no inverse");
  return forward.normalized();
}

void refuse_both(Properties& properties, const std::string& name) {
  if (properties.has(name) && properties.has("to_world"))
    fail_at(properties.element(), "has a {} beside a to_world; give one or the other", name);
}

// `intensity` in W / sr, or the old dialect's `power` in W, spread evenly over all directions.
Color intensity_property(Properties& properties) {
  if (!properties.has("power")) return emission_property(properties, "intensity");
  if (properties.has("intensity"))
    fail_at(properties.element(), "has a power beside an intensity; give one or the other");
  return emission_property(properties, "power") / (4 * kPi);
}

void import_point(ImportContext& context, Properties& properties) {
  refuse_both(properties, "position");
  const Vec3 origin = properties.transform("to_world").topRightCorner<3, 1>();
  context.scene.emitters.push_back(
      PointLight{properties.vector("position", origin), intensity_property(properties)});
}

void import_spot(ImportContext& context, Properties& properties) {
  const Element& element = properties.element();
  if (properties.has("texture"))
    fail_at(element, "a texture of a spot light is not supported; leave it out");
  const float cutoff = properties.number("cutoff_angle", 20);
  const float beam_width = properties.number("beam_width", 0.75f * cutoff);
  if (!(cutoff > 0 && cutoff <= 180))
    fail_at(element, "its cutoff_angle {} is outside of 0..180 degrees", cutoff);
  if (!(beam_width >= 0 && beam_width <= cutoff))
    fail_at(element, "its beam_width {} is outside of 0..cutoff_angle", beam_width);
  const Mat4 to_world = properties.transform("to_world");
  context.scene.emitters.push_back(
      SpotLight{to_world.topRightCorner<3, 1>(), forward_property(properties, to_world),
                emission_property(properties, "intensity"), radians(cutoff), radians(beam_width)});
}

void import_directional(ImportContext& context, Properties& properties) {
  refuse_both(properties, "direction");
  const Vec3 forward = forward_property(properties, properties.transform("to_world"));
  const Vec3 direction = properties.vector("direction", forward);
  if (!(direction.norm() > 0)) fail_at(properties.element(), "its direction is zero");
  context.scene.emitters.push_back(
      DirectionalLight{direction.normalized(), emission_property(properties, "irradiance")});
}

void import_constant(ImportContext& context, Properties& properties) {
  properties.ignore({"to_world"});  // the same from everywhere
  context.scene.emitters.push_back(ConstantEnvironment{emission_property(properties, "radiance")});
}

void import_environment(ImportContext& context, Properties& properties) {
  const ColorSpace space = color_space_property(context, properties);
  const float scale = properties.number("scale", 1);
  if (!(scale >= 0)) fail_at(properties.element(), "its scale is negative");
  properties.ignore({"mis_compensation", "cache"});
  context.scene.emitters.push_back(EnvironmentMap{bitmap_property(context, properties, space),
                                                  scale,
                                                  rotation_property(properties, "to_world"),
                                                  !context.document.old_dialect});
}

void refuse_area(ImportContext& /*context*/, Properties& properties) {
  fail_at(properties.element(), "an area light belongs into the shape that shines");
}

using EmitterImporter = void (*)(ImportContext&, Properties&);
const std::map<std::string, EmitterImporter> kImporters = {
    {"area", refuse_area},         {"point", import_point},
    {"spot", import_spot},         {"directional", import_directional},
    {"constant", import_constant}, {"envmap", import_environment},
    {"sky", import_sky},           {"sun", import_sun},
    {"sunsky", import_sun_and_sky}};

// How often to sample a light is the renderer's choice here.
void finish(Properties& properties) {
  properties.ignore({"sampling_weight"});
  properties.finish();
}

}  // namespace

Mat3 rotation_property(Properties& properties, const std::string& name) {
  const Mat3 linear = properties.transform(name).topLeftCorner<3, 3>();
  const float scale = std::cbrt(std::abs(linear.determinant()));
  const Mat3 unit = linear / scale;
  if (!(scale > 0) || !(unit.transpose() * unit).isIdentity(1e-3f))
    fail_at(properties.element(), "its {} is skewed or flat; only rotations make sense here", name);
  const Eigen::JacobiSVD<Mat3> svd(unit, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

void import_emitter(ImportContext& context, const Element& emitter) {
  Properties properties(context.document, emitter);
  const EmitterImporter importer = importer_of(emitter, kImporters, "emitter");
  importer(context, properties);
  finish(properties);
}

Texture import_area_radiance(ImportContext& context, const Element& emitter) {
  Properties properties(context.document, emitter);
  if (emitter.type != "area")
    fail_at(emitter, "only an area light can be in a shape{}",
            did_you_mean(emitter.type, {"area"}));
  const Texture radiance =
      texture_property(context, properties, "radiance", Texture(Color(Color::Ones())));
  if (context.document.old_dialect && properties.has("scale"))
    context.warn(
        fmt::format("{}: an area light has no scale, ignored as Mitsuba does", emitter.where()));
  finish(properties);
  return radiance;
}

}  // namespace waylight::mitsuba
