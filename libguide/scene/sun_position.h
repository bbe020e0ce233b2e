#pragma once
// Where the sun stands.

#include "libguide/math/types.h"

namespace waylight {

// Local standard time and place; the defaults are Mitsuba's.
struct DateAndPlace {
  int year = 2010, month = 7, day = 10;
  float hour = 15, minute = 0, second = 0;
  float latitude = 35.6894f, longitude = 139.6917f;  // degrees, north and east positive
  float timezone = 9;                                // hours east of Greenwich
};

// Unit direction to the sun, x east, y up, z south [Preetham et al. 1999, appendix A.6]: within a
// degree. Below the horizon y is negative. Throws Error naming a field that is out of its range.
Vec3 sun_direction(const DateAndPlace& when);

}  // namespace waylight
