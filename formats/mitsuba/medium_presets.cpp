#include "formats/mitsuba/media.h"
#include "formats/mitsuba/types.h"

namespace waylight::mitsuba {
namespace {

// [Jensen, Marschner, Levoy, Hanrahan 2001, A Practical Model for Subsurface Light Transport,
// figure 5], per mm, for red, green, blue.
const std::map<std::string, ScatteringPreset> kPresets = {
    {"apple", {{2.29f, 2.39f, 1.97f}, {0.0030f, 0.0034f, 0.0460f}}},
    {"chicken1", {{0.15f, 0.21f, 0.38f}, {0.0150f, 0.0770f, 0.1900f}}},
    {"chicken2", {{0.19f, 0.25f, 0.32f}, {0.0180f, 0.0880f, 0.2000f}}},
    {"cream", {{7.38f, 5.47f, 3.15f}, {0.0002f, 0.0028f, 0.0163f}}},
    {"ketchup", {{0.18f, 0.07f, 0.03f}, {0.0610f, 0.9700f, 1.4500f}}},
    {"marble", {{2.19f, 2.62f, 3.00f}, {0.0021f, 0.0041f, 0.0071f}}},
    {"potato", {{0.68f, 0.70f, 0.55f}, {0.0024f, 0.0090f, 0.1200f}}},
    {"skimmilk", {{0.70f, 1.22f, 1.90f}, {0.0014f, 0.0025f, 0.0142f}}},
    {"skin1", {{0.74f, 0.88f, 1.01f}, {0.0320f, 0.1700f, 0.4800f}}},
    {"skin2", {{1.09f, 1.59f, 1.79f}, {0.0130f, 0.0700f, 0.1450f}}},
    {"spectralon", {{11.6f, 20.4f, 14.9f}, {0, 0, 0}}},
    {"wholemilk", {{2.55f, 3.21f, 3.77f}, {0.0011f, 0.0024f, 0.0140f}}}};

}  // namespace

std::optional<ScatteringPreset> medium_preset(const std::string& name) {
  std::string key = name;
  for (char& c : key) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto found = kPresets.find(key);
  if (found == kPresets.end()) return std::nullopt;
  return found->second;
}

std::vector<std::string> known_media() { return names_of(kPresets); }

}  // namespace waylight::mitsuba
