#include "libguide/bsdf/bsdf.h"
#include "libguide/bsdf/shading_normal.h"
#include "libguide/bsdf/wrappers.h"

namespace waylight {
namespace {

float alpha(const Lookup& lookup, const Texture& texture) {
  const float a = lookup.scalar(texture);
  return a > kMinAlpha ? std::min(a, 10.0f) : kMinAlpha;
}

// Scaled down together where their sum exceeds one: both models conserve energy only up to there.
void conserve(Color& diffuse, Color& specular) {
  const float most = (diffuse + specular).maxCoeff();
  if (most <= 1) return;
  diffuse /= most;
  specular /= most;
}

// Collects the lobes of a material into a Bsdf, walking the wrappers.
class Collector {
 public:
  Collector(std::span<const Material> materials, Lookup lookup, TransportMode mode, bool back,
            Bsdf& bsdf)
      : materials_(materials), lookup_(lookup), mode_(mode), back_(back), bsdf_(bsdf) {}

  void collect(int material) {
    walk(material, 1, !back_, 0);
    if (met_ > 0 && met_ < 1) bsdf_.scale(1 / met_);
  }

 private:
  // covered: the frame faces this part; otherwise it is seen from behind (only where back_).
  void walk(int index, float weight, bool covered, int depth) {
    const Material& material = wrapped_material(materials_, index, depth);
    weight_ = weight;
    covered_ = covered;
    std::visit([&](const auto& m) { visit(m, depth); }, material.model);
  }

  void visit(const TwoSidedMaterial& m, int depth) {
    walk(back_ ? m.back : m.front, weight_, true, depth + 1);
  }
  void visit(const MaskMaterial& m, int depth) {
    walk(m.nested, weight_ * lookup_.share(m.opacity), covered_, depth + 1);
  }
  void visit(const BlendMaterial& m, int depth) {
    const float second = lookup_.share(m.weight), weight = weight_;
    const bool covered = covered_;
    walk(m.first, weight * (1 - second), covered, depth + 1);
    walk(m.second, weight * second, covered, depth + 1);
  }
  void visit(const BumpMapMaterial& m, int depth) { walk(m.nested, weight_, covered_, depth + 1); }
  void visit(const NormalMapMaterial& m, int depth) {
    walk(m.nested, weight_, covered_, depth + 1);
  }
  void visit(const NullMaterial& /*m*/, int /*depth*/) {}

