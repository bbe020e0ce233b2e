#include "libguide/directional/phase_lobes.h"

#include <vector>

namespace waylight {
namespace {

constexpr double kMaxG = 0.99;
constexpr double kFlatG = 1e-3;  // below, the nodes cancel, and one lobe is right to 1e-6
constexpr double kTolerance = 0.03;
constexpr int kIterations = 200;
constexpr int kNodes = 257;  // odd, for Simpson's rule

struct Node {
  double d, mass;  // 1 - cos theta; density times solid angle, normalised
};

// Simpson's rule in ln(1 + g^2 - 2 g cos theta), on whose scale the function is a power for every
// g.
std::vector<Node> henyey_greenstein_nodes(double g) {
  const double low = 2 * std::log1p(-g), high = 2 * std::log1p(g);
  std::vector<Node> nodes(kNodes);
  double total = 0;
  for (int i = 0; i < kNodes; ++i) {
    const double y = low + (high - low) * i / (kNodes - 1);
    const double simpson = i == 0 || i == kNodes - 1 ? 1 : i % 2 ? 4 : 2;
    nodes[i] = {(std::exp(y) - (1 - g) * (1 - g)) / (2 * g), simpson * std::exp(-0.5 * y)};
    total += nodes[i].mass;
  }
  for (Node& node : nodes) node.mass /= total;
  return nodes;
}

struct Lobe {
  double weight, kappa, scale;  // scale = 2 pi weight c(kappa)

  Lobe(double w, double k) : weight(w), kappa(k), scale(w * k / -std::expm1(-2 * k)) {}
  double density(double d) const { return scale * std::exp(-kappa * d); }  // times 2 pi
};

// Evenly by logarithm from the least to the largest concentration that HG(g) is made of.
std::vector<Lobe> spread_lobes(double g, int count) {
  const double low = std::log(g), high = std::log(2 * g / ((1 - g) * (1 - g)));
  std::vector<Lobe> lobes;
  for (int k = 0; k < count; ++k)
    lobes.emplace_back(1.0 / count, std::exp(low + (high - low) * (k + 0.5) / count));
  return lobes;
}

void em_step(const std::vector<Node>& nodes, std::vector<Lobe>& lobes) {
  std::array<double, PhaseLobes::kMaxLobes> density, s0{}, s1{};
  for (const Node& node : nodes) {
    double sum = 0;
    for (size_t k = 0; k < lobes.size(); ++k) sum += density[k] = lobes[k].density(node.d);
    for (size_t k = 0; k < lobes.size(); ++k) {
      const double share = node.mass * density[k] / sum;
      s0[k] += share, s1[k] += share * (1 - node.d);
    }
  }
  for (size_t k = 0; k < lobes.size(); ++k)
    lobes[k] = Lobe(s0[k], kappa_of_mean_cosine(s1[k] / s0[k]));
}

// int |HG - lobes| dw, as the mean of |1 - lobes / HG| over HG.
double fit_error(const std::vector<Node>& nodes, const std::vector<Lobe>& lobes, double g) {
  double error = 0;
  for (const Node& node : nodes) {
    const double base = (1 - g) * (1 - g) + 2 * g * node.d;
    const double hg = 0.5 * (1 - g * g) / (base * std::sqrt(base));  // times 2 pi
    double sum = 0;
    for (const Lobe& lobe : lobes) sum += lobe.density(node.d);
    error += node.mass * std::abs(1 - sum / hg);
  }
  return error;
}

std::vector<Lobe> fitted_lobes(double g) {  // g > 0
  std::vector<Lobe> lobes = {{1, kappa_of_mean_cosine(g)}};
  if (g < kFlatG) return lobes;
  const std::vector<Node> nodes = henyey_greenstein_nodes(g);
  for (int count = 2; count <= PhaseLobes::kMaxLobes; ++count) {
    if (fit_error(nodes, lobes, g) < kTolerance) break;
    lobes = spread_lobes(g, count);
    for (int i = 0; i < kIterations; ++i) em_step(nodes, lobes);
  }
  return lobes;
}

}  // namespace

float PhaseLobes::pdf(float cos_theta) const {
  float sum = 0;
  for (int k = 0; k < count; ++k) {
    const PhaseLobe& lobe = lobes[k];
    const float exponent = -lobe.kappa * (1 - lobe.sign * cos_theta);
    sum += lobe.weight * vmf_norm(lobe.kappa) * std::exp(std::max(exponent, kMinExponent));
  }
  return sum;
}

float PhaseLobes::mean_cosine() const {
  float sum = 0;
  for (int k = 0; k < count; ++k)
    sum += lobes[k].weight * lobes[k].sign * (1 - lobes[k].dispersion);
  return sum;
}

VmfMixture PhaseLobes::about(const Vec3& axis) const {
  std::array<VmfComponent, kMaxLobes> components;
  for (int k = 0; k < count; ++k)
    components[k] = {lobes[k].weight, lobes[k].sign * axis, lobes[k].kappa};
  return VmfMixture(std::span(components.data(), count));
}

PhaseLobes phase_lobes(float g) {
  const double bounded = std::isnan(g) ? 0 : std::clamp<double>(std::abs(g), 0, kMaxG);
  PhaseLobes result;
  for (const Lobe& lobe : fitted_lobes(bounded))
    result.lobes[result.count++] = {static_cast<float>(lobe.weight), g < 0 ? -1.0f : 1.0f,
                                    static_cast<float>(lobe.kappa),
                                    static_cast<float>(1 - mean_cosine(lobe.kappa))};
  return result;
}

}  // namespace waylight
