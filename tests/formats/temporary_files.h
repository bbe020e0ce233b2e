#pragma once
// A folder of a test's own, and files in it.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "formats/file_bytes.h"

namespace waylight::testing {

class TemporaryFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "waylight-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::string put(const std::string& name, std::string_view bytes) const {
    std::filesystem::remove(path(name));  // some file systems wait for the disk when they truncate
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

  size_t file_count() const {
    return static_cast<size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
  }

 private:
  std::filesystem::path folder_;
};

// The message of the Error that f throws, or "no error".
template <typename F>
std::string error_of(const F& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

inline bool mentions(const std::string& text, std::string_view part) {
  return text.find(part) != text.npos;
}

}  // namespace waylight::testing
