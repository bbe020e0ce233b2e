#include "libguide/scene/sun_position.h"

#include "libguide/base/error.h"

namespace waylight {
namespace {

constexpr int kDaysBefore[] = {0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334, 365};

bool is_leap(int year) { return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0); }

void check_range(const char* field, double value, double least, double most) {
  if (!(value >= least && value <= most))
    fail("sun: {} {} is outside of {}..{}", field, value, least, most);
}

void check(const DateAndPlace& w) {
  check_range("year", w.year, 1, 9999);
  check_range("month", w.month, 1, 12);
  const int days = kDaysBefore[w.month] - kDaysBefore[w.month - 1];
  check_range("day", w.day, 1, days + (w.month == 2 && is_leap(w.year)));
  check_range("hour", w.hour, 0, 24);
  check_range("minute", w.minute, 0, 60);
  check_range("second", w.second, 0, 60);
  check_range("latitude", w.latitude, -90, 90);
  check_range("longitude", w.longitude, -180, 180);
  check_range("timezone", w.timezone, -15, 15);
}

double turn(double share) { return 2 * std::numbers::pi * share; }
double radians(double degrees) { return turn(degrees / 360); }

// Hours; 12 when the sun is highest. The two sines are the equation of time.
double solar_time(const DateAndPlace& w, double day) {
  const double clock = w.hour + w.minute / 60.0 + w.second / 3600.0;
  const double equation =
      0.170 * std::sin(turn(2 * (day - 80) / 373)) - 0.129 * std::sin(turn((day - 8) / 355));
  return clock + equation + w.longitude / 15.0 - w.timezone;
}

}  // namespace

Vec3 sun_direction(const DateAndPlace& w) {
  check(w);
  const double day = kDaysBefore[w.month - 1] + w.day + (w.month > 2 && is_leap(w.year));
  const double declination = 0.4093 * std::sin(turn((day - 81) / 368));
  const double hour_angle = turn((solar_time(w, day) - 12) / 24), latitude = radians(w.latitude);
  const double along = std::cos(declination) * std::cos(hour_angle), height = std::sin(declination);
  const double east = -std::cos(declination) * std::sin(hour_angle);
  const double up = std::sin(latitude) * height + std::cos(latitude) * along;
  const double north = std::cos(latitude) * height - std::sin(latitude) * along;
  return Eigen::Vector3d(east, up, -north).normalized().cast<float>();
}

}  // namespace waylight
