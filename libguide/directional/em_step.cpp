#include "libguide/directional/em_step.h"

namespace waylight {
namespace {

constexpr float kPlaceLimit = kDiskMaxRadius2 * 1.0001f;  // of |y|^2, with room for rounding

// About the component's old mean.
void add_moments(std::span<const PointRow> rows, const Responsibility& component,
                 const Lanes* share, Moments& moments) {
  Lanes s0{}, sx{}, sy{}, sxx{}, sxy{}, syy{};
  for (size_t r = 0; r < rows.size(); ++r) {
    const Lanes dx = rows[r].x - component.mean_x, dy = rows[r].y - component.mean_y;
    const Lanes gx = share[r] * dx, gy = share[r] * dy;
    s0 += share[r], sx += gx, sy += gy;
    sxx += gx * dx, sxy += gx * dy, syy += gy * dy;
  }
  const Lanes sums[] = {s0, sx, sy, sxx, sxy, syy};
  for (size_t m = 0; m < moments.size(); ++m) moments[m] += lanes_sum(sums[m]);
}

// Of the variances and of their determinant after an M-step, what over-relaxation has to leave.
constexpr float kLeastVariance = 0.3f, kLeastDeterminant = 0.1f;

float determinant(const GaussianComponent& c) { return c.cov_xx * c.cov_yy - sqr(c.cov_xy); }

GaussianComponent beyond(const GaussianComponent& from, const GaussianComponent& to,
                         float further) {
  const auto go_on = [&](float a, float b) { return b + further * (b - a); };
  const float ratio = to.weight / from.weight;  // lobes that shrink do so geometrically
  return {ratio > 1 ? go_on(from.weight, to.weight) : to.weight * std::pow(ratio, further),
          go_on(from.mean_x, to.mean_x),
          go_on(from.mean_y, to.mean_y),
          go_on(from.cov_xx, to.cov_xx),
          go_on(from.cov_xy, to.cov_xy),
          go_on(from.cov_yy, to.cov_yy)};
}

}  // namespace

ComponentStatistics statistics_of(const Moments& sums, double total, const Vec2& origin) {
  const double s0 = sums[0] / total, sx = sums[1] / total, sy = sums[2] / total;
  if (!(s0 > 1e-30)) return {};
  ComponentStatistics s;
  s.s0 = s0;
  s.s1_x = s0 * origin.x() + sx, s.s1_y = s0 * origin.y() + sy;
  s.s2_xx = std::max(sums[3] / total - sx * sx / s0, 0.0);
  s.s2_yy = std::max(sums[5] / total - sy * sy / s0, 0.0);
  const double limit = std::sqrt(static_cast<double>(s.s2_xx) * s.s2_yy);
  s.s2_xy = std::clamp(sums[4] / total - sx * sy / s0, -limit, limit);
  return s;
}

bool valid_point(const WeightedPoint& point) {
  // Comparisons reject NaN, infinity and what lies off the domain.
  return point.weight > 0 && point.weight <= std::numeric_limits<float>::max() &&
         point.y.squaredNorm() <= kPlaceLimit;
}

BatchWeights scan_weights(std::span<const WeightedPoint> points, float max_weight) {
  const auto weight_of = [&](size_t i) { return valid_point(points[i]) ? points[i].weight : 0.0f; };
  return scan_weights(points.size(), weight_of, max_weight);
}

Responsibility::Responsibility(const GaussianComponent& c) : mean_x(c.mean_x), mean_y(c.mean_y) {
  const double xx = std::max(c.cov_xx, kCovarianceFloor);
  const double m = c.cov_xy / xx;
  const double yy = std::max<double>(c.cov_yy - m * c.cov_xy, kCovarianceFloor);
  const double norm = c.weight / (2 * std::numbers::pi * std::sqrt(xx * yy));
  slope = m;
  inverse_a = std::sqrt(0.5 * std::numbers::log2e / xx);
  inverse_b = std::sqrt(0.5 * std::numbers::log2e / yy);
  log2_norm = std::log2(std::max(norm, 1e-30));
}

void fill_rows(std::span<const WeightedPoint> points, const BatchWeights& weights,
               std::span<PointRow> rows) {
  if (points.size() % kLanes) rows.back() = {};
  for (size_t i = 0; i < points.size(); ++i) {
    const bool valid = valid_point(points[i]);
    PointRow& row = rows[i / kLanes];
    row.x[i % kLanes] = valid ? points[i].y.x() : 0;
    row.y[i % kLanes] = valid ? points[i].y.y() : 0;
    row.weight[i % kLanes] = valid ? std::min(points[i].weight, weights.cap) * weights.scale : 0;
  }
}

Expectation::Expectation(std::span<const GaussianComponent> components, Likelihood likelihood)
    : components_(components), likelihood_(likelihood) {
  for (size_t k = 0; k < components.size(); ++k) model_[k] = Responsibility(components[k]);
}

void Expectation::add(std::span<const PointRow> rows) {
  Shares shares;
  const std::span<const Responsibility> model(model_.data(), components_.size());
  for (; !rows.empty(); rows = rows.subspan(std::min(kBlockRows, rows.size()))) {
    const std::span<const PointRow> block = rows.first(std::min(kBlockRows, rows.size()));
    log2_likelihood_ += likelihood_ == Likelihood::sum
                            ? share_out<Likelihood::sum>(block, model, shares)
                            : share_out<Likelihood::skip>(block, model, shares);
    for (size_t k = 0; k < model.size(); ++k) add_moments(block, model[k], shares[k], moments_[k]);
  }
}

BatchStatistics Expectation::finish() const {
  double total = 0;
  for (size_t k = 0; k < components_.size(); ++k) total += moments_[k][0];
  BatchStatistics result;
  for (size_t k = 0; k < components_.size(); ++k)
    result.components[k] =
        statistics_of(moments_[k], total, {components_[k].mean_x, components_[k].mean_y});
  result.log_likelihood = log2_likelihood_ * std::numbers::ln2 / total;
  return result;
}

ComponentStatistics blend(const ComponentStatistics& a, float keep, const ComponentStatistics& b,
                          float add) {
  const float wa = keep * a.s0, wb = add * b.s0;
  if (!(wa > 0))
    return {wb, add * b.s1_x, add * b.s1_y, add * b.s2_xx, add * b.s2_xy, add * b.s2_yy};
  if (!(wb > 0))
    return {wa, keep * a.s1_x, keep * a.s1_y, keep * a.s2_xx, keep * a.s2_xy, keep * a.s2_yy};
  const float dx = b.s1_x / b.s0 - a.s1_x / a.s0, dy = b.s1_y / b.s0 - a.s1_y / a.s0;
  const float between = wa * (wb / (wa + wb));
  return {wa + wb,
          keep * a.s1_x + add * b.s1_x,
          keep * a.s1_y + add * b.s1_y,
          keep * a.s2_xx + add * b.s2_xx + between * dx * dx,
          keep * a.s2_xy + add * b.s2_xy + between * dx * dy,
          keep * a.s2_yy + add * b.s2_yy + between * dy * dy};
}

int maximization(std::span<ComponentStatistics> statistics, float samples,
                 const MixturePrior& prior, std::span<GaussianComponent> components) {
  const float n = std::max(samples, 1.0f);
  int count = 0;
  for (const ComponentStatistics& s : statistics)
    if (n * s.s0 >= kMinSupport) statistics[count++] = s;
  for (int k = 0; k < count; ++k) {
    const ComponentStatistics& s = statistics[k];
    const float scale = 1 / (prior.a - 2 + n * s.s0);
    components[k] = {(n * s.s0 + prior.v - 1) / (n + count * (prior.v - 1)),
                     s.s1_x / s.s0,
                     s.s1_y / s.s0,
                     (prior.b + n * s.s2_xx) * scale,
                     n * s.s2_xy * scale,
                     (prior.b + n * s.s2_yy) * scale};
  }
  return count;
}

void over_relax(std::span<const GaussianComponent> before, float step,
                std::span<GaussianComponent> components) {
  if (before.size() != components.size()) return;
  float sum = 0;
  for (size_t k = 0; k < components.size(); ++k) {
    GaussianComponent& c = components[k];
    const GaussianComponent further = beyond(before[k], c, step - 1);
    if (further.cov_xx > kLeastVariance * c.cov_xx && further.cov_yy > kLeastVariance * c.cov_yy &&
        determinant(further) > kLeastDeterminant * determinant(c))
      c = further;
    sum += c.weight;
  }
  for (GaussianComponent& c : components) c.weight /= sum;
}

}  // namespace waylight
