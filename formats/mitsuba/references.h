#pragma once
// Ids and what refers to them.

#include "formats/mitsuba/element.h"

namespace waylight::mitsuba {

// Fills document.ids. Throws Error for an id that is given twice, naming both places.
void collect_ids(Document& document, const std::vector<Element>& aliases);

// Elements at the top of the scene that no <ref> leads to.
std::vector<const Element*> unreferenced(const Document& document);

// Throws Error for a <ref> without target and for elements that contain themselves, so that
// whoever follows references need not fear endless or very deep recursion.
void check_references(const Document& document);

}  // namespace waylight::mitsuba
