#include "formats/mitsuba/materials.h"
#include "formats/mitsuba/types.h"

namespace waylight::mitsuba {
namespace {

// Measured spectra [Palik, Handbook of Optical Constants of Solids, 1985] integrated against the
// colour matching functions and turned to linear sRGB as they are, without adaptation of white:
// the numbers that RGB renderers and exported scenes use for these names. "none" reflects all.
const std::map<std::string, ComplexIor> kMetals = {
    {"none", {{0, 0, 0}, {1, 1, 1}}},
    {"Ag", {{0.155265f, 0.116723f, 0.138381f}, {4.82834f, 3.12225f, 2.14705f}}},
    {"Al", {{1.65746f, 0.880369f, 0.521229f}, {9.22387f, 6.26952f, 4.83700f}}},
    {"Au", {{0.143119f, 0.374957f, 1.44248f}, {3.98316f, 2.38572f, 1.60322f}}},
    {"Be", {{4.18506f, 3.18506f, 2.78409f}, {3.83544f, 3.01013f, 2.86901f}}},
    {"Cr", {{4.36968f, 2.91670f, 1.65470f}, {5.20643f, 4.23136f, 3.75495f}}},
    {"Cu", {{0.200438f, 0.924033f, 1.10221f}, {3.91295f, 2.45285f, 2.14219f}}},
    {"Hg", {{2.39893f, 1.44003f, 0.909551f}, {6.32763f, 4.37194f, 3.42179f}}},
    {"Ir", {{3.08641f, 2.08219f, 1.61789f}, {5.59215f, 4.06718f, 3.26726f}}},
    {"Li", {{0.265787f, 0.195610f, 0.220920f}, {3.54017f, 2.31113f, 1.66859f}}},
    {"Mo", {{4.48370f, 3.52546f, 2.77608f}, {4.11113f, 3.42087f, 3.15060f}}},
    {"Ni", {{2.36728f, 1.66336f, 1.46706f}, {4.49883f, 3.05016f, 2.34543f}}},
    {"Rh", {{2.58580f, 1.86019f, 1.55443f}, {6.78229f, 4.70295f, 3.97609f}}},
    {"TiN", {{1.64847f, 1.15045f, 1.37978f}, {3.36846f, 1.94349f, 1.10201f}}},
    {"W", {{4.37070f, 3.30030f, 2.99827f}, {3.50068f, 2.60487f, 2.27319f}}}};

}  // namespace

std::optional<ComplexIor> metal_preset(const std::string& name) {
  const auto found = kMetals.find(name);
  if (found == kMetals.end()) return std::nullopt;
  return found->second;
}

std::vector<std::string> known_metals() { return names_of(kMetals); }

}  // namespace waylight::mitsuba
