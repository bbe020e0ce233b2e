#pragma once

#include "tools/render/render_tool.h"

namespace waylight {

// The options with what is given as text (--size, --crop, --aov, --bsdf-share, --fluence, --sphere)
// read into them. Where nothing ends the render, its last checkpoint does, or 64 samples. Throws
// Misuse naming the option; what is returned is valid.
RenderOptions complete_options(const RenderArguments& arguments);

const char* mode_name(RenderMode mode);

// The mode, with distances, directions and roulette that are not the mode's own, the view that is
// not the camera's, and splitting: the name of a line in a chart.
std::string method_name(const RenderOptions& options);

}  // namespace waylight
