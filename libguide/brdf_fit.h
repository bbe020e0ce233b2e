#pragma once
// Stage: Gaussian mixtures of every BSDF of a scene that has a density.

#include <span>
#include <string>
#include <vector>

#include "libguide/base/run_control.h"
#include "libguide/fit/lobe_fit.h"
#include "libguide/records/brdf_cache.h"
#include "libguide/scene/scene_description.h"

namespace waylight {

struct BrdfFitOptions {
  // The error, over a fit's own, that is allowed between the wo of two entries, between two widths
  // of a textured one, and between materials that share entries; 0..2, 0: none but rounding.
  float tolerance = 0.02f;
  int elevations = 512;   // most entries of a material that depends on the elevation of wo, 2..4096
  int directions = 4096;  // most of one that depends on its azimuth too, 1..65536
  int components = 8;     // most of a mixture, 1..16; more than 8 are merged after the fit
  bool fixed_components = false;  // as many as that, also where fewer do nearly as well
  FitMethod method = FitMethod::best;
  int samples = 512;  // directions per entry, 16..65536
  uint64_t seed = 0;
  // Narrower lobes are allowed than a training from photons does: the points are free of noise.
  MixturePrior prior{1.01f, 2.01f, 5e-6f};

  void validate() const;
};

struct MaterialFitSummary {
  std::string name, kind;
  bool textured = false;
  int widths = 0;   // series of entries where the width is textured, else 0
  int entries = 0;  // of all series
  double mean_components = 0;
  double held_out_error = 0;  // means over entries, here and of the two methods (LobeFit)
  double em_error = 0, ceres_error = 0;      // not known, 0, where a family serves
  double ceres_share = 0;                    // of the entries that the refinement made
  double em_seconds = 0, ceres_seconds = 0;  // of one core, for the entries that were kept
  double seconds = 0;  // of one core, fits and tests that were not kept included
  size_t bytes = 0;
  bool from_family = false;  // its entries are those of a family that was given
  std::string shares_with;   // an earlier material of the same lobe whose entries serve this one
};

// One entry that was fitted here.
struct EntryFitSummary {
  size_t material = 0;  // index into BrdfFitSummary::materials
  float theta = 0;      // elevation of wo, radians from the normal
  size_t components = 0;
  LobeFit fit;  // without its components
};

struct FitCost {
  size_t entries = 0, bytes = 0;
  double seconds = 0;  // of one core
};

struct BrdfFitSummary {
  std::vector<MaterialFitSummary> materials;
  std::vector<EntryFitSummary> entries;  // by material and place; none where a family served
  std::vector<std::string> skipped;  // "name (kind): why"; delta and null materials and the like
  FitCost cost;
  // Estimated for as many entries as the options allow, for each material its own, at as many
  // widths.
  FitCost full;
  // Of the entries, had each that was fitted here as many as were asked for.
  size_t bytes_at_most_components = 0;
};

struct BrdfFitResult {
  BrdfCache cache;
  BrdfFitSummary summary;
};

// Fits the front of every material that a shape shows, and the back where a two-sided material has
// another one there. The number of entries follows the tolerance; materials whose lobes have one
// shape share theirs. Isotropic lobes have entries by elevation, anisotropic ones by direction;
// where the width is textured there are entries for a series of widths, everything else that is
// textured is fitted at its mean, which is warned of. Left out are delta and null materials, and
// those with rough transmission: the guides stand over one hemisphere. Empty where the user
// stopped. The result does not depend on the number of threads.
//
// families: results of fit_family. Their entries serve what they fit as well as their own lobe,
// within twice the tolerance, and are copied.
BrdfFitResult fit_brdfs(const SceneDescription& scene, const BrdfFitOptions& options,
                        const RunControl& control, std::span<const BrdfCache> families = {});

// One material whose width goes from 0.005 to 1, for any scene: roughconductor-ggx,
// roughconductor-beckmann, phong or ward, white and without a diffuse part. Misuse names others.
BrdfFitResult fit_family(const std::string& name, const BrdfFitOptions& options,
                         const RunControl& control);

}  // namespace waylight
