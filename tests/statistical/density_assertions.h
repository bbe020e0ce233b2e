#pragma once
// One assertion for every distribution: its density is what its sampler makes.
//
//   expect_valid_density(Sphere{}, "name", sample, pdf);
//     sample(Sampler&) -> std::optional<Vec3>   empty: a failed sample
//     pdf(const Vec3&) -> float                 per steradian
//   expect_valid_density(Disk{1}, ...)          Vec2 with |y|^2 <= 1, per unit area
//   expect_valid_density(Rectangle{lo, hi}, ...)  Vec2, per unit area
//
// Samples outside the domain (the lost mass of a Gaussian) count as failed. Checked are: the
// density is finite and not negative; its integral is one less the share of failed samples; a
// chi-square test at a fixed seed. Bins are the leaves of a k-d tree over a pilot run, so they
// follow lobes of any width; their probability comes from adaptive Gauss quadrature. Leaves are
// small, for the quadrature's sake; neighbours are joined into the bins of the test.

#include <gtest/gtest.h>

#include <optional>

#include "libguide/base/sampler.h"
#include "statistical/chi_square.h"

namespace waylight::testing {

struct Box {
  double lo[2], hi[2];
};

// Polar angles: precise for lobes near the poles, where z is not.
struct Sphere {
  using Point = Vec3;
  std::vector<Box> roots() const {
    const double pi = std::numbers::pi;
    return {{{0, -pi}, {pi / 2, pi}}, {{pi / 2, -pi}, {pi, pi}}};
  }
  Point point(double theta, double phi) const {
    return Eigen::Vector3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                           std::cos(theta))
        .cast<float>();
  }
  double jacobian(double theta) const { return std::sin(theta); }
  Eigen::Vector2d coordinates(const Point& w) const {
    return {std::atan2(std::hypot(double(w.x()), double(w.y())), double(w.z())),
            std::atan2(double(w.y()), double(w.x()))};
  }
};

struct Disk {
  using Point = Vec2;
  double max_radius2 = 1;

  std::vector<Box> roots() const {
    return {{{0, -std::numbers::pi}, {std::sqrt(max_radius2), std::numbers::pi}}};
  }
  Point point(double r, double phi) const {
    return Eigen::Vector2d(r * std::cos(phi), r * std::sin(phi)).cast<float>();
  }
  double jacobian(double r) const { return r; }
  Eigen::Vector2d coordinates(const Point& y) const {
    return {std::hypot(double(y.x()), double(y.y())), std::atan2(double(y.y()), double(y.x()))};
  }
};

struct Rectangle {
  using Point = Vec2;
  Vec2 lo = Vec2::Zero(), hi = Vec2::Ones();

  std::vector<Box> roots() const { return {{{lo.x(), lo.y()}, {hi.x(), hi.y()}}}; }
  Point point(double x, double y) const { return {float(x), float(y)}; }
  double jacobian(double /*x*/) const { return 1; }
  Eigen::Vector2d coordinates(const Point& y) const { return y.cast<double>(); }
};

struct DensityCheck {
  int samples = 60000, pilot = 8192, bins = 128, leaves_per_bin = 8;
  uint64_t seed = 1;
  double tolerance = 2e-3;     // of the integral, beyond four standard errors of the failures
  double significance = 1e-3;  // of all `tests` together
  int tests = 1;               // how many such checks run in all, for Šidák's correction
};

// Integral of density * jacobian over a box: 4 x 4 Gauss points against 8 x 8, split in four
// until they agree to the tolerance.
template <typename Domain, typename Pdf>
class BoxIntegral {
 public:
  BoxIntegral(const Domain& domain, const Pdf& pdf, double tolerance)
      : domain_(domain), pdf_(pdf), tolerance_(tolerance) {}

  double operator()(const Box& box) { return refine(box, gauss(box), 0); }
  bool finite() const { return finite_; }

 private:
  double refine(const Box& box, double coarse, int depth) {
    const double mid[2] = {0.5 * (box.lo[0] + box.hi[0]), 0.5 * (box.lo[1] + box.hi[1])};
    Box parts[4];
    double values[4], fine = 0;
    for (int i = 0; i < 4; ++i) {
      parts[i] = box;
      ((i & 1) ? parts[i].lo[0] : parts[i].hi[0]) = mid[0];
      ((i & 2) ? parts[i].lo[1] : parts[i].hi[1]) = mid[1];
      fine += values[i] = gauss(parts[i]);
    }
    if (depth >= 9 || (depth >= 1 && std::abs(fine - coarse) <= tolerance_)) return fine;
    double sum = 0;
    for (int i = 0; i < 4; ++i) sum += refine(parts[i], values[i], depth + 1);
    return sum;
  }

