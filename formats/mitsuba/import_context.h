#pragma once
// What the importers of single elements share, and what each offers.

#include <memory>
#include <unordered_map>

#include "formats/mitsuba/element.h"
#include "formats/mitsuba/properties.h"
#include "libguide/scene/scene_description.h"

namespace waylight::mitsuba {

struct ImportContext {
  const Document& document;
  const ImportOptions& options;
  SceneDescription& scene;
  std::unordered_map<const Element*, int> materials, media;      // already imported, by identity
  std::map<std::string, std::shared_ptr<const Bitmap>> bitmaps;  // by path and colour space
  std::unordered_map<const Element*, uint32_t> groups;           // <shape type="shapegroup">
  std::unordered_map<const Element*, Texture> textures = {};
  std::unordered_map<const Element*, VolumeTexture> volumes = {};
  std::vector<Bounds> group_bounds = {};  // of scene.groups
  int black_material = kNone;             // of emitters without BSDF, made when first needed
  int null_material = kNone, grey_material = kNone;  // made when first needed

  void warn(const std::string& message) const {
    if (options.on_warning) options.on_warning(message);
  }
};

// textures.cpp
// Mitsuba's v = 0 is the top row of a bitmap, here it is the bottom one: shapes carry 1 - v, and
// to_uv, which acts on Mitsuba's, is put between two flips. One element is imported once.
Texture import_texture(ImportContext& context, const Element& element);
// A property that is a texture, a colour or a number; Error for a negative one.
Texture texture_property(ImportContext& context, Properties& properties, const std::string& name,
                         const Texture& otherwise);
// That of a reflectance or transmittance, which the renderer holds at 1: a warning above.
Texture reflectance_property(ImportContext& context, Properties& properties,
                             const std::string& name, const Texture& otherwise);

// materials.cpp: index into scene.materials; one element is imported once. Unknown types: Error, or
// with `lenient` grey diffuse and a warning.
int import_material(ImportContext& context, const Element& bsdf);
int null_material(ImportContext& context);
int grey_material(ImportContext& context);  // diffuse 0.5, the default of a shape without BSDF

// emitters.cpp: everything but `area`, which needs its shape. Adds to scene.emitters.
void import_emitter(ImportContext& context, const Element& emitter);
// Radiance of <emitter type="area">.
Texture import_area_radiance(ImportContext& context, const Element& emitter);

// media.cpp: index into scene.media; one element is imported once.
int import_medium(ImportContext& context, const Element& medium);

// shapes.cpp: <shape> at the top of the scene, groups and instances too.
void import_shape(ImportContext& context, const Element& shape);

// sensor.cpp
void import_sensor(ImportContext& context, const Element& sensor);
void import_integrator(ImportContext& context, const Element& integrator);

// spectrum.cpp: what the value of a colour-like element means in linear sRGB.
// "l1:v1, l2:v2, ..." in nm, piecewise linear, zero outside; reflectances integrate under a flat
// illuminant so that a constant 1 is white.
Color spectrum_to_rgb(const std::vector<std::pair<float, float>>& samples);
Color blackbody_rgb(float kelvin, float scale);  // W / (m^2 sr nm), as Mitsuba's

}  // namespace waylight::mitsuba
