#pragma once
// One reader per family of picture formats; chosen by the first bytes of a file.

#include <string>

#include "formats/image_io.h"

namespace waylight {

bool is_exr(const std::string& path);
Image read_exr(const std::string& path, std::map<std::string, std::string>* attributes);

// PNG, JPEG, TGA and HDR: channels R, G, B and, where the file has it, A. The colour space says how
// integers of the file become linear; floats are linear unless it is srgb.
Image read_picture(const std::string& path, ColorSpace space);

// Throws Error when a picture would need more than 2^28 pixels or 2^30 numbers.
void check_image_size(const std::string& path, long long width, long long height, size_t channels);

}  // namespace waylight
