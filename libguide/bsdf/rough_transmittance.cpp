#include "libguide/bsdf/rough_transmittance.h"

#include <atomic>
#include <memory>
#include <mutex>

#include "libguide/bsdf/fresnel.h"
#include "libguide/bsdf/microfacet.h"

namespace waylight {
namespace {

struct Scattered {
  double reflected = 0, refracted = 0;
};

// Mean over visible normals by the midpoint rule in the sampler's square.
Scattered scattered(const Microfacet& facets, float cos, float eta) {
  constexpr int kRows = 24, kColumns = 16;
  const Vec3 w(safe_sqrt(1 - sqr(cos)), 0, std::max(cos, 1e-4f));
  const Vec3 unit = w.normalized();
  Scattered sum;
  for (int i = 0; i < kRows; ++i)
    for (int j = 0; j < kColumns; ++j) {
      const Vec3 m = facets.sample(unit, {(j + 0.5f) / kColumns, (i + 0.5f) / kRows});
      const float cos_m = std::clamp(unit.dot(m), 0.0f, 1.0f);
      const Fresnel f = fresnel_dielectric(cos_m, eta);
      const Vec3 r = reflect(unit, m), t = refract(unit, m, eta, f.cos_t);
      if (r.z() > 0) sum.reflected += f.reflectance * facets.g1(r);
      if (t.z() < 0) sum.refracted += (1 - f.reflectance) * facets.g1(-t);
    }
  sum.reflected /= kRows * kColumns;
  sum.refracted /= kRows * kColumns;
  return sum;
}

// One less what is transmitted and what shadowing loses. Reciprocity gives the transmittance from
// below from that from above, 2 int T cos dcos / eta^2, which has no edge of total reflection.
float mean_internal_reflectance(const Microfacet& facets, float eta) {
  constexpr int kSteps = 32;
  double lost = 0, entering = 0;
  for (int i = 0; i < kSteps; ++i) {
    const float cos = (i + 0.5f) / kSteps;
    const Scattered below = scattered(facets, cos, 1 / eta);
    lost += 2 * cos * (1 - below.reflected - below.refracted) / kSteps;
    entering += 2 * cos * scattered(facets, cos, eta).refracted / kSteps;
  }
  return static_cast<float>(1 - lost - entering / sqr(eta));
}

}  // namespace

RoughTransmittance::RoughTransmittance(MicrofacetDistribution distribution, float eta) {
  for (int i = 0; i < kAlphas; ++i) {
    const float alpha = std::max(sqr(i / (kAlphas - 1.0f)), kMinAlpha);
    const Microfacet facets{alpha, alpha, distribution};
    for (int j = 0; j < kCosines; ++j)
      transmittance_[i][j] = scattered(facets, sqr(j / (kCosines - 1.0f)), eta).refracted;
    internal_[i] = mean_internal_reflectance(facets, eta);
  }
}

RoughTransmittance::Row RoughTransmittance::row(float alpha) const {
  const float at = std::sqrt(std::clamp(alpha, 0.0f, 1.0f)) * (kAlphas - 1);
  const int index = std::min(static_cast<int>(at), kAlphas - 2);
  return {index, at - index};
}

float RoughTransmittance::transmittance(Row row, float cos) const {
  const float at = std::sqrt(std::clamp(cos, 0.0f, 1.0f)) * (kCosines - 1);
  const int j = std::min(static_cast<int>(at), kCosines - 2);
  const auto& a = transmittance_[row.index];
  const auto& b = transmittance_[row.index + 1];
  return lerp(lerp(a[j], b[j], row.fraction), lerp(a[j + 1], b[j + 1], row.fraction), at - j);
}

float RoughTransmittance::internal_reflectance(Row row) const {
  return lerp(internal_[row.index], internal_[row.index + 1], row.fraction);
}

namespace {

// A list that only grows: readers walk it without a lock. A scene has few interfaces.
struct Node {
  MicrofacetDistribution distribution;
  float eta;
  RoughTransmittance table;
  std::unique_ptr<const Node> next;
};

struct Registry {
  std::unique_ptr<const Node> nodes;
  std::atomic<const Node*> head{nullptr};
  std::mutex growing;

  const Node* find(MicrofacetDistribution distribution, float eta) const {
    const Node* node = head.load(std::memory_order_acquire);
    while (node && !(node->eta == eta && node->distribution == distribution))
      node = node->next.get();
    return node;
  }
};

}  // namespace

const RoughTransmittance& rough_transmittance(MicrofacetDistribution distribution, float eta) {
  static Registry registry;
  if (const Node* node = registry.find(distribution, eta)) return node->table;
  const std::lock_guard lock(registry.growing);
  if (const Node* node = registry.find(distribution, eta)) return node->table;
  const RoughTransmittance table(distribution, eta);
  registry.nodes.reset(new Node{distribution, eta, table, std::move(registry.nodes)});
  registry.head.store(registry.nodes.get(), std::memory_order_release);
  return registry.nodes->table;
}

}  // namespace waylight
