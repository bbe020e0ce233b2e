#pragma once
// Lobes as pictures: densities on the equal-area disk in false colours.

#include <optional>
#include <string>

#include "tools/common/scene_arguments.h"

namespace waylight {

struct LobePlotArguments {
  // Index of a cell, X,Y,Z of a place in a medium, or name or index of a material.
  std::string target;
  std::string output;              // picture to write
  std::string samples;             // photon file, or empty
  std::string truth;               // picture of `render --sphere`, or empty
  bool direct = false;             // photons straight from an emitter are drawn too
  SceneArguments scene;            // path empty: no BSDF beside the fit
  std::optional<float> elevation;  // of wo, in degrees from the normal; 45 where not given
  int size = 256;                  // pixels along the side of one disk
};

// The mixture of a cell, and the photons that fall into it.
void plot_cell(const ToolRun& run, const std::string& cache, const LobePlotArguments& arguments);

// The mixture fitted to a material, and the BSDF itself.
void plot_material(const ToolRun& run, const std::string& brdf, const LobePlotArguments& arguments);

}  // namespace waylight
