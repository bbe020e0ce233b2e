#include "libguide/bsdf/textured_width.h"

#include "libguide/bsdf/wrappers.h"

namespace waylight {
namespace {

std::pair<float, float> range_of(std::span<const Color> colors) {
  std::pair<float, float> range(kInfinity, -kInfinity);
  for (const Color& color : colors) {
    range.first = std::min(range.first, color.mean());
    range.second = std::max(range.second, color.mean());
  }
  return range;
}
std::pair<float, float> range_of(const Color& color) { return {color.mean(), color.mean()}; }
std::pair<float, float> range_of(const CheckerboardTexture& texture) {
  return range_of(std::array{texture.color0, texture.color1});
}
// The borders of the wrap modes zero and one do not count.
std::pair<float, float> range_of(const BitmapTexture& texture) {
  return range_of(texture.bitmap->pixels);
}

bool same(const Color& a, const Color& b) { return (a == b).all(); }
bool same(const CheckerboardTexture& a, const CheckerboardTexture& b) {
  return same(a.color0, b.color0) && same(a.color1, b.color1);
}
bool same(const BitmapTexture& a, const BitmapTexture& b) {
  return a.bitmap == b.bitmap && a.filter == b.filter && a.wrap_u == b.wrap_u &&
         a.wrap_v == b.wrap_v;
}
bool same(const Texture& a, const Texture& b) {
  if (a.to_uv.m != b.to_uv.m || a.scale != b.scale) return false;
  const auto is_same = []<typename A, typename B>(const A& x, const B& y) {
    if constexpr (std::is_same_v<A, B>) return same(x, y);
    return false;
  };
  return std::visit(is_same, a.source, b.source);
}

std::optional<LobeWidth> width_of(const PhongMaterial& m) { return LobeWidth(m.exponent, true); }
std::optional<LobeWidth> width_of(const RoughPlasticMaterial& m) {
  return LobeWidth(m.alpha, false);
}
template <typename M>
std::optional<LobeWidth> width_of(const M& m) {
  if constexpr (requires { m.alpha_u; })
    if (same(m.alpha_u, m.alpha_v)) return LobeWidth(m.alpha_u, false);
  return std::nullopt;
}

void set_width(PhongMaterial& m, float width) { m.exponent = Texture(2 / sqr(width) - 2); }
void set_width(RoughPlasticMaterial& m, float width) { m.alpha = Texture(width); }
template <typename M>
void set_width(M& m, float width) {
  if constexpr (requires { m.alpha_u; }) m.alpha_u = m.alpha_v = Texture(width);
}

// The material inside all wrappers, as the front shows it; -1 where there are several.
int innermost(std::span<const Material> materials, int index, int depth) {
  const MaterialModel& model = wrapped_material(materials, index, depth).model;
  if (std::holds_alternative<BlendMaterial>(model)) return -1;
  if (const auto* m = std::get_if<TwoSidedMaterial>(&model))
    return innermost(materials, m->front, depth + 1);
  const auto nested = [&](const auto& m) {
    if constexpr (requires { m.nested; }) return innermost(materials, m.nested, depth + 1);
    return index;
  };
  return std::visit(nested, model);
}

}  // namespace

float LobeWidth::width_of(float parameter) const {
  const float width = is_exponent_ ? std::sqrt(2 / (std::max(parameter, 0.0f) + 2)) : parameter;
  return width > 1e-3f ? std::min(width, 2.0f) : 1e-3f;
}

WidthRange LobeWidth::range() const {
  const auto [a, b] =
      std::visit([](const auto& source) { return range_of(source); }, texture_->source);
  const float first = width_of(texture_->scale * a), last = width_of(texture_->scale * b);
  return {std::min(first, last), std::max(first, last)};
}

std::optional<LobeWidth> lobe_width(std::span<const Material> materials, int material) {
  const int inner = innermost(materials, material, 0);
  if (inner < 0) return std::nullopt;
  return std::visit([](const auto& m) { return width_of(m); }, materials[inner].model);
}

Bsdf resolve_at_width(std::span<const Material> materials, int material, float width) {
  std::vector<Material> changed(materials.begin(), materials.end());
  MaterialModel& model = changed[innermost(materials, material, 0)].model;
  std::visit([&](auto& m) { set_width(m, width); }, model);
  return resolve_mean(changed, material);
}

}  // namespace waylight
