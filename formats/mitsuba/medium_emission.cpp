#include "formats/mitsuba/media.h"

namespace waylight::mitsuba {

MediumEmission emission_property(ImportContext& context, Properties& properties, bool may_vary) {
  const Element& element = properties.element();
  MediumEmission emission;
  emission.radiance = volume_property(context, properties, "emission", Color::Zero());
  if (!may_vary && !std::holds_alternative<Color>(emission.radiance))
    fail_at(element, "its emission varies; that needs a heterogeneous medium");
  if (!properties.has("emission") && properties.has("emission_scale"))
    fail_at(element, "has an emission_scale without an emission");
  emission.scale = properties.color("emission_scale", Color::Ones());
  if (!(emission.scale.minCoeff() >= 0)) fail_at(element, "its emission_scale is negative");
  return emission;
}

}  // namespace waylight::mitsuba
