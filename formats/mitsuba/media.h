#pragma once
// What the importers of media share.

#include <optional>

#include "formats/mitsuba/import_context.h"

namespace waylight::mitsuba {

// media.cpp
PhaseFunction import_phase(ImportContext& context, const Element& element);

// volumes.cpp
// One element is imported once.
VolumeTexture import_volume(ImportContext& context, const Element& element);
// A property that is a <volume>, a colour or a number; Error for a negative one.
VolumeTexture volume_property(ImportContext& context, Properties& properties,
                              const std::string& name, const Color& otherwise);

// medium_emission.cpp: `emission`, a colour or a volume of radiance, times `emission_scale`, a
// colour or a number. may_vary: whether a grid is allowed.
MediumEmission emission_property(ImportContext& context, Properties& properties, bool may_vary);

// medium_presets.cpp: scattering (reduced, for an isotropic phase) and absorption per mm.
struct ScatteringPreset {
  Color sigma_s, sigma_a;
};
std::optional<ScatteringPreset> medium_preset(const std::string& name);
std::vector<std::string> known_media();

}  // namespace waylight::mitsuba
