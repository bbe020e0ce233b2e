#pragma once
// What a report shows of a scene: its reference, and of each method the last image of the first
// seed, its error in false colours, and the same crop enlarged.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "libguide/image/picture.h"
#include "tools/report/runs.h"

namespace waylight {

using Attributes = std::map<std::string, std::string>;

struct Shot {
  Bitmap picture;             // of the size of the render
  std::vector<float> errors;  // relative, of each pixel; empty for the reference
  Attributes attributes;      // of the EXR
};

struct Pictures {
  Shot reference;
  // relMSE that the reference itself has, estimated from its own variance, where that is known.
  std::optional<double> reference_error;
  std::vector<Shot> methods;  // as in SceneRuns
  PixelWindow crop;
};

// `crop` is taken where it is given; else the window, a fifth of the picture wide, in which the
// errors of the methods differ most. Throws Error naming the file.
Pictures read_pictures(const SceneRuns& scene, const std::optional<PixelWindow>& crop);

}  // namespace waylight
