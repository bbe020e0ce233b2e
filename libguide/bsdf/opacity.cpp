#include "libguide/bsdf/bsdf.h"
#include "libguide/bsdf/wrappers.h"

namespace waylight {
namespace {

float opacity_at(std::span<const Material> materials, int index, const Vec2& uv, int depth) {
  const Lookup lookup{&uv};
  const MaterialModel& model = wrapped_material(materials, index, depth).model;
  const auto nested = [&](int i) { return opacity_at(materials, i, uv, depth + 1); };
  if (std::holds_alternative<NullMaterial>(model)) return 0;
  if (const auto* m = std::get_if<TwoSidedMaterial>(&model)) return nested(m->front);
  if (const auto* m = std::get_if<MaskMaterial>(&model))
    return lookup.share(m->opacity) * nested(m->nested);
  if (const auto* m = std::get_if<BlendMaterial>(&model))
    return lerp(nested(m->first), nested(m->second), lookup.share(m->weight));
  if (const auto* m = std::get_if<BumpMapMaterial>(&model)) return nested(m->nested);
  if (const auto* m = std::get_if<NormalMapMaterial>(&model)) return nested(m->nested);
  return 1;
}

bool transparent(std::span<const Material> materials, int index, int depth) {
  const MaterialModel& model = wrapped_material(materials, index, depth).model;
  const auto nested = [&](int i) { return transparent(materials, i, depth + 1); };
  if (std::holds_alternative<NullMaterial>(model)) return true;
  if (std::holds_alternative<ThinDielectricMaterial>(model)) return true;
  if (const auto* m = std::get_if<RoughDielectricMaterial>(&model))
    return std::abs(m->eta - 1) < kMatchedEta;
  if (const auto* m = std::get_if<TwoSidedMaterial>(&model)) return nested(m->front);
  if (const auto* m = std::get_if<MaskMaterial>(&model)) {
    const bool opaque = m->opacity.constant() && m->opacity.eval_scalar(Vec2::Zero()) >= 1;
    return !opaque || nested(m->nested);
  }
  if (const auto* m = std::get_if<BlendMaterial>(&model))
    return nested(m->first) || nested(m->second);
  if (const auto* m = std::get_if<BumpMapMaterial>(&model)) return nested(m->nested);
  if (const auto* m = std::get_if<NormalMapMaterial>(&model)) return nested(m->nested);
  return false;
}

}  // namespace

float opacity(std::span<const Material> materials, int material, const Vec2& uv) {
  return opacity_at(materials, material, uv, 0);
}

bool may_be_transparent(std::span<const Material> materials, int material) {
  return transparent(materials, material, 0);
}

}  // namespace waylight
