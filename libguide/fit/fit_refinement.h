#pragma once
// As many fits as keep the error between their places below a tolerance, and no more.

#include <functional>
#include <memory>
#include <vector>

#include "libguide/base/run_control.h"
#include "libguide/fit/lobe_fit.h"
#include "libguide/records/brdf_cache.h"

namespace waylight {

struct EntryFit {
  std::vector<GaussianComponent> components;
  float held_out_error = 0;
  LobeFit details;  // of a fit made here, without its components
};

// The entry that serves a place, and the rotation from its frame to that of the place.
struct ServingEntry {
  int entry;
  Mat3 rotation;
};

// What is fitted at place i of n, and which of n entries serve place i of n / 2.
struct FitPlaces {
  std::function<LobeTarget(int i, int n)> target;
  std::function<std::vector<ServingEntry>(int i, int n)> serving;
};

// Fits `first`, twice, four times ... as many entries. A number suffices once, at the places of the
// number before, the error of the entries that serve them is no more than `tolerance` above that of
// the places' own fits, in the mean. The last number is `most`, reached at once where the tolerance
// is 0.
class FitRefinement {
 public:
  FitRefinement(FitPlaces places, int first, int most, float tolerance,
                const LobeFitOptions& options);

  // What can be run in parallel now; 0 when all is done. advance() after all of it was run.
  size_t tasks() const;
  void run(size_t task);
  void advance();

  const std::vector<EntryFit>& entries() const { return entries_; }
  double seconds() const { return seconds_; }  // of one core, in all
  double seconds_per_fit() const { return fit_seconds_ / fits_; }

 private:
  enum class Phase { fit, test, done };

  void fit_entry(size_t i);
  void test_place(size_t i);
  void go_on();
  void start(int count);

  FitPlaces places_;
  int most_;
  float tolerance_;
  uint64_t seed_;
  std::shared_ptr<const LobeFitter> fitter_;
  Phase phase_ = Phase::fit;
  std::vector<EntryFit> entries_, coarser_;
  std::vector<float> excess_;         // over the error of the coarser places' own fits
  std::vector<double> task_seconds_;  // of the phase
  double seconds_ = 0, fit_seconds_ = 0;
  size_t fits_ = 0;
};

// The entries of a lobe: the wo of the layout.
FitPlaces wo_places(std::shared_ptr<const Bsdf> bsdf, EntryLayout layout);

// Runs them all, in parallel, until they are complete or the user stops.
void refine_all(std::span<FitRefinement> refinements, const RunControl& control);

}  // namespace waylight
