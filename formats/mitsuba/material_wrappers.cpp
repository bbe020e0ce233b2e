// Materials made of other materials.

#include "formats/mitsuba/materials.h"
#include "libguide/bsdf/bsdf.h"

namespace waylight::mitsuba {
namespace {

std::vector<int> nested_materials(ImportContext& context, Properties& properties, size_t least,
                                  size_t most) {
  const std::vector<const Element*> nested = properties.objects("bsdf");
  if (nested.size() < least || nested.size() > most)
    fail_at(properties.element(), "holds {} materials, it takes {}", nested.size(),
            least == most ? fmt::format("{}", most) : fmt::format("{} or {}", least, most));
  std::vector<int> indices;
  for (const Element* bsdf : nested) indices.push_back(import_material(context, *bsdf));
  return indices;
}

int nested_material(ImportContext& context, Properties& properties) {
  return nested_materials(context, properties, 1, 1)[0];
}

Texture nested_texture(ImportContext& context, Properties& properties) {
  const std::vector<const Element*> nested = properties.objects("texture");
  if (nested.size() != 1)
    fail_at(properties.element(), "holds {} textures, it takes 1", nested.size());
  return import_texture(context, *nested[0]);
}

// Whether light can come through, holes of a mask counted as Mitsuba does.
bool transmissive(const SceneDescription& scene, int index) {
  const MaterialModel& model = scene.materials[index].model;
  const std::vector<int> nested = parts(model);
  return is_interface(model) || std::holds_alternative<MaskMaterial>(model) ||
         std::any_of(nested.begin(), nested.end(), [&](int i) { return transmissive(scene, i); });
}

// Lobes that resolve() will need, counted up to one more than there may be.
int lobe_count(const SceneDescription& scene, int index) {
  const MaterialModel& model = scene.materials[index].model;
  if (std::holds_alternative<NullMaterial>(model)) return 0;
  const std::vector<int> nested = parts(model);
  if (nested.empty()) return 1;
  const bool both = std::holds_alternative<BlendMaterial>(model);
  const int first = lobe_count(scene, nested.front());
  if (nested.size() == 1) return first;
  const int second = lobe_count(scene, nested.back());
  return std::min(both ? first + second : std::max(first, second), Bsdf::kMaxLobes + 1);
}

// Mitsuba reads the colours of a picture as opacity; exporters often mean its alpha channel.
void warn_of_alpha(const ImportContext& context, const Element& mask, const Texture& opacity) {
  const auto* texture = std::get_if<BitmapTexture>(&opacity.source);
  if (!texture) return;
  const std::vector<float>& alpha = texture->bitmap->alpha;
  if (std::any_of(alpha.begin(), alpha.end(), [](float a) { return a < 1; }))
    context.warn(fmt::format(
        "{}: the colours of its picture are the opacity, not its alpha channel; if that is meant, "
        "give the texture <string name=\"channel\" value=\"a\"/>",
        mask.where()));
}

// Walks over wrapped materials cost a step each at every shading point.
void check_depth(const SceneDescription& scene, const Element& element, int index, int depth) {
  constexpr int kMaxDepth = 12;
  if (depth > kMaxDepth)
    fail_at(element, "materials are wrapped more than {} deep; unnest them", kMaxDepth);
  for (const int part : parts(scene.materials[index].model))
    check_depth(scene, element, part, depth + 1);
}

}  // namespace

std::vector<int> parts(const MaterialModel& model) {
  if (const auto* m = std::get_if<TwoSidedMaterial>(&model)) return {m->front, m->back};
  if (const auto* m = std::get_if<MaskMaterial>(&model)) return {m->nested};
  if (const auto* m = std::get_if<BumpMapMaterial>(&model)) return {m->nested};
  if (const auto* m = std::get_if<NormalMapMaterial>(&model)) return {m->nested};
  if (const auto* m = std::get_if<BlendMaterial>(&model)) return {m->first, m->second};
  return {};
}

bool is_interface(const MaterialModel& model) {
  return std::holds_alternative<DielectricMaterial>(model) ||
         std::holds_alternative<ThinDielectricMaterial>(model) ||
         std::holds_alternative<RoughDielectricMaterial>(model) ||
         std::holds_alternative<NullMaterial>(model);
}

MaterialModel import_two_sided(ImportContext& context, Properties& properties) {
  const std::vector<int> nested = nested_materials(context, properties, 1, 2);
  for (const int side : nested) {
    check_depth(context.scene, properties.element(), side, 1);
    if (transmissive(context.scene, side))
      fail_at(properties.element(),
              "material \"{}\" lets light through, it has no two sides; leave \"twosided\" out",
              context.scene.materials[side].name);
  }
  return TwoSidedMaterial{nested.front(), nested.back()};
}

MaterialModel import_mask(ImportContext& context, Properties& properties) {
  const int nested = nested_material(context, properties);
  check_depth(context.scene, properties.element(), nested, 1);
  const Texture opacity = texture_property(context, properties, "opacity", Texture(0.5f));
  warn_of_alpha(context, properties.element(), opacity);
  return MaskMaterial{nested, opacity};
}

MaterialModel import_blend(ImportContext& context, Properties& properties) {
  const std::vector<int> nested = nested_materials(context, properties, 2, 2);
  for (const int part : nested) check_depth(context.scene, properties.element(), part, 1);
  const int lobes = lobe_count(context.scene, nested[0]) + lobe_count(context.scene, nested[1]);
  if (lobes > Bsdf::kMaxLobes)
    fail_at(properties.element(), "blends more than {} materials; leave some out", Bsdf::kMaxLobes);
  return BlendMaterial{nested[0], nested[1],
                       texture_property(context, properties, "weight", Texture(0.5f))};
}

MaterialModel import_bump_map(ImportContext& context, Properties& properties) {
  const int nested = nested_material(context, properties);
  check_depth(context.scene, properties.element(), nested, 1);
  Texture height = nested_texture(context, properties);
  height.scale *= properties.number("scale", 1);
  return BumpMapMaterial{nested, height};
}

MaterialModel import_normal_map(ImportContext& context, Properties& properties) {
  const int nested = nested_material(context, properties);
  check_depth(context.scene, properties.element(), nested, 1);
  return NormalMapMaterial{nested, nested_texture(context, properties)};
}

}  // namespace waylight::mitsuba
