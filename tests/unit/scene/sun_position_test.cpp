#include "libguide/scene/sun_position.h"

#include <gtest/gtest.h>

#include "libguide/base/error.h"

namespace waylight {
namespace {

float elevation(const DateAndPlace& when) { return std::asin(sun_direction(when).y()) * 180 / kPi; }

DateAndPlace at(int month, int day, float hour, float latitude) {
  DateAndPlace when;
  when.month = month;
  when.day = day;
  when.hour = hour;
  when.latitude = latitude;
  when.longitude = when.timezone = 0;
  return when;
}

// At noon of an equinox the sun is at the zenith of the equator, of a solstice 23.4 degrees off.
TEST(SunPosition, NoonOfEquinoxAndSolstice) {
  EXPECT_NEAR(elevation(at(3, 21, 12, 0)), 90, 2.5f);
  EXPECT_NEAR(elevation(at(6, 21, 12, 23.44f)), 90, 1);
  EXPECT_NEAR(elevation(at(6, 21, 12, 50)), 63.4f, 1);
  EXPECT_NEAR(elevation(at(12, 21, 12, 50)), 16.6f, 1);
}

TEST(SunPosition, RisesInTheEastAndStandsInTheSouthAtNoon) {
  const Vec3 morning = sun_direction(at(6, 21, 8, 50)), noon = sun_direction(at(6, 21, 12, 50));
  EXPECT_GT(morning.x(), 0.5f);
  EXPECT_GT(noon.z(), 0.3f);  // z is south
  EXPECT_NEAR(noon.x(), 0, 0.02f);
  EXPECT_LT(sun_direction(at(6, 21, 0, 50)).y(), 0);
}

TEST(SunPosition, LongitudeAndTimezoneShiftTheClock) {
  DateAndPlace east = at(6, 21, 12, 50);
  east.longitude = 15;
  east.timezone = 1;
  EXPECT_LT((sun_direction(east) - sun_direction(at(6, 21, 12, 50))).norm(), 1e-5f);
}

TEST(SunPosition, DatesThatAreNoneAreErrors) {
  DateAndPlace leap = at(2, 29, 12, 50);
  EXPECT_THROW(sun_direction(leap), Error);
  leap.year = 2012;
  EXPECT_NO_THROW(sun_direction(leap));
  EXPECT_THROW(sun_direction(at(0, 1, 12, 50)), Error);
  EXPECT_THROW(sun_direction(at(4, 31, 12, 50)), Error);
  EXPECT_THROW(sun_direction(at(4, 1, 25, 50)), Error);
  EXPECT_THROW(sun_direction(at(4, 1, 12, 91)), Error);
  EXPECT_THROW(sun_direction(at(4, 1, 12, NAN)), Error);
}

}  // namespace
}  // namespace waylight
