#include "formats/file_bytes.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "formats/atomic_file.h"

namespace waylight {

std::string read_whole_file(const std::string& path) {
  if (std::filesystem::is_directory(path)) fail("\"{}\": is a folder, not a file", path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             std::fclose);
  if (!file) fail("\"{}\": cannot open: {}", path, std::strerror(errno));
  std::string bytes;
  std::error_code unknown_size;
  const auto size = std::filesystem::file_size(path, unknown_size);
  if (!unknown_size) bytes.reserve(size + 1);
  char block[1 << 16];
  while (const size_t count = std::fread(block, 1, sizeof(block), file.get()))
    bytes.append(block, count);
  if (std::ferror(file.get())) fail("\"{}\": cannot read: {}", path, std::strerror(errno));
  return bytes;
}

void write_whole_file(const std::string& path, std::string_view bytes) {
  write_atomically(path, [&](const std::string& temporary) {
    std::FILE* file = std::fopen(temporary.c_str(), "wb");
    if (!file) fail("\"{}\": cannot write: {}", path, std::strerror(errno));
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    if (std::fclose(file) != 0 || !written)
      fail("\"{}\": cannot write: {}", path, std::strerror(errno));
  });
}

}  // namespace waylight
