#pragma once
// The fit of one entry of a BRDF cache.

#include "libguide/fit/lobe_points.h"

namespace waylight {

// em: weighted MAP EM. ceres: its result refined by non-linear least squares. best: the better of
// the two, at points that neither has seen.
enum class FitMethod { best, em, ceres };

struct LobeFitOptions {
  int components = 8;  // 1..kMaxEmComponents
  int samples = 512;
  uint64_t seed = 0;
  MixturePrior prior{1.01f, 2.01f, 5e-6f};
  FitMethod method = FitMethod::best;
  bool fixed_components = false;  // or fewer where they do nearly as well
};

// Errors are held-out errors (lobe_error.h), all at the same points, which neither the fit nor the
// choices between fits have seen.
struct LobeFit {
  std::vector<GaussianComponent> components;  // at most 8; empty where f is zero everywhere
  std::vector<GaussianComponent> asked;  // with the number asked for: where a neighbour may start
  FitMethod method = FitMethod::em;      // what made them
  float error = 0;                       // of `components`
  float em_error = 0, ceres_error = 0;   // of each method with the components asked for; a method
                                         // that was not run has the other's
  double em_seconds = 0;                 // of drawing the points and of EM
  double ceres_seconds = 0;              // of the refinement, beside that
  int ceres_iterations = 0;
  double seconds = 0;  // of all, with the choices and the held-out error
};

// Fits entries that share their random numbers. Safe to use from several threads.
class LobeFitter {
 public:
  explicit LobeFitter(const LobeFitOptions& options);

  // neighbour: the fit of a wo near by, or nothing. The refinement starts from it where it is the
  // better start. The result depends on the arguments alone.
  LobeFit fit(const LobeTarget& target, std::span<const GaussianComponent> neighbour = {}) const;

  // What EM and the refinement see: three quarters of the samples drawn by the BSDF's own sampler,
  // and, so that f / pdf is bounded where f is not small and that sampler seldom goes (f / p of a
  // cosine-weighted sampler grows as 1 / cos), one quarter stratified over the hemisphere.
  std::vector<LobePoint> draw_points(const LobeTarget& target) const;

  // Weighted MAP EM from one start. Measured over 20 lobes: further starts by k-means++ gain
  // nothing on the mean, and four times the points a fifth of the error for four times the time.
  std::vector<GaussianComponent> fit_em(const LobeTarget& target,
                                        std::span<const LobePoint> points) const;

 private:
  struct Work;  // on one entry

  std::vector<Vec2> start_centres(const LobeTarget& target) const;
  void fit_asked(Work& work, std::span<const GaussianComponent> neighbour) const;
  void choose_method(Work& work) const;
  void choose_count(Work& work) const;
  void report(Work& work) const;

  LobeFitOptions options_;
  std::vector<UnitPoint> lobe_units_, disk_units_, start_units_, selection_units_, report_units_;
};

}  // namespace waylight
