#include "formats/file_map.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "libguide/base/error.h"

namespace waylight {
namespace {

struct Descriptor {
  int value;
  ~Descriptor() {
    if (value >= 0) ::close(value);
  }
};

}  // namespace

FileMap::FileMap(const std::string& path) : path_(path) {
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  struct stat status = {};
  if (file.value < 0 || ::fstat(file.value, &status) != 0)
    fail("\"{}\": cannot open: {}", path, std::strerror(errno));
  if (S_ISDIR(status.st_mode)) fail("\"{}\": is a folder, not a file", path);
  if (!S_ISREG(status.st_mode)) fail("\"{}\": is not a regular file: copy it to one", path);
  if (status.st_size == 0) fail("\"{}\": is empty", path);
  size_ = static_cast<size_t>(status.st_size);
  data_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.value, 0);
  if (data_ == MAP_FAILED) fail("\"{}\": cannot map: {}", path, std::strerror(errno));
}

FileMap::~FileMap() { ::munmap(data_, size_); }

}  // namespace waylight
