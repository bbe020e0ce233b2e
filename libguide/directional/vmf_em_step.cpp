#include "libguide/directional/vmf_em_step.h"

#include "libguide/directional/vmf.h"

namespace waylight {
namespace {

constexpr float kUnitTolerance = 1e-4f;  // of |w|^2, with room for rounding

bool is_unit(const Vec3& w) {  // comparisons reject NaN and infinity
  return std::abs(w.squaredNorm() - 1) <= kUnitTolerance;
}

// The lobe of one component; lobes without a resultant, which are uniform, keep any mean.
VmfComponent lobe_of(const VmfStatistics& s, float n, const VmfPrior& prior) {
  const double length = s.s1.cast<double>().norm();
  const double support = static_cast<double>(n) * s.s0 + prior.strength;
  VmfComponent c;
  if (length > 1e-30) c.mean = (s.s1.cast<double>() / length).cast<float>();
  const double r = (n * length + prior.strength * prior.length) / support;
  c.kappa = static_cast<float>(kappa_of_mean_cosine(r));
  return c;
}

}  // namespace

bool valid_direction(const WeightedDirection& point) {
  return point.weight > 0 && point.weight <= std::numeric_limits<float>::max() && is_unit(point.w);
}

BatchWeights scan_weights(std::span<const WeightedDirection> points, float max_weight) {
  const auto weight_of = [&](size_t i) {
    return valid_direction(points[i]) ? points[i].weight : 0.0f;
  };
  return scan_weights(points.size(), weight_of, max_weight);
}

void fill_rows(std::span<const WeightedDirection> points, const BatchWeights& weights,
               std::span<DirectionRow> rows) {
  if (points.size() % kLanes) rows.back() = {};
  for (size_t i = 0; i < points.size(); ++i) {
    const bool valid = valid_direction(points[i]);
    DirectionRow& row = rows[i / kLanes];
    row.x[i % kLanes] = valid ? points[i].w.x() : 0;
    row.y[i % kLanes] = valid ? points[i].w.y() : 0;
    row.z[i % kLanes] = valid ? points[i].w.z() : 0;
    row.weight[i % kLanes] = valid ? std::min(points[i].weight, weights.cap) * weights.scale : 0;
  }
}

VmfResponsibility::VmfResponsibility(const VmfComponent& c)
    : mean_x(c.mean.x()), mean_y(c.mean.y()), mean_z(c.mean.z()) {
  const float kappa = std::min(c.kappa, kMaxKappa);
  half = 0.5f * kLog2E * kappa;
  log2_norm = std::log2(std::max(c.weight * vmf_norm(kappa), 1e-30f));
}

VmfExpectation::VmfExpectation(std::span<const VmfComponent> components, Likelihood likelihood)
    : count_(components.size()), likelihood_(likelihood) {
  for (size_t k = 0; k < count_; ++k) model_[k] = VmfResponsibility(components[k]);
}

void VmfExpectation::add_moments(std::span<const DirectionRow> rows, const Lanes* share,
                                 Moments& moments) {
  Lanes s0{}, sx{}, sy{}, sz{};
  for (size_t r = 0; r < rows.size(); ++r) {
    s0 += share[r];
    sx += share[r] * rows[r].x, sy += share[r] * rows[r].y, sz += share[r] * rows[r].z;
  }
  moments[0] += lanes_sum(s0);
  moments[1] += lanes_sum(sx), moments[2] += lanes_sum(sy), moments[3] += lanes_sum(sz);
}

void VmfExpectation::add(std::span<const DirectionRow> rows) {
  Shares shares;
  const std::span<const VmfResponsibility> model(model_.data(), count_);
  for (; !rows.empty(); rows = rows.subspan(std::min(kBlockRows, rows.size()))) {
    const std::span<const DirectionRow> block = rows.first(std::min(kBlockRows, rows.size()));
    log2_likelihood_ += likelihood_ == Likelihood::sum
                            ? share_out<Likelihood::sum>(block, model, shares)
                            : share_out<Likelihood::skip>(block, model, shares);
    for (size_t k = 0; k < count_; ++k) add_moments(block, shares[k], moments_[k]);
  }
}

VmfBatchStatistics VmfExpectation::finish() const {
  double total = 0;
  for (size_t k = 0; k < count_; ++k) total += moments_[k][0];
  VmfBatchStatistics result;
  for (size_t k = 0; k < count_; ++k) {
    const Moments& m = moments_[k];
    const Eigen::Vector3d s1 = Eigen::Vector3d(m[1], m[2], m[3]) / total;
    if (m[0] > 1e-30 * total)
      result.components[k] = {static_cast<float>(m[0] / total), s1.cast<float>()};
  }
  result.log_likelihood = log2_likelihood_ * std::numbers::ln2 / total;
  return result;
}

int maximization(std::span<VmfStatistics> statistics, float samples, const VmfPrior& prior,
                 std::span<VmfComponent> components) {
  const float n = std::max(samples, 1.0f);
  int count = 0;
  for (const VmfStatistics& s : statistics)
    if (n * s.s0 >= kMinSupport) statistics[count++] = s;
  for (int k = 0; k < count; ++k) {
    components[k] = lobe_of(statistics[k], n, prior);
    components[k].weight = (n * statistics[k].s0 + prior.v - 1) / (n + count * (prior.v - 1));
  }
  return count;
}

}  // namespace waylight
