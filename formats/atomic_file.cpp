#include "formats/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "libguide/base/error.h"

namespace waylight {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const std::string& path) {
  const fs::path parent = fs::path(path).parent_path();
  return parent.empty() ? fs::path(".") : parent;
}

bool is_special(const std::string& path) {
  std::error_code error;
  return fs::exists(path, error) && !fs::is_regular_file(path, error);
}

// Tried, since access() says yes to root where nobody can write.
bool can_create_beside(const std::string& path) {
  const std::string probe = fmt::format("{}.probe{}", path, ::getpid());
  const int descriptor = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) return false;
  ::close(descriptor);
  return ::unlink(probe.c_str()) == 0;
}

// After a crash of the machine the name must not stand for a file whose blocks were never written.
void flush_to_disk(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY);
  if (descriptor < 0) fail("\"{}\": was not written", path);
  const int result = ::fsync(descriptor);
  const int error = errno;
  ::close(descriptor);
  if (result != 0) fail("\"{}\": cannot write: {}", path, std::strerror(error));
}

}  // namespace

void check_writable(const std::string& path) {
  const fs::path folder = folder_of(path);
  if (!fs::is_directory(folder))
    fail("\"{}\": the folder \"{}\" does not exist", path, folder.string());
  if (fs::is_directory(path)) fail("\"{}\": is a folder, not a file", path);
  const bool possible =
      is_special(path) ? ::access(path.c_str(), W_OK) == 0 : can_create_beside(path);
  if (!possible) fail("\"{}\": cannot write: {}", path, std::strerror(errno));
}

AtomicFile::AtomicFile(const std::string& path) : path_(path), temporary_(path) {
  check_writable(path);
  if (!is_special(path)) temporary_ += fmt::format(".tmp{}", ::getpid());
}

AtomicFile::~AtomicFile() {
  if (!done_ && temporary_ != path_) std::remove(temporary_.c_str());
}

void AtomicFile::commit() {
  if (temporary_ != path_) {
    flush_to_disk(temporary_);
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0)
      fail("\"{}\": cannot write: {}", path_, std::strerror(errno));
  }
  done_ = true;
}

void write_atomically(const std::string& path,
                      const std::function<void(const std::string&)>& write) {
  AtomicFile file(path);
  write(file.temporary());
  file.commit();
}

void write_text_atomically(const std::string& path, const std::string& text) {
  write_atomically(path, [&](const std::string& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out << text;
    out.close();
    if (!out) fail("\"{}\": cannot write (disk full?)", path);
  });
}

}  // namespace waylight
