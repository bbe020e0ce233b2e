#include "formats/mitsuba/materials.h"

#include "formats/mitsuba/types.h"

namespace waylight::mitsuba {
namespace {

using MaterialImporter = MaterialModel (*)(ImportContext&, Properties&);

const std::map<std::string, MaterialImporter> kImporters = {
    {"diffuse", import_diffuse},
    {"conductor", import_conductor},
    {"roughconductor", import_rough_conductor},
    {"dielectric", import_dielectric},
    {"thindielectric", import_thin_dielectric},
    {"roughdielectric", import_rough_dielectric},
    {"plastic", import_plastic},
    {"roughplastic", import_rough_plastic},
    {"phong", import_phong},
    {"ward", import_ward},
    {"null", import_null},
    {"twosided", import_two_sided},
    {"mask", import_mask},
    {"blendbsdf", import_blend},
    {"bumpmap", import_bump_map},
    {"normalmap", import_normal_map}};

int add(ImportContext& context, Material material) {
  context.scene.materials.push_back(std::move(material));
  return static_cast<int>(context.scene.materials.size()) - 1;
}

int import_model(ImportContext& context, const Element& bsdf) {
  Properties properties(context.document, bsdf);
  const MaterialImporter importer = importer_of(bsdf, kImporters, "material");
  MaterialModel model = importer(context, properties);
  properties.ignore({"use_path_guiding"});  // a guiding renderer's flag; all is guided here
  properties.finish();
  return add(context, {label_of(bsdf), std::move(model)});
}

int replace_unknown(ImportContext& context, const Element& bsdf) {
  context.warn(fmt::format("{}: unknown material \"{}\", taken as grey diffuse{}", bsdf.where(),
                           bsdf.type, did_you_mean(bsdf.type, known_materials())));
  return add(context, {label_of(bsdf), DiffuseMaterial{}});
}

}  // namespace

std::vector<std::string> known_materials() { return names_of(kImporters); }

int import_material(ImportContext& context, const Element& bsdf) {
  if (bsdf.tag != "bsdf") fail_at(bsdf, "stands where a <bsdf> is needed");
  const auto known = context.materials.find(&bsdf);
  if (known != context.materials.end()) return known->second;
  const bool replace = context.options.lenient && !kImporters.count(bsdf.type);
  const int index = replace ? replace_unknown(context, bsdf) : import_model(context, bsdf);
  context.materials[&bsdf] = index;
  return index;
}

int null_material(ImportContext& context) {
  if (context.null_material == kNone)
    context.null_material = add(context, {"null", NullMaterial{}});
  return context.null_material;
}

int grey_material(ImportContext& context) {
  if (context.grey_material == kNone)
    context.grey_material = add(context, {"default", DiffuseMaterial{}});
  return context.grey_material;
}

}  // namespace waylight::mitsuba
