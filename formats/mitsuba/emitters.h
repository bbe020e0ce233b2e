#pragma once
// Importers of single emitters; each adds to context.scene.emitters.

#include "formats/mitsuba/import_context.h"

namespace waylight::mitsuba {

// Rotation of a transform, whatever its scale and translation; Error for a skewed one.
Mat3 rotation_property(Properties& properties, const std::string& name);

// emitters_sky.cpp
void import_sky(ImportContext& context, Properties& properties);
void import_sun(ImportContext& context, Properties& properties);
void import_sun_and_sky(ImportContext& context, Properties& properties);

}  // namespace waylight::mitsuba
