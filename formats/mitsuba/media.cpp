#include "formats/mitsuba/media.h"

#include "formats/mitsuba/types.h"

namespace waylight::mitsuba {
namespace {

// Defaults of the new dialect.
const Color kSigmaT = Color::Ones(), kAlbedo = Color::Constant(0.75f);

PhaseFunction henyey_greenstein(Properties& properties, float otherwise) {
  const float g = properties.number("g", otherwise);
  if (!(std::abs(g) < 1))
    fail_at(properties.element(), "its mean cosine g {} is outside of -1..1", g);
  return HenyeyGreenstein{g};
}

PhaseFunction import_hg(Properties& properties) { return henyey_greenstein(properties, 0.8f); }
PhaseFunction import_isotropic(Properties& /*properties*/) { return IsotropicPhase{}; }

using PhaseImporter = PhaseFunction (*)(Properties&);
const std::map<std::string, PhaseImporter> kPhases = {{"hg", import_hg},
                                                      {"isotropic", import_isotropic}};

// A nested <phase>, else the old dialect's g of the medium itself, else isotropic.
PhaseFunction phase_property(ImportContext& context, Properties& medium) {
  if (const Element* nested = single(medium, "phase")) return import_phase(context, *nested);
  return medium.has("g") ? henyey_greenstein(medium, 0) : PhaseFunction(IsotropicPhase{});
}

float scale_property(Properties& properties) {
  const float scale = properties.number("scale", 1);
  if (!(scale >= 0)) fail_at(properties.element(), "its scale is negative");
  return scale;
}

HomogeneousMedium from_scattering(const Color& sigma_s, const Color& sigma_a, float scale) {
  const Color sigma_t = sigma_s + sigma_a;
  const Color albedo = (sigma_t > 0).select(sigma_s / sigma_t.max(1e-30f), Color(Color::Zero()));
  return {scale * sigma_t, albedo};
}

HomogeneousMedium from_preset(Properties& properties, float scale) {
  const std::string name = properties.text("material", "skin1");
  const std::optional<ScatteringPreset> preset = medium_preset(name);
  if (!preset)
    fail_at(properties.element(), "unknown material \"{}\"; give sigma_s and sigma_a instead{}",
            name, did_you_mean(name, known_media()));
  return from_scattering(preset->sigma_s, preset->sigma_a, scale);
}

Color coefficient(Properties& properties, const std::string& name) {
  const Color color = properties.color(name, Color::Zero());
  if (color.minCoeff() < 0) fail_at(properties.element(), "its {} is negative", name);
  return color;
}

float most_of(const VolumeTexture& volume) {
  if (const Color* color = std::get_if<Color>(&volume)) return color->maxCoeff();
  return std::get<std::shared_ptr<const VolumeGrid>>(volume)->voxels.range().most;
}

void check_albedo(const Element& element, const VolumeTexture& albedo) {
  if (most_of(albedo) > 1) fail_at(element, "its albedo is above 1");
}

// A colour that may be written as a volume of one value.
Color constant_volume(ImportContext& context, Properties& properties, const std::string& name,
                      const Color& otherwise) {
  const VolumeTexture volume = volume_property(context, properties, name, otherwise);
  if (const Color* color = std::get_if<Color>(&volume)) return *color;
  fail_at(properties.element(), "its {} varies; that needs a heterogeneous medium", name);
}

HomogeneousMedium from_extinction(ImportContext& context, Properties& properties, float scale) {
  const Element& element = properties.element();
  if (context.document.old_dialect && !(properties.has("sigma_t") && properties.has("albedo")))
    fail_at(element, "needs both sigma_t and albedo");
  const Color sigma_t = constant_volume(context, properties, "sigma_t", kSigmaT);
  const Color albedo = constant_volume(context, properties, "albedo", kAlbedo);
  check_albedo(element, albedo);
  return {scale * sigma_t, albedo};
}

// One of: sigma_s and sigma_a; sigma_t and albedo; a material by name. With nothing said the old
// dialect takes "skin1", the new one its defaults of sigma_t and albedo.
std::variant<HomogeneousMedium, HeterogeneousMedium> import_homogeneous(ImportContext& context,
                                                                        Properties& properties) {
  const bool scattering = properties.has("sigma_s") || properties.has("sigma_a");
  const bool extinction = properties.has("sigma_t") || properties.has("albedo");
  const bool preset = properties.has("material");
  if (scattering + extinction + preset > 1)
    fail_at(properties.element(),
            "mixes sigma_s/sigma_a, sigma_t/albedo and material; give one of the three");
  properties.ignore({"strategy", "sampling_weight", "medium_sampling_weight", "sample_emitters"});
  const float scale = scale_property(properties);
  if (preset || (context.document.old_dialect && !scattering && !extinction))
    return from_preset(properties, scale);
  if (!scattering) return from_extinction(context, properties, scale);
  if (!(properties.has("sigma_s") && properties.has("sigma_a")))
    fail_at(properties.element(), "needs both sigma_s and sigma_a");
  return from_scattering(coefficient(properties, "sigma_s"), coefficient(properties, "sigma_a"),
                         scale);
}

// The old dialect's `density` is the new one's `sigma_t`.
std::variant<HomogeneousMedium, HeterogeneousMedium> import_heterogeneous(ImportContext& context,
                                                                          Properties& properties) {
  const bool old = context.document.old_dialect;
  const char* density = old ? "density" : "sigma_t";
  for (const char* name : {density, "albedo"})
    if (old && !properties.has(name))
      fail_at(properties.element(), "needs a <volume> \"{}\"", name);
  if (properties.has("orientation"))
    fail_at(properties.element(), "oriented (micro-flake) media are not supported");
  properties.ignore({"method", "step_size", "step_size_scale", "sample_emitters"});
  const HeterogeneousMedium medium = {volume_property(context, properties, density, kSigmaT),
                                      volume_property(context, properties, "albedo", kAlbedo),
                                      scale_property(properties)};
  check_albedo(properties.element(), medium.albedo);
  return medium;
}

// The longest way through the box of a grid.
float extent_of(const VolumeTexture& volume) {
  const auto* grid = std::get_if<std::shared_ptr<const VolumeGrid>>(&volume);
  return grid ? (*grid)->grid_to_world.topLeftCorner<3, 3>().norm() : 0;
}

void check_finite(const Element& element, float extinction) {
  if (!std::isfinite(extinction))
    fail_at(element, "its extinction is not finite; give it a smaller scale");
}

void check_extinction(const Element& element, const HomogeneousMedium& medium) {
  check_finite(element, medium.sigma_t.sum());
}

void check_extinction(const Element& element, const HeterogeneousMedium& medium) {
  // Beyond some 2^24, steps between collisions vanish in the rounding of distances along a ray.
  constexpr float kMostDepth = 1e6f;
  const float most = medium.scale * most_of(medium.density);
  check_finite(element, most);
  const float depth = most * extent_of(medium.density);
  if (!(depth <= kMostDepth))
    fail_at(element,
            "its grid is up to {:g} mean free paths thick, at most {:g} are possible; give it a "
            "smaller scale",
            depth, kMostDepth);
}

using MediumImporter = std::variant<HomogeneousMedium, HeterogeneousMedium> (*)(ImportContext&,
                                                                                Properties&);
const std::map<std::string, MediumImporter> kImporters = {{"homogeneous", import_homogeneous},
                                                          {"heterogeneous", import_heterogeneous}};

// Whether the albedo is below one anywhere.
bool absorbs(const Medium& medium) {
  if (const auto* homogeneous = std::get_if<HomogeneousMedium>(&medium.coefficients))
    return (homogeneous->albedo < 1).any();
  const VolumeTexture& albedo = std::get<HeterogeneousMedium>(medium.coefficients).albedo;
  if (const Color* color = std::get_if<Color>(&albedo)) return (*color < 1).any();
  return std::get<std::shared_ptr<const VolumeGrid>>(albedo)->voxels.range().least < 1;
}

Medium import_new(ImportContext& context, const Element& element) {
  if (element.tag != "medium") fail_at(element, "stands where a <medium> is needed");
  Properties properties(context.document, element);
  const MediumImporter importer = importer_of(element, kImporters, "medium");
  Medium medium;
  medium.name = label_of(element);
  medium.coefficients = importer(context, properties);
  std::visit([&](const auto& m) { check_extinction(element, m); }, medium.coefficients);
  medium.phase = phase_property(context, properties);
  const bool varies = std::holds_alternative<HeterogeneousMedium>(medium.coefficients);
  medium.emission = emission_property(context, properties, varies);
  properties.finish();
  if (emits(medium.emission) && !absorbs(medium))
    context.warn(
        fmt::format("{}: its albedo is 1, so it emits nothing: what a medium gives off is "
                    "its absorption times its emission",
                    element.where()));
  return medium;
}

}  // namespace

PhaseFunction import_phase(ImportContext& context, const Element& element) {
  Properties properties(context.document, element);
  const PhaseImporter importer = importer_of(element, kPhases, "phase function");
  const PhaseFunction phase = importer(properties);
  properties.finish();
  return phase;
}

int import_medium(ImportContext& context, const Element& medium) {
  const auto known = context.media.find(&medium);
  if (known != context.media.end()) return known->second;
  context.scene.media.push_back(import_new(context, medium));
  const int index = static_cast<int>(context.scene.media.size()) - 1;
  context.media[&medium] = index;
  return index;
}

}  // namespace waylight::mitsuba
