#include "libguide/bsdf/shading_normal.h"

#include "libguide/bsdf/wrappers.h"

namespace waylight {
namespace {

// The mirror image across the surface where n points into it; `otherwise` where n is no vector.
Vec3 on_side_of(const Vec3& ng, Vec3 n, const Vec3& otherwise) {
  const float length = n.norm();
  if (!(length > 1e-12f) || !std::isfinite(length)) return otherwise;
  n /= length;
  const float cos = n.dot(ng);
  return cos > 0 ? n : Vec3((n - 2 * cos * ng).normalized());
}

// Surface p + h ns: dp'/du = dp/du + ns (dh/du - ns . dp/du), the tangents of Mitsuba's bump map,
// whose cross product is the new normal up to the handedness of (u, v).
Vec3 bumped(const BumpMapMaterial& map, const ShadingPoint& at, const Vec3& n) {
  const Vec2 slope = map.height.gradient(at.uv);
  const Vec3 tu = at.dpdu + n * (slope.x() - n.dot(at.dpdu));
  const Vec3 tv = at.dpdv + n * (slope.y() - n.dot(at.dpdv));
  Vec3 result = tu.cross(tv);
  if (result.dot(n) < 0) result = -result;
  return on_side_of(at.ng, result, n);
}

Vec3 mapped(const NormalMapMaterial& map, const ShadingPoint& at, const Vec3& n) {
  const Color rgb = map.normals.eval(at.uv);
  const Vec3 local = (2 * rgb - 1).matrix();
  return on_side_of(at.ng, Frame::from_tangent(n, at.dpdu).to_world(local), n);
}

struct Walk {
  std::span<const Material> materials;
  const ShadingPoint& at;
  bool back;

  // Outer maps turn the frame in which inner ones are read.
  Vec3 operator()(int index, const Vec3& n, int depth) const {
    const MaterialModel& model = wrapped_material(materials, index, depth).model;
    if (const auto* m = std::get_if<TwoSidedMaterial>(&model))
      return (*this)(back ? m->back : m->front, n, depth + 1);
    if (const auto* m = std::get_if<MaskMaterial>(&model)) return (*this)(m->nested, n, depth + 1);
    if (const auto* m = std::get_if<BumpMapMaterial>(&model))
      return (*this)(m->nested, bumped(*m, at, n), depth + 1);
    if (const auto* m = std::get_if<NormalMapMaterial>(&model))
      return (*this)(m->nested, mapped(*m, at, n), depth + 1);
    if (const auto* m = std::get_if<BlendMaterial>(&model)) return blended(*m, n, depth);
    return n;
  }

  Vec3 blended(const BlendMaterial& blend, const Vec3& n, int depth) const {
    const Vec3 a = (*this)(blend.first, n, depth + 1), b = (*this)(blend.second, n, depth + 1);
    if (a == b) return a;
    const float weight = Lookup{&at.uv}.share(blend.weight);
    return on_side_of(at.ng, (1 - weight) * a + weight * b, n);
  }
};

}  // namespace

Vec3 shading_normal(std::span<const Material> materials, int material, const ShadingPoint& point,
                    bool back) {
  return Walk{materials, point, back}(material, on_side_of(point.ng, point.ns, point.ng), 0);
}

Vec3 facing_normal(const Vec3& n, const Vec3& wo, float side) {
  constexpr float kLeast = 1e-3f;
  const float cos = side * n.dot(wo);
  if (cos >= kLeast) return n;
  // t = the part of n perpendicular to wo; rotate in the plane of both.
  const Vec3 t = n - n.dot(wo) * wo;
  const float length = t.norm();
  if (!(length > 1e-6f)) return side * wo;
  return (t * (std::sqrt(1 - sqr(kLeast)) / length) + side * kLeast * wo).normalized();
}

}  // namespace waylight
