#pragma once

#include <string>
#include <string_view>

namespace waylight {

// A regular file in memory, read-only and without a copy. Files that our writers replace stay whole
// here: a new file takes the name, the old one lives until it is unmapped.
class FileMap {
 public:
  explicit FileMap(const std::string& path);  // throws Error naming the path; empty files too
  ~FileMap();
  FileMap(const FileMap&) = delete;
  FileMap& operator=(const FileMap&) = delete;

  std::string_view bytes() const { return {static_cast<const char*>(data_), size_}; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  void* data_ = nullptr;
  size_t size_ = 0;
};

}  // namespace waylight
