// Reads the includes of libguide and fails when one runs upwards.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>

namespace {

namespace fs = std::filesystem;

// Rank of each folder of libguide; a file may include its own rank and those below. Folders of
// equal rank do not know each other.
const std::map<std::string, int> kRanks = {
    {"base", 0},    {"math", 0},    {"directional", 3}, {"spatial", 1}, {"image", 3},
    {"records", 2}, {"bsdf", 5},    {"medium", 5},      {"scene", 6},   {"cache", 6},
    {"fit", 8},     {"guiding", 8}, {"transport", 9},   {"", 10}};  // "": the stage headers

std::string folder_of(const fs::path& relative) {
  return relative.has_parent_path() ? relative.begin()->string() : "";
}

std::vector<std::string> includes_of(const fs::path& file) {
  static const std::regex pattern("^#include [<\"]([^>\"]+)[>\"]");
  std::vector<std::string> found;
  std::ifstream in(file);
  std::smatch match;
  for (std::string line; std::getline(in, line);)
    if (std::regex_search(line, match, pattern)) found.push_back(match[1]);
  return found;
}

bool allowed(const std::string& from, const std::string& to) {
  const int from_rank = kRanks.at(from), to_rank = kRanks.at(to);
  const bool foundation = from_rank == 0 && to_rank == 0;
  return from == to || to_rank < from_rank || foundation;
}

TEST(Layering, IncludesOfLibguideNeverRunUpwards) {
  const fs::path root = fs::path(WAYLIGHT_SOURCE_DIR) / "libguide";
  int files = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    ++files;
    const std::string from = folder_of(fs::relative(entry.path(), root));
    ASSERT_TRUE(kRanks.count(from)) << "new folder libguide/" << from << ": give it a rank";
    for (const std::string& include : includes_of(entry.path())) {
      if (!include.starts_with("libguide/")) continue;
      const std::string to = folder_of(include.substr(9));
      ASSERT_TRUE(kRanks.count(to)) << entry.path() << " includes " << include;
      EXPECT_TRUE(allowed(from, to)) << entry.path() << " includes " << include;
    }
  }
  EXPECT_GT(files, 50);
}

TEST(Layering, LibguideKnowsNoFileFormatAndNoTool) {
  const fs::path root = fs::path(WAYLIGHT_SOURCE_DIR) / "libguide";
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file()) continue;
    for (const std::string& include : includes_of(entry.path())) {
      EXPECT_FALSE(include.starts_with("formats/")) << entry.path();
      EXPECT_FALSE(include.starts_with("tools/")) << entry.path();
      EXPECT_EQ(include.find("flatbuffers"), std::string::npos) << entry.path();
      EXPECT_EQ(include.find("filesystem"), std::string::npos) << entry.path();
    }
  }
}

TEST(Layering, FormatsDoNotKnowTheTools) {
  for (const fs::directory_entry& entry :
       fs::recursive_directory_iterator(fs::path(WAYLIGHT_SOURCE_DIR) / "formats")) {
    if (!entry.is_regular_file()) continue;
    for (const std::string& include : includes_of(entry.path()))
      EXPECT_FALSE(include.starts_with("tools/")) << entry.path();
  }
}

}  // namespace
