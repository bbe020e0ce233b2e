#pragma once
// Daylight of a clear sky from formulas alone [Preetham, Shirley, Smits 1999, A Practical Analytic
// Model for Daylight].
//
// Unit: mean spectral radiance, W / (m^2 sr nm), in linear sRGB, so that a flat spectrum of one has
// luminance one: the unit of Mitsuba's `sky`, `sun` and `sunsky`. A clear zenith is about 0.1,
// the sun's disk about 2e4. Below the horizon the sky is black, as in Mitsuba.

#include "libguide/scene/scene_description.h"

namespace waylight {

struct ClearSkyParameters {
  Vec3 sun_direction = Vec3::UnitY();  // unit, towards the sun, in the sky's own axes (y is up)
  float turbidity = 3;                 // 2 (very clear) .. 10 (hazy)
  float sky_scale = 1, sun_scale = 1;  // >= 0
  // In (0.05, 100]: of the angular radius 0.2666 degrees; irradiance kept. Below, its cosine is 1.
  float sun_radius_scale = 1;
  Mat3 to_world = Mat3::Identity();  // rotation
  int resolution = 512;              // width of the picture in pixels, height is half, >= 8
};

// Both throw Error when a parameter is out of range or the sun is below the horizon.
EnvironmentMap bake_clear_sky(const ClearSkyParameters& parameters);
DistantDisk make_sun(const ClearSkyParameters& parameters);

}  // namespace waylight
