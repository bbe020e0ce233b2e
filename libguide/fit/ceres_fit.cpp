#include "libguide/fit/ceres_fit.h"

#include <ceres/tiny_solver.h>

#include <Eigen/Dense>
#include <algorithm>

#include "libguide/directional/gaussian_mixture.h"
#include "libguide/fit/lobe_parameters.h"

namespace waylight {
namespace {

// Of the density over the disk, on which a uniform one is 1 / pi. A guide is mixed with BSDF
// sampling, so that where its density is less than this the other's share decides.
constexpr float kFloor = 0.05f;
// Of rho: relative errors above it count by their size, not by its square.
constexpr float kSoft = 0.1f;
// Of components that are kept; a softmax never drops one by itself.
constexpr float kMinWeight = 1e-5f;

using Wide = double __attribute__((vector_size(64)));

// Residuals and their derivatives, eight points at a time, as ceres::TinySolver asks for them. The
// columns of its Jacobian are contiguous over the points.
class RelativeError {
 public:
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = Eigen::Dynamic };

  RelativeError(std::span<const LobeRow> rows, size_t components)
      : rows_(rows), components_(components) {}

  // An odd number of rows of eight: columns a multiple of 4 KiB apart would share one set of the
  // first-level cache, which was measured to cost a factor of three.
  int NumResiduals() const { return static_cast<int>((rows_.size() | 1) * kLanes); }
  int NumParameters() const { return static_cast<int>(components_.size()) * kComponentParameters; }

  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    unpack(parameters, components_);
    for (size_t i = 0; i < rows_.size(); ++i)
      evaluate(i, residuals + i * kLanes, jacobian ? jacobian + i * kLanes : nullptr);
    if (rows_.size() % 2 == 0) clear_last(residuals, jacobian);
    return true;
  }

 private:
  static void store(Lanes v, double* to) {
    const Wide wide = __builtin_convertvector(v, Wide);
    __builtin_memcpy(to, &wide, sizeof wide);
  }

  // With h = sqrt((1 + q) / 2) and q = sqrt(1 + (r / c)^2) the root of rho is r / h, and its
  // derivative by r is h / q.
  void evaluate(size_t i, double* residuals, double* jacobian) const {
    const LobeRow& row = rows_[i];
    ParameterGaussian::At at[kMaxEmComponents];
    Lanes g{};
    for (size_t k = 0; k < components_.size(); ++k)
      g += (at[k] = components_[k].at(row.x, row.y)).density;
    const Lanes inverse = 1 / (g + kFloor);
    const Lanes r = row.area > 0 ? (g - row.target) * inverse : Lanes{};
    const Lanes q = lanes_sqrt(1 + r * r * (1 / (kSoft * kSoft))), h = lanes_sqrt(0.5f * (1 + q));
    store(r / h, residuals);
    if (!jacobian) return;
    const Lanes r_by_g = row.area > 0 ? (row.target + kFloor) * inverse * inverse : Lanes{};
    for (size_t k = 0; k < components_.size(); ++k)
      store_derivatives(components_[k], at[k], g, h / q * r_by_g,
                        jacobian + k * kComponentParameters * NumResiduals());
  }

  void store_derivatives(const ParameterGaussian& c, const ParameterGaussian::At& at, Lanes g,
                         Lanes by_g, double* jacobian) const {
    Lanes d[kComponentParameters];
    c.log_derivatives(at, d);
    const Lanes by_log = by_g * at.density;
    store(by_log - by_g * g * c.weight, jacobian);
    for (int p = 1; p < kComponentParameters; ++p)
      store(by_log * d[p], jacobian + p * NumResiduals());
  }

  void clear_last(double* residuals, double* jacobian) const {
    const size_t begin = rows_.size() * kLanes;
    std::fill_n(residuals + begin, kLanes, 0.0);
    for (int p = 0; jacobian && p < NumParameters(); ++p)
      std::fill_n(jacobian + p * NumResiduals() + begin, kLanes, 0.0);
  }

  std::span<const LobeRow> rows_;
  mutable std::vector<ParameterGaussian> components_;
};

bool all_valid(std::span<const GaussianComponent> components) {
  return std::ranges::all_of(components, [](const GaussianComponent& c) {
    return GaussianMixture(std::span(&c, 1)).count() == 1;
  });
}

}  // namespace

double relative_cost(std::span<const LobeRow> rows, std::span<const GaussianComponent> components) {
  const RelativeError error(rows, components.size());
  Eigen::VectorXd residuals(error.NumResiduals());
  error(parameters_of(components).data(), residuals.data(), nullptr);
  return residuals.squaredNorm() / (2 * rows.size() * kLanes);
}

CeresResult refine_mixture(std::span<const LobeRow> rows, std::span<const GaussianComponent> start,
                           const CeresOptions& options) {
  const RelativeError error(rows, start.size());
  Eigen::VectorXd parameters = parameters_of(start);
  ceres::TinySolver<RelativeError> solver;
  solver.options.max_num_iterations = options.max_iterations;
  solver.options.function_tolerance = 2 * options.tolerance * rows.size() * kLanes;
  solver.Solve(error, &parameters);
  CeresResult result{components_of(parameters), solver.summary.iterations};
  std::erase_if(result.components,
                [](const GaussianComponent& c) { return c.weight < kMinWeight; });
  // A step that is no number is refused by the solver; a start that is none is not.
  const bool better = solver.summary.final_cost <= solver.summary.initial_cost;
  if (!better || !all_valid(result.components))
    result.components.assign(start.begin(), start.end());
  return result;
}

}  // namespace waylight
