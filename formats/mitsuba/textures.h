#pragma once
// Textures that importers of other things need in a plainer form.

#include "formats/image_io.h"
#include "formats/mitsuba/import_context.h"

namespace waylight::mitsuba {

// How a picture named by an element is to be read: its `raw` and `gamma` properties.
ColorSpace color_space_property(ImportContext& context, Properties& properties);

// The picture of the property `filename`, read once for each colour space.
std::shared_ptr<const Bitmap> bitmap_property(ImportContext& context, Properties& properties,
                                              ColorSpace space);

}  // namespace waylight::mitsuba
