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
  // Narrower lobes are allowed than a training from photons does: the points are free of noise.
  MixturePrior prior{1.01f, 2.01f, 5e-6f};

  void validate() const;
};

struct MaterialFitSummary {
  std::string name, kind;
  bool textured = false;
  int entries = 0;
  double mean_components = 0;
  double held_out_error = 0;  // mean over entries
  double seconds = 0;         // of one core, summed over the entries
  size_t bytes = 0;
  std::string shares_with;  // an earlier material of the same BSDF whose entries serve this one
};

struct BrdfFitSummary {
  std::vector<MaterialFitSummary> materials;
  std::vector<std::string> skipped;  // "name (kind): why"; delta and null materials and the like
};

struct BrdfFitResult {
  BrdfCache cache;
  BrdfFitSummary summary;
};

// Fits the front of every material that a shape shows, and the back where a two-sided material has
// another one there. Anisotropic lobes are fitted to their mean over all azimuths of wo, textured
// ones at mean parameters; both are warned of. Left out are delta and null materials, and those
// with rough transmission: the guides stand over one hemisphere. A stopped run keeps the materials
// that were complete. The result depends neither on the number of threads nor on the other
// materials of the scene.
BrdfFitResult fit_brdfs(const SceneDescription& scene, const BrdfFitOptions& options,
                        const RunControl& control);

}  // namespace waylight
