#include "formats/mitsuba.h"

#include "formats/mitsuba/film.h"
#include "formats/mitsuba/materials.h"
#include "formats/mitsuba/media.h"
#include "formats/mitsuba/references.h"
#include "formats/scene_hash.h"

namespace waylight {
namespace mitsuba {
namespace {

// Top-level elements that count only where something refers to them.
bool is_only_referred_to(const Element& element) {
  for (const char* tag :
       {"bsdf", "texture", "medium", "volume", "phase", "film", "sampler", "rfilter", "subsurface"})
    if (element.tag == tag) return true;
  return false;
}

class SceneAssembly {
 public:
  explicit SceneAssembly(ImportContext& context) : context_(context) {}

  void import(const Element& element) {
    if (element.tag == "shape") return import_shape(context_, element);
    if (element.tag == "emitter") return import_emitter(context_, element);
    if (element.tag == "sensor") return sensor(element);
    if (element.tag == "integrator") return integrator(element);
    if (!is_only_referred_to(element)) fail_at(element, "cannot stand at the top of a scene");
    if (element.id.empty()) fail_at(element, "needs an id: nothing can refer to it");
  }

  void finish() const {
    if (!sensor_)
      context_.warn(fmt::format("\"{}\": has no <sensor>; the camera is at the origin",
                                context_.document.path));
  }

 private:
  void sensor(const Element& element) {
    if (sensor_)
      return context_.warn(fmt::format("{}: left out, the first sensor is used", element.where()));
    sensor_ = &element;
    import_sensor(context_, element);
  }

  void integrator(const Element& element) {
    if (integrator_) fail_at(element, "there is already {}", integrator_->where());
    integrator_ = &element;
    import_integrator(context_, element);
  }

  ImportContext& context_;
  const Element *sensor_ = nullptr, *integrator_ = nullptr;
};

void import_alone(ImportContext& context, const Element& element) {
  if (element.tag == "bsdf") import_material(context, element);
  if (element.tag == "texture") import_texture(context, element);
  if (element.tag == "medium") import_medium(context, element);
  if (element.tag == "volume") import_volume(context, element);
  if (element.tag == "phase") import_phase(context, element);
  if (element.tag == "film") import_film(context, element);
}

// Imports what nothing refers to and drops it, so that mistakes there are errors too.
void check_unreferenced(const ImportContext& context) {
  SceneDescription dropped;
  ImportContext scratch{context.document, context.options, dropped, {}, {}, context.bitmaps, {}};
  for (const Element* element : unreferenced(context.document)) import_alone(scratch, *element);
}

void warn_of_unused_defines(const ImportContext& context) {
  for (const std::string& name : context.document.unused_defines)
    context.warn(
        fmt::format("-D {}: nothing in \"{}\" asks for ${}", name, context.document.path, name));
}

}  // namespace
}  // namespace mitsuba

SceneDescription import_mitsuba(const std::string& path, const ImportOptions& options) {
  const mitsuba::Document document = mitsuba::parse_document(path, options);
  SceneDescription scene;
  scene.source = path;
  mitsuba::ImportContext context{document, options, scene, {}, {}, {}, {}};
  mitsuba::warn_of_unused_defines(context);
  mitsuba::SceneAssembly assembly(context);
  for (const mitsuba::Element& element : document.root.children) assembly.import(element);
  assembly.finish();
  mitsuba::check_unreferenced(context);
  if (options.two_sided) mitsuba::make_two_sided(scene);
  scene.hash = hash_scene(scene);
  return scene;
}

}  // namespace waylight
