#include "libguide/bsdf/lobe_traits.h"

#include "libguide/bsdf/wrappers.h"

namespace waylight {
namespace {

// Collects the traits of a material, walking the wrappers as `resolve_mean` does.
class TraitsWalk {
 public:
  explicit TraitsWalk(std::span<const Material> materials) : materials_(materials) {}

  void walk(int index, int depth) {
    const Material& material = wrapped_material(materials_, index, depth);
    std::visit([&](const auto& m) { visit(m, depth + 1); }, material.model);
  }
  const LobeTraits& traits() const { return traits_; }

 private:
  void look_at(const Texture& texture) { traits_.textured |= !texture.constant(); }
  void look_at_widths(const Texture& u, const Texture& v) {
    look_at(u), look_at(v);
    traits_.smooth = true;
    traits_.depends_on_wo = true;
    traits_.uniform = false;
    traits_.anisotropic |= u.mean().mean() != v.mean().mean();
  }
  void look_at_parts(const Texture& diffuse, const Texture& specular) {
    look_at(diffuse), look_at(specular);
    traits_.smooth = true;
  }

  void visit(const TwoSidedMaterial& m, int depth) { walk(m.front, depth); }
  void visit(const MaskMaterial& m, int depth) { walk(m.nested, depth); }
  void visit(const BlendMaterial& m, int depth) {
    look_at(m.weight);
    blended_ = true;
    walk(m.first, depth);
    walk(m.second, depth);
  }
  void visit(const BumpMapMaterial& m, int depth) {
    look_at(m.height);
    walk(m.nested, depth);
  }
  void visit(const NormalMapMaterial& m, int depth) {
    look_at(m.normals);
    walk(m.nested, depth);
  }
  void visit(const DiffuseMaterial& m, int) {
    look_at(m.reflectance);
    traits_.smooth = true;
  }
  void visit(const NullMaterial&, int) {}
  void visit(const ConductorMaterial&, int) {}
  void visit(const DielectricMaterial&, int) {}
  void visit(const ThinDielectricMaterial&, int) {}
  void visit(const RoughConductorMaterial& m, int) {
    look_at(m.specular_reflectance);
    look_at_widths(m.alpha_u, m.alpha_v);
  }
  void visit(const RoughDielectricMaterial& m, int) {
    look_at_parts(m.specular_reflectance, m.specular_transmittance);
    look_at_widths(m.alpha_u, m.alpha_v);
  }
  // T(wo) is a factor of its smooth part; beside another part it shifts the balance.
  void visit(const PlasticMaterial& m, int) {
    look_at_parts(m.diffuse_reflectance, m.specular_reflectance);
    traits_.depends_on_wo |= blended_;
    traits_.uniform = false;
  }
  void visit(const RoughPlasticMaterial& m, int) {
    look_at_parts(m.diffuse_reflectance, m.specular_reflectance);
    look_at_widths(m.alpha, m.alpha);
  }
  void visit(const PhongMaterial& m, int) {
    look_at_parts(m.diffuse_reflectance, m.specular_reflectance);
    look_at_widths(m.exponent, m.exponent);
  }
  void visit(const WardMaterial& m, int) {
    look_at_parts(m.diffuse_reflectance, m.specular_reflectance);
    look_at_widths(m.alpha_u, m.alpha_v);
  }

  std::span<const Material> materials_;
  LobeTraits traits_;
  bool blended_ = false;
};

int behind(std::span<const Material> materials, int index, int self, int depth) {
  const MaterialModel& model = wrapped_material(materials, index, depth).model;
  const auto nested = [&](int i) { return behind(materials, i, self, depth + 1); };
  if (const auto* m = std::get_if<TwoSidedMaterial>(&model))
    return m->front == m->back ? self : m->back;
  if (const auto* m = std::get_if<MaskMaterial>(&model)) return nested(m->nested);
  if (const auto* m = std::get_if<BumpMapMaterial>(&model)) return nested(m->nested);
  if (const auto* m = std::get_if<NormalMapMaterial>(&model)) return nested(m->nested);
  if (const auto* m = std::get_if<BlendMaterial>(&model))
    return nested(m->first) == self && nested(m->second) == self ? self : -1;
  return self;
}

}  // namespace

LobeTraits lobe_traits(std::span<const Material> materials, int material) {
  TraitsWalk walk(materials);
  walk.walk(material, 0);
  return walk.traits();
}

int material_behind(std::span<const Material> materials, int material) {
  return behind(materials, material, material, 0);
}

}  // namespace waylight
