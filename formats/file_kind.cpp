#include "formats/file_kind.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "libguide/base/error.h"

namespace waylight {

FileKind identify_bytes(std::string_view head) {
  const auto has = [head](size_t offset, std::string_view magic) {
    return head.size() >= offset + magic.size() && head.substr(offset, magic.size()) == magic;
  };
  if (has(4, "WBRF")) return FileKind::brdf;
  if (has(4, "WCCH")) return FileKind::cache;
  if (has(8, "WPHO")) return FileKind::photons;  // after the size of the chunk
  if (has(0, "\x76\x2f\x31\x01")) return FileKind::exr;
  return FileKind::unknown;
}

FileKind identify_file(const std::string& path) {
  if (std::filesystem::is_directory(path)) fail("\"{}\": is a folder, not a file", path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             std::fclose);
  if (!file) fail("\"{}\": cannot open: {}", path, std::strerror(errno));
  char head[kFileHeadBytes];
  const size_t count = std::fread(head, 1, sizeof(head), file.get());
  if (std::ferror(file.get())) fail("\"{}\": cannot read: {}", path, std::strerror(errno));
  return identify_bytes({head, count});
}

const char* describe(FileKind kind) {
  switch (kind) {
    case FileKind::brdf:
      return "a BRDF cache (*.brdf)";
    case FileKind::cache:
      return "an illumination cache (*.cache)";
    case FileKind::photons:
      return "a photon stream (*.photons)";
    case FileKind::exr:
      return "an OpenEXR image (*.exr)";
    case FileKind::unknown:
      break;
  }
  return "no file of Waylight";
}

}  // namespace waylight
