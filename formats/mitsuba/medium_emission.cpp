#include "formats/mitsuba/media.h"

namespace waylight::mitsuba {
namespace {

void check_radiance(const Element& element, const VolumeTexture& radiance) {
  const auto negative = [](float value) { return !(value >= 0); };
  if (const Color* color = std::get_if<Color>(&radiance)) {
    if (negative(color->minCoeff())) fail_at(element, "its emission is negative");
    return;
  }
  if (negative(std::get<std::shared_ptr<const VolumeGrid>>(radiance)->voxels.range().least))
    fail_at(element, "the grid of its emission has negative values");
}

}  // namespace

MediumEmission emission_property(ImportContext& context, Properties& properties, bool may_vary) {
  const Element& element = properties.element();
  MediumEmission emission;
  emission.radiance = volume_property(context, properties, "emission", Color::Zero());
  check_radiance(element, emission.radiance);
  if (!may_vary && !std::holds_alternative<Color>(emission.radiance))
    fail_at(element, "its emission varies; that needs a heterogeneous medium");
  if (!properties.has("emission") && properties.has("emission_scale"))
    fail_at(element, "has an emission_scale without an emission");
  emission.scale = properties.color("emission_scale", Color::Ones());
  if (!(emission.scale.minCoeff() >= 0)) fail_at(element, "its emission_scale is negative");
  return emission;
}

}  // namespace waylight::mitsuba
