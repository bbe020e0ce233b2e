#pragma once

#include "tools/render/render_tool.h"

namespace waylight {

// The options with --size, --crop and --aov read into them, and 64 samples when nothing ends the
// render. Throws Misuse naming the option.
RenderOptions complete_options(const RenderArguments& arguments);

const char* mode_name(RenderMode mode);

// The mode, with roulette and splitting where they are not the mode's own: the name of a line in a
// chart.
std::string method_name(const RenderOptions& options);

}  // namespace waylight
