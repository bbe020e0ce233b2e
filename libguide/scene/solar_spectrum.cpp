#include "libguide/scene/solar_spectrum.h"

#include <cmath>
#include <numbers>

namespace waylight {
namespace {

// Every 10 nm from 380 to 750, [Preetham et al. 1999, table 2]: radiance of the sun outside of the
// atmosphere, W / (m^2 sr nm), and absorption of ozone (1/cm) and of water vapour.
struct SolarBand {
  double radiance, ozone, water;
};
constexpr double kFirstWavelength = 380, kStep = 10;
constexpr SolarBand kBands[] = {
    {16559.0, 0.0, 0.0},   {16233.7, 0.0, 0.0},    {21127.5, 0.0, 0.0},   {25888.2, 0.0, 0.0},
    {25829.1, 0.0, 0.0},   {24232.3, 0.0, 0.0},    {26760.5, 0.0, 0.0},   {29658.3, 0.003, 0.0},
    {30545.4, 0.006, 0.0}, {30057.5, 0.009, 0.0},  {30663.7, 0.014, 0.0}, {28830.4, 0.021, 0.0},
    {28712.1, 0.030, 0.0}, {27825.0, 0.040, 0.0},  {27100.6, 0.048, 0.0}, {27233.6, 0.063, 0.0},
    {26361.3, 0.075, 0.0}, {25503.8, 0.085, 0.0},  {25060.2, 0.103, 0.0}, {25311.6, 0.120, 0.0},
    {25355.9, 0.120, 0.0}, {25134.2, 0.115, 0.0},  {24631.5, 0.125, 0.0}, {24173.2, 0.120, 0.0},
    {23685.3, 0.090, 0.0}, {23212.1, 0.067, 0.0},  {22827.7, 0.048, 0.0}, {22339.8, 0.028, 0.0},
    {21970.2, 0.018, 0.0}, {21526.7, 0.011, 0.0},  {21097.9, 0.009, 0.0}, {20728.3, 0.004, 0.016},
    {20240.4, 0.0, 0.024}, {19870.8, 0.0, 0.0125}, {19427.2, 0.0, 1.0},   {19072.4, 0.0, 0.87},
    {18628.9, 0.0, 0.061}, {18259.2, 0.0, 0.001},
};

// Share of sunlight that comes through, [Preetham et al. 1999, appendix A.1] with the exponents of
// [Iqbal 1983]: Rayleigh, aerosol, 0.35 cm of ozone, 2 cm of water. (The paper prints the air mass
// in the exponent of the wavelength, which gives no blue loss at noon.) The mixed gases absorb only
// above 759 nm.
double transmittance(const SolarBand& band, double nm, double air_mass, double turbidity) {
  const double um = nm / 1000, aerosol = 0.04608 * turbidity - 0.04586;
  const double water = band.water * 2.0 * air_mass;
  const double optical_depth = air_mass * (0.008735 * std::pow(um, -4.08) +
                                           aerosol * std::pow(um, -1.3) + 0.35 * band.ozone) +
                               0.2385 * water / std::pow(1 + 20.07 * water, 0.45);
  return std::exp(-optical_depth);
}

}  // namespace

Eigen::Array3d sun_xyz(double polar_angle, double turbidity) {
  const double degrees = polar_angle * 180 / std::numbers::pi;
  const double air_mass = 1 / (std::cos(polar_angle) + 0.15 * std::pow(93.885 - degrees, -1.253));
  Eigen::Array3d xyz = Eigen::Array3d::Zero();
  double nm = kFirstWavelength;
  for (const SolarBand& band : kBands) {
    xyz +=
        color_matching(nm) * (band.radiance * transmittance(band, nm, air_mass, turbidity) * kStep);
    nm += kStep;
  }
  return xyz / kLuminanceIntegral;
}

}  // namespace waylight
