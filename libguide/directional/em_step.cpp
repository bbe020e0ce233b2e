#include "libguide/directional/em_step.h"

namespace waylight {
namespace {

constexpr float kMinSupport = 1e-3f;  // of a sample
constexpr size_t kBlock = 512;        // points summed in float before they go into doubles
constexpr int kMoments = 6;
constexpr float kPlaceLimit = kDiskMaxRadius2 * 1.0001f;  // of |y|^2, with room for rounding

// One component a lane, in the form that the E-step needs; unused lanes are never responsible.
struct Responsibility {
  Lanes mean_x{}, mean_y{}, slope{}, inverse_a{}, inverse_b{};
  Lanes log2_norm = splat(-1e30f);

  explicit Responsibility(std::span<const GaussianComponent> components);

  // log2 of weight times density. Subtracting the largest before the exponential keeps a point far
  // from all lobes with the nearest one.
  Lanes log2_density(Lanes dx, Lanes dy) const {
    const Lanes a = dx * inverse_a, b = (dy - slope * dx) * inverse_b;
    return log2_norm - a * a - b * b;
  }
};

Responsibility::Responsibility(std::span<const GaussianComponent> components) {
  for (size_t k = 0; k < components.size(); ++k) {
    const GaussianComponent& c = components[k];
    const double xx = std::max(c.cov_xx, kCovarianceFloor);
    const double m = c.cov_xy / xx;
    const double yy = std::max<double>(c.cov_yy - m * c.cov_xy, kCovarianceFloor);
    const double norm = c.weight / (2 * std::numbers::pi * std::sqrt(xx * yy));
    mean_x[k] = c.mean_x, mean_y[k] = c.mean_y, slope[k] = m;
    inverse_a[k] = std::sqrt(0.5 * std::numbers::log2e / xx);
    inverse_b[k] = std::sqrt(0.5 * std::numbers::log2e / yy);
    log2_norm[k] = std::log2(std::max(norm, 1e-30));
  }
}

using Sums = std::array<std::array<double, kLanes>, kMoments>;

template <Likelihood likelihood>
double sum_block(std::span<const WeightedPoint> points, const BatchWeights& weights,
                 const Responsibility& model, Sums& sums) {
  Lanes s0{}, sx{}, sy{}, sxx{}, sxy{}, syy{};
  double log2_likelihood = 0;
  for (const WeightedPoint& point : points) {
    if (!valid_point(point)) continue;
    const float w = std::min(point.weight, weights.cap) * weights.scale;
    const Lanes dx = point.y.x() - model.mean_x, dy = point.y.y() - model.mean_y;
    const Lanes log2_density = model.log2_density(dx, dy);
    const Lanes largest = lanes_max_splat(log2_density);
    const Lanes density = exp2_clamped(log2_density - largest);
    const float sum = lanes_sum(density);
    const Lanes g = density * (w / sum);
    const Lanes gx = g * dx, gy = g * dy;
    s0 += g, sx += gx, sy += gy;
    sxx += gx * dx, sxy += gx * dy, syy += gy * dy;
    if constexpr (likelihood == Likelihood::sum)
      log2_likelihood += w * (largest[0] + std::log2(sum));
  }
  const Lanes block[kMoments] = {s0, sx, sy, sxx, sxy, syy};
  for (int m = 0; m < kMoments; ++m)
    for (int k = 0; k < kLanes; ++k) sums[m][k] += block[m][k];
  return log2_likelihood;
}

// From moments about the old mean to s1 about the origin and s2 about the new mean.
ComponentStatistics recentred(const Sums& sums, int k, double total, const GaussianComponent& c) {
  const double s0 = sums[0][k] / total, sx = sums[1][k] / total, sy = sums[2][k] / total;
  if (!(s0 > 1e-30)) return {};
  ComponentStatistics s;
  s.s0 = s0;
  s.s1_x = s0 * c.mean_x + sx, s.s1_y = s0 * c.mean_y + sy;
  s.s2_xx = std::max(sums[3][k] / total - sx * sx / s0, 0.0);
  s.s2_yy = std::max(sums[5][k] / total - sy * sy / s0, 0.0);
  const double limit = std::sqrt(static_cast<double>(s.s2_xx) * s.s2_yy);
  s.s2_xy = std::clamp(sums[4][k] / total - sx * sy / s0, -limit, limit);
  return s;
}

struct CutSums {
  double sum = 0, squares = 0;
};

CutSums cut_sums(std::span<const WeightedPoint> points, double cap) {
  CutSums result;
  for (const WeightedPoint& p : points) {
    if (!valid_point(p)) continue;
    const double w = std::min<double>(p.weight, cap);
    result.sum += w, result.squares += w * w;
  }
  return result;
}

}  // namespace

bool valid_point(const WeightedPoint& point) {
  // Comparisons reject NaN, infinity and what lies off the domain.
  return point.weight > 0 && point.weight <= std::numeric_limits<float>::max() &&
         point.y.squaredNorm() <= kPlaceLimit;
}

BatchWeights scan_weights(std::span<const WeightedPoint> points, float max_weight) {
  BatchWeights result;
  float largest = 0;
  for (const WeightedPoint& p : points) {
    const bool valid = valid_point(p);
    result.used += valid;
    result.rejected += !valid && !(p.weight == 0 && p.y.squaredNorm() <= kPlaceLimit);
    if (valid) largest = std::max(largest, p.weight);
  }
  if (result.used == 0) return result;
  // The cap is a fixed point, cap = ratio * mean(min(w, cap)), sought from above: each round takes
  // an outlier down by the factor ratio / n <= 1/2.
  const double ratio = std::max(1.0, std::min<double>(max_weight, 0.5 * result.used));
  CutSums sums = cut_sums(points, largest);
  double cap = largest;
  for (int round = 0; round < 128 && ratio * sums.sum < 0.999 * cap * result.used; ++round) {
    cap = ratio * sums.sum / result.used;
    sums = cut_sums(points, cap);
  }
  result.cap = static_cast<float>(cap);
  result.scale = static_cast<float>(result.used / sums.sum);
  result.effective = static_cast<float>(sums.sum * sums.sum / sums.squares);
  return result;
}

BatchStatistics expectation(std::span<const WeightedPoint> points, const BatchWeights& weights,
                            std::span<const GaussianComponent> components, Likelihood likelihood) {
  const Responsibility model(components);
  Sums sums{};
  double log2_likelihood = 0;
  for (size_t begin = 0; begin < points.size(); begin += kBlock) {
    const std::span<const WeightedPoint> block =
        points.subspan(begin, std::min(kBlock, points.size() - begin));
    log2_likelihood += likelihood == Likelihood::sum
                           ? sum_block<Likelihood::sum>(block, weights, model, sums)
                           : sum_block<Likelihood::skip>(block, weights, model, sums);
  }
  double total = 0;
  for (size_t k = 0; k < components.size(); ++k) total += sums[0][k];
  BatchStatistics result;
  for (size_t k = 0; k < components.size(); ++k)
    result.components[k] = recentred(sums, k, total, components[k]);
  result.log_likelihood = log2_likelihood * std::numbers::ln2 / total;
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

}  // namespace waylight