  double gauss(const Box& box) {
    constexpr double x[4] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                             0.8611363115940526};
    constexpr double w[4] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                             0.3478548451374538};
    const double half[2] = {0.5 * (box.hi[0] - box.lo[0]), 0.5 * (box.hi[1] - box.lo[1])};
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      const double a = box.lo[0] + half[0] * (1 + x[i]);
      for (int j = 0; j < 4; ++j) {
        const double density = pdf_(domain_.point(a, box.lo[1] + half[1] * (1 + x[j])));
        finite_ = finite_ && std::isfinite(density) && density >= 0;
        sum += w[i] * w[j] * domain_.jacobian(a) * density;
      }
    }
    return sum * half[0] * half[1];
  }

  const Domain& domain_;
  const Pdf& pdf_;
  double tolerance_;
  bool finite_ = true;
};

// Boxes that share out a pilot run evenly, leaving out the space where it has no points.
class Bins {
 public:
  Bins(const Box& root, std::vector<Eigen::Vector2d> pilot, int count) {
    split(root, {pilot.data(), pilot.data() + pilot.size()}, count);
  }
  const std::vector<Box>& boxes() const { return boxes_; }

  // Index of the box that holds the point.
  int find(const Eigen::Vector2d& p) const {
    int node = 0;
    while (nodes_[node].axis >= 0)
      node = nodes_[node].child[p[nodes_[node].axis] >= nodes_[node].at];
    return nodes_[node].child[0];
  }

 private:
  struct Node {
    int axis;
    double at;
    int child[2];
  };
  struct Points {
    Eigen::Vector2d *first, *last;
    ptrdiff_t size() const { return last - first; }
  };
  struct Cut {
    int axis;
    double at;
    bool keep_high;
  };

  int split(const Box& box, Points points, int count) {
    const int node = static_cast<int>(nodes_.size());
    nodes_.push_back({-1, 0, {static_cast<int>(boxes_.size()), 0}});
    const std::optional<Cut> cut = points.size() >= 4 ? gap(box, points) : std::nullopt;
    if (!cut && (count < 2 || points.size() < 2)) {
      boxes_.push_back(box);
      return node;
    }
    const Points none{points.last, points.last};
    if (cut)
      branch(node, box, cut->axis, cut->at, cut->keep_high ? none : points,
             cut->keep_high ? points : none, cut->keep_high ? 1 : count,
             cut->keep_high ? count : 1);
    else
      halve(node, box, points, count);
    return node;
  }

  void halve(int node, const Box& box, Points points, int count) {
    const int axis = widest(points);
    Eigen::Vector2d* middle = points.first + points.size() / 2;
    std::nth_element(points.first, middle, points.last,
                     [&](const auto& a, const auto& b) { return a[axis] < b[axis]; });
    branch(node, box, axis, (*middle)[axis], {points.first, middle}, {middle, points.last},
           count / 2, count - count / 2);
  }

  void branch(int node, const Box& box, int axis, double at, Points low, Points high, int low_count,
              int high_count) {
    Box low_box = box, high_box = box;
    low_box.hi[axis] = high_box.lo[axis] = std::clamp(at, box.lo[axis], box.hi[axis]);
    const int left = split(low_box, low, low_count);
    const int right = split(high_box, high, high_count);
    nodes_[node] = {axis, at, {left, right}};
  }

  // A plane that cuts off at least a quarter of the box where no points are, a margin beside them.
  static std::optional<Cut> gap(const Box& box, Points points) {
    for (int axis = 0; axis < 2; ++axis) {
      const auto [lo, hi] =
          std::minmax_element(points.first, points.last,
                              [=](const auto& a, const auto& b) { return a[axis] < b[axis]; });
      const double margin = 0.25 * ((*hi)[axis] - (*lo)[axis]);
      const double least = 0.25 * (box.hi[axis] - box.lo[axis]);
      const double low = (*lo)[axis] - margin, high = (*hi)[axis] + margin;
      if (low - box.lo[axis] > least) return Cut{axis, low, true};
      if (box.hi[axis] - high > least) return Cut{axis, high, false};
    }
    return std::nullopt;
  }

