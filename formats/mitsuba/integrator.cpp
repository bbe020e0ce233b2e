// <integrator>: only what can serve as a default of `render`.

#include <algorithm>

#include "formats/mitsuba/import_context.h"
#include "formats/mitsuba/types.h"
#include "libguide/base/nearest_name.h"

namespace waylight::mitsuba {
namespace {

// Path tracers; all of them estimate the same image.
const std::vector<std::string> kPathTracers = {"path",       "volpath", "volpath_simple",
                                               "volpathmis", "bdpt",    "direct"};
// Others of either dialect and of guiding renderers, of which only the depths are used.
const std::vector<std::string> kOthers = {
    "ptracer", "prb",          "prbvolpath", "guidedpath", "path_guiding_integrator",
    "pssmlt",  "mlt",          "erpt",       "ppm",        "sppm",
    "vpl",     "photonmapper", "ao",         "depth"};
// Hold another integrator and add channels or a stopping rule to it.
const std::vector<std::string> kWrappers = {"moment", "aov", "adaptive", "irrcache"};
const std::vector<std::string> kWrapperOptions = {
    "aovs",      "block_size",         "clamp_neighbor", "clamp_screen",
    "debug",     "gradients",          "hide_emitters",  "indirect_only",
    "max_error", "max_sample_factor",  "overture",       "p_value",
    "quality",   "quality_adjustment", "resolution",     "samples_per_pass",
    "timeout"};

bool is_one_of(const std::string& type, const std::vector<std::string>& types) {
  return std::find(types.begin(), types.end(), type) != types.end();
}

void warn_of_depths_only(const ImportContext& context, const Element& integrator) {
  std::vector<std::string> known = kPathTracers;
  for (const auto* more : {&kOthers, &kWrappers})
    known.insert(known.end(), more->begin(), more->end());
  const std::string* nearest =
      is_one_of(integrator.type, kOthers) ? nullptr : nearest_name(integrator.type, known);
  context.warn(fmt::format("{}: only its depths are used{}", integrator.where(),
                           nearest ? fmt::format("; did you mean \"{}\"?", *nearest) : ""));
}

void import_wrapped(ImportContext& context, Properties& properties) {
  const Element* nested = single(properties, "integrator");
  if (!nested) fail_at(properties.element(), "needs a nested <integrator>");
  properties.ignore(kWrapperOptions);
  properties.finish();
  import_integrator(context, *nested);
}

void check(const Element& integrator, const IntegratorDefaults& defaults) {
  if (defaults.max_depth < -1 || defaults.max_depth == 0)
    fail_at(integrator, "its max_depth must be at least 1, or -1 for no limit");
  if (defaults.rr_depth < 1) fail_at(integrator, "its rr_depth must be at least 1");
}

}  // namespace

void import_integrator(ImportContext& context, const Element& integrator) {
  Properties properties(context.document, integrator);
  if (is_one_of(integrator.type, kWrappers)) return import_wrapped(context, properties);
  IntegratorDefaults& defaults = context.scene.integrator;
  defaults.max_depth = integrator.type == "direct" ? 2 : properties.integer("max_depth", -1);
  defaults.rr_depth = properties.integer("rr_depth", defaults.rr_depth);
  defaults.hide_emitters = properties.boolean("hide_emitters", false);
  check(integrator, defaults);
  if (!is_one_of(integrator.type, kPathTracers)) return warn_of_depths_only(context, integrator);
  properties.ignore({"strict_normals", "sample_num", "delta", "light_image", "sample_direct",
                     "use_mis", "shading_samples", "emitter_samples", "bsdf_samples",
                     "samples_per_pass", "timeout", "block_size"});
  properties.finish();
}

}  // namespace waylight::mitsuba
