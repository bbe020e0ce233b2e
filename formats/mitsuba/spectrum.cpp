#include "formats/mitsuba/import_context.h"
#include "libguide/math/color_matching.h"

namespace waylight::mitsuba {
namespace {

// Where the eye sees anything, nm. Sums are over its whole nanometres.
constexpr int kFirst = 360, kLast = 830;

// Piecewise linear, zero outside. Wavelengths increase.
double value_at(const std::vector<std::pair<float, float>>& samples, float nm) {
  const auto next = std::upper_bound(samples.begin(), samples.end(), nm,
                                     [](float x, const auto& sample) { return x < sample.first; });
  if (next == samples.begin()) return 0;
  const auto& [left, value] = *(next - 1);
  if (next == samples.end()) return nm == left ? value : 0;
  return lerp(value, next->second, (nm - left) / (next->first - left));
}

// Planck's law, W / (m^2 sr nm).
double planck(double nm, double kelvin) {
  constexpr double kSpeed = 299792458, kPlanck = 6.62607015e-34, kBoltzmann = 1.380649e-23;
  const double m = nm * 1e-9, exponent = kPlanck * kSpeed / (m * kBoltzmann * kelvin);
  return 2e-9 * kPlanck * kSpeed * kSpeed / (std::pow(m, 5) * std::expm1(exponent));
}

Color in_gamut(const Eigen::Array3d& xyz) {
  return xyz_to_linear_srgb(xyz).cast<float>().max(0.0f);
}

}  // namespace

Color spectrum_to_rgb(const std::vector<std::pair<float, float>>& samples) {
  Eigen::Array3d sum = Eigen::Array3d::Zero(), flat = Eigen::Array3d::Zero();
  for (int nm = kFirst; nm <= kLast; ++nm) {
    const Eigen::Array3d weights = color_matching(nm);
    sum += weights * value_at(samples, static_cast<float>(nm));
    flat += weights;
  }
  return in_gamut(sum / flat * white_xyz());
}

Color blackbody_rgb(float kelvin, float scale) {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (int nm = kFirst; nm <= kLast; ++nm) sum += color_matching(nm) * planck(nm, kelvin);
  return scale * in_gamut(sum / kLuminanceIntegral);
}

}  // namespace waylight::mitsuba
