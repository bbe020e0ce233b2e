#pragma once

#include "formats/mitsuba/import_context.h"

namespace waylight::mitsuba {

// <film> with its <rfilter>.
FilmDescription import_film(ImportContext& context, const Element& film);

}  // namespace waylight::mitsuba