  // The axis along which the points spread over more.
  static int widest(Points points) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero(), square = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d* p = points.first; p != points.last; ++p) mean += *p;
    mean /= double(points.size());
    for (const Eigen::Vector2d* p = points.first; p != points.last; ++p)
      square += (*p - mean).cwiseAbs2();
    return square[0] >= square[1] ? 0 : 1;
  }

  std::vector<Node> nodes_;
  std::vector<Box> boxes_;
};

inline bool inside(const Box& box, const Eigen::Vector2d& p) {
  return p[0] >= box.lo[0] && p[0] <= box.hi[0] && p[1] >= box.lo[1] && p[1] <= box.hi[1];
}

// Integral of the density over the whole domain, by the same quadrature.
template <typename Domain, typename Pdf>
double integrate_density(const Domain& domain, const Pdf& pdf, double tolerance = 1e-6) {
  BoxIntegral<Domain, Pdf> integral(domain, pdf, tolerance);
  double sum = 0;
  for (const Box& root : domain.roots()) sum += integral(root);
  return sum;
}

namespace detail {

// Coordinates of independent samples; failed and outside ones are left out.
template <typename Domain, typename Sample>
std::vector<Eigen::Vector2d> draw(const Domain& domain, const Sample& sample, int count,
                                  uint64_t seed) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < count; ++i) {
    Sampler sampler(seed, i, 0);
    const std::optional<typename Domain::Point> point = sample(sampler);
    if (point) points.push_back(domain.coordinates(*point));
  }
  return points;
}

}  // namespace detail

template <typename Domain, typename Sample, typename Pdf>
void expect_valid_density(const Domain& domain, const std::string& name, const Sample& sample,
                          const Pdf& pdf, const DensityCheck& check = {}) {
  const std::vector<Eigen::Vector2d> pilot =
      detail::draw(domain, sample, check.pilot, hash_combine(check.seed, 1));
  const std::vector<Eigen::Vector2d> points =
      detail::draw(domain, sample, check.samples, hash_combine(check.seed, 2));
  BoxIntegral<Domain, Pdf> integral(domain, pdf, 5e-4 * check.tolerance);
  const int leaves = check.bins * check.leaves_per_bin;
  std::vector<double> probability;
  std::vector<int> count;
  for (const Box& root : domain.roots()) {
    std::vector<Eigen::Vector2d> here;
    for (const Eigen::Vector2d& p : pilot)
      if (inside(root, p)) here.push_back(p);
    const int share = leaves * here.size() / std::max<size_t>(1, pilot.size());
    const Bins bins(root, here, std::max(1, share));
    const size_t offset = count.size();
    const size_t size = bins.boxes().size();
    probability.resize(offset + (size + check.leaves_per_bin - 1) / check.leaves_per_bin);
    count.resize(probability.size());
    for (size_t i = 0; i < size; ++i)
      probability[offset + i / check.leaves_per_bin] += integral(bins.boxes()[i]);
    for (const Eigen::Vector2d& p : points)
      if (inside(root, p)) ++count[offset + bins.find(p) / check.leaves_per_bin];
  }
  const int kept = std::accumulate(count.begin(), count.end(), 0);
  const double total = std::accumulate(probability.begin(), probability.end(), 0.0);
  const double failed = 1 - double(kept) / check.samples;
  const double error = std::sqrt(failed * (1 - failed) / check.samples);
  EXPECT_TRUE(integral.finite()) << name << ": density negative or not finite";
  EXPECT_LE(total, 1 + check.tolerance) << name << ": density integrates to more than one";
  EXPECT_NEAR(total + failed, 1, check.tolerance + 4 * error)
      << name << ": density integrates to " << total << " with a share of failed samples "
      << failed;
  // Conditional on success: the share of failures has been checked above.
  for (double& p : probability) p /= total;
  const ChiSquare result = chi_square(probability, count);
  EXPECT_GE(result.p_value, 1 - std::pow(1 - check.significance, 1.0 / check.tests))
      << name << ": chi-square " << result.statistic << " with " << result.freedom
      << " degrees of freedom, p = " << result.p_value << "\n"
      << result.table;
}

}  // namespace waylight::testing