  void visit(const DiffuseMaterial& m, int) {
    if (one_sided()) bsdf_.add(Diffuse{lookup_.color(m.reflectance)}, weight_);
  }
  void visit(const ConductorMaterial& m, int) {
    if (one_sided())
      bsdf_.add(Conductor{m.eta, m.k, lookup_.color(m.specular_reflectance)}, weight_);
  }
  void visit(const RoughConductorMaterial& m, int) {
    if (!one_sided()) return;
    bsdf_.add(RoughConductor{m.eta, m.k, lookup_.color(m.specular_reflectance),
                             facets(m.alpha_u, m.alpha_v, m.distribution)},
              weight_);
  }
  void visit(const DielectricMaterial& m, int) {
    met_ += weight_;
    bsdf_.add(Dielectric{covered_ ? m.eta : 1 / m.eta, lookup_.color(m.specular_reflectance),
                         lookup_.color(m.specular_transmittance), mode_},
              weight_);
  }
  void visit(const ThinDielectricMaterial& m, int) {
    met_ += weight_;
    bsdf_.add(ThinDielectric{m.eta, lookup_.color(m.specular_reflectance),
                             lookup_.color(m.specular_transmittance)},
              weight_);
  }
  void visit(const RoughDielectricMaterial& m, int) {
    met_ += weight_;
    const Color reflectance = lookup_.color(m.specular_reflectance);
    const Color transmittance = lookup_.color(m.specular_transmittance);
    if (std::abs(m.eta - 1) < kMatchedEta) {
      bsdf_.add(ThinDielectric{1, reflectance, transmittance}, weight_);
      return;
    }
    bsdf_.add(RoughDielectric{covered_ ? m.eta : 1 / m.eta, reflectance, transmittance,
                              facets(m.alpha_u, m.alpha_v, m.distribution), mode_},
              weight_);
  }
  void visit(const PlasticMaterial& m, int) {
    if (!one_sided()) return;
    const float internal = fresnel_diffuse_reflectance(1 / m.eta);
    const Color rho = lookup_.color(m.diffuse_reflectance);
    bsdf_.add(Plastic{m.eta, internal, coated_diffuse(rho, internal, m.eta, m.nonlinear),
                      lookup_.color(m.specular_reflectance)},
              weight_);
  }
  void visit(const RoughPlasticMaterial& m, int) {
    if (!one_sided()) return;
    const RoughTransmittance& table = rough_transmittance(m.distribution, m.eta);
    const Microfacet isotropic = facets(m.alpha, m.alpha, m.distribution);
    const RoughTransmittance::Row row = table.row(isotropic.alpha_u);
    const Color rho = lookup_.color(m.diffuse_reflectance);
    bsdf_.add(RoughPlastic{m.eta,
                           coated_diffuse(rho, table.internal_reflectance(row), m.eta, m.nonlinear),
                           lookup_.color(m.specular_reflectance), isotropic, &table, row},
              weight_);
  }
  void visit(const PhongMaterial& m, int) {
    if (!one_sided()) return;
    Color diffuse = lookup_.color(m.diffuse_reflectance);
    Color specular = lookup_.color(m.specular_reflectance);
    conserve(diffuse, specular);
    const float exponent = lookup_.scalar(m.exponent);
    bsdf_.add(Phong{diffuse, specular, exponent > 0 ? std::min(exponent, 1e8f) : 0}, weight_);
  }
  void visit(const WardMaterial& m, int) {
    if (!one_sided()) return;
    Color diffuse = lookup_.color(m.diffuse_reflectance);
    Color specular = lookup_.color(m.specular_reflectance);
    conserve(diffuse, specular);
    bsdf_.add(
        Ward{diffuse, specular, alpha(lookup_, m.alpha_u), alpha(lookup_, m.alpha_v), m.variant},
        weight_);
  }

  Microfacet facets(const Texture& u, const Texture& v, MicrofacetDistribution kind) const {
    return {alpha(lookup_, u), alpha(lookup_, v), kind};
  }
  // Counts the part as met; whether its lit side is the one seen.
  bool one_sided() {
    met_ += weight_;
    return covered_;
  }

  std::span<const Material> materials_;
  Lookup lookup_;
  TransportMode mode_;
  bool back_;
  Bsdf& bsdf_;
  float weight_ = 1, met_ = 0;  // met_: share of the surface that is not null or masked away
  bool covered_ = true;
};

bool has_two_sided(std::span<const Material> materials, int index, int depth) {
  const MaterialModel& model = wrapped_material(materials, index, depth).model;
  const auto nested = [&](int i) { return has_two_sided(materials, i, depth + 1); };
  if (std::holds_alternative<TwoSidedMaterial>(model)) return true;
  if (const auto* m = std::get_if<MaskMaterial>(&model)) return nested(m->nested);
  if (const auto* m = std::get_if<BumpMapMaterial>(&model)) return nested(m->nested);
  if (const auto* m = std::get_if<NormalMapMaterial>(&model)) return nested(m->nested);
  if (const auto* m = std::get_if<BlendMaterial>(&model))
    return nested(m->first) || nested(m->second);
  return false;
}

}  // namespace

ResolvedBsdf resolve(std::span<const Material> materials, int material, const ShadingPoint& point,
                     const Vec3& wo, TransportMode mode) {
  ResolvedBsdf resolved;
  const float side = wo.dot(point.ng) >= 0 ? 1.0f : -1.0f;
  const bool back = side < 0 && has_two_sided(materials, material, 0);
  const Vec3 n = facing_normal(shading_normal(materials, material, point, back), wo, side);
  resolved.frame = Frame::from_tangent(back ? Vec3(-n) : n, point.dpdu);
  Collector(materials, {&point.uv}, mode, back, resolved.bsdf).collect(material);
  return resolved;
}

Bsdf resolve_mean(std::span<const Material> materials, int material) {
  Bsdf bsdf;
  Collector(materials, {}, TransportMode::radiance, false, bsdf).collect(material);
  return bsdf;
}

}  // namespace waylight
