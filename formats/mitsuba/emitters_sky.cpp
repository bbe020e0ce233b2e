// Daylight: `sky`, `sun` and `sunsky`.

#include "formats/mitsuba/emitters.h"
#include "libguide/scene/clear_sky.h"
#include "libguide/scene/sun_position.h"

namespace waylight::mitsuba {
namespace {

constexpr float kSunAperture = 0.5358f;  // degrees across, what the new dialect takes for one sun

// The sky's own y is up. The old dialect agrees; the new one has z up and north along y.
Mat3 axes(const ImportContext& context) {
  Mat3 m = Mat3::Identity();
  if (!context.document.old_dialect) m << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return m;
}

DateAndPlace date_property(Properties& properties) {
  DateAndPlace w;
  w.year = properties.integer("year", w.year);
  w.month = properties.integer("month", w.month);
  w.day = properties.integer("day", w.day);
  w.hour = properties.number("hour", w.hour);
  w.minute = properties.number("minute", w.minute);
  w.second = properties.number("second", w.second);
  w.latitude = properties.number("latitude", w.latitude);
  w.longitude = properties.number("longitude", w.longitude);
  w.timezone = properties.number("timezone", w.timezone);
  return w;
}

// In the sky's own axes. `sun_direction` is given in the world, the date stands for all else.
Vec3 sun_property(Properties& properties, const Mat3& to_world) {
  const DateAndPlace when = date_property(properties);
  if (!properties.has("sun_direction")) return sun_direction(when);
  const Vec3 given = properties.vector("sun_direction", Vec3::UnitY());
  if (!(given.norm() > 0)) fail_at(properties.element(), "its sun_direction is zero");
  return (to_world.transpose() * given).normalized();
}

// `scale` is that of both, beside the single ones.
ClearSkyParameters parameters(ImportContext& context, Properties& properties) {
  ClearSkyParameters p;
  p.to_world = rotation_property(properties, "to_world") * axes(context);
  p.sun_direction = sun_property(properties, p.to_world);
  p.turbidity = properties.number("turbidity", 3);
  const float scale = properties.number("scale", 1);
  p.sky_scale = scale * properties.number("sky_scale", 1);
  p.sun_scale = scale * properties.number("sun_scale", 1);
  p.sun_radius_scale = properties.number("sun_radius_scale", 1);
  p.sun_radius_scale *= properties.number("sun_aperture", kSunAperture) / kSunAperture;
  p.resolution = properties.integer("resolution", 512);
  // The model's ground is black; the rest steers how Mitsuba bakes and stretches its sky.
  properties.ignore({"albedo", "samples_count", "complex_sun"});
  for (const char* name : {"stretch", "extend"})
    if (properties.has(name))
      context.warn(fmt::format("{}: {} is ignored", properties.element().where(), name));
  return p;
}

// Errors of the model name what is wrong; this adds where.
template <typename Make>
void add(ImportContext& context, Properties& properties, Make make) {
  try {
    make(parameters(context, properties));
  } catch (const Error& error) {
    const std::string what = error.what();
    if (what.starts_with("sky: ") || what.starts_with("sun: "))
      fail_at(properties.element(), "{}", what.substr(5));
    throw;
  }
}

}  // namespace

void import_sky(ImportContext& context, Properties& properties) {
  add(context, properties,
      [&](const ClearSkyParameters& p) { context.scene.emitters.push_back(bake_clear_sky(p)); });
}

void import_sun(ImportContext& context, Properties& properties) {
  add(context, properties,
      [&](const ClearSkyParameters& p) { context.scene.emitters.push_back(make_sun(p)); });
}

void import_sun_and_sky(ImportContext& context, Properties& properties) {
  add(context, properties, [&](const ClearSkyParameters& p) {
    context.scene.emitters.push_back(bake_clear_sky(p));
    context.scene.emitters.push_back(make_sun(p));
  });
}

}  // namespace waylight::mitsuba
