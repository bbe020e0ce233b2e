#pragma once
// Which of our files a file is.

#include <string>

namespace waylight {

enum class FileKind { brdf, cache, photons, exr, unknown };

// By content: the FlatBuffers identifier or EXR's magic number. Throws Error when it cannot be read.
FileKind identify_file(const std::string& path);

}  // namespace waylight
