#pragma once
// Stage: Gaussian mixtures of every BSDF of a scene that has a density.

#include <string>
#include <vector>

#include "libguide/base/run_control.h"
#include "libguide/directional/expectation_maximization.h"
#include "libguide/records/brdf_cache.h"
#include "libguide/scene/scene_description.h"

namespace waylight {

struct BrdfFitOptions {
  int elevations = 512;  // entries per material that depends on wo, 1..4096
  int components = 8;    // K before reduction, 1..8
  int samples = 512;     // directions per entry, 16..65536
  uint64_t seed = 0;
  MixturePrior prior;

  void validate() const;
};

struct MaterialFitSummary {
  std::string name, kind;
  bool textured = false;
  int entries = 0;
  double mean_components = 0;
  double held_out_error = 0;  // mean over entries
  double seconds = 0;
  size_t bytes = 0;
};

struct BrdfFitSummary {
  std::vector<MaterialFitSummary> materials;
  std::vector<std::string> skipped;  // materials without density: delta and null
};

struct BrdfFitResult {
  BrdfCache cache;
  BrdfFitSummary summary;
};

BrdfFitResult fit_brdfs(const SceneDescription& scene, const BrdfFitOptions& options,
                        const RunControl& control);

}  // namespace waylight
