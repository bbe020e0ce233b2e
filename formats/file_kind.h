#pragma once
// Which of our files a file is.

#include <string>
#include <string_view>

namespace waylight {

enum class FileKind { brdf, cache, photons, exr, unknown };

// By content: the FlatBuffers identifier or EXR's magic number. Throws Error when it cannot be
// read.
FileKind identify_file(const std::string& path);

// The same of the first bytes of a file; kFileHeadBytes are enough.
inline constexpr size_t kFileHeadBytes = 12;
FileKind identify_bytes(std::string_view head);

// What messages call it: "a BRDF cache (*.brdf)".
const char* describe(FileKind kind);

}  // namespace waylight
