// A cache whose tree is sound and has no cell, given to the tool that would guide by it.

#include <sys/wait.h>

#include <cstdlib>

#include "formats/mitsuba.h"
#include "formats/small_caches.h"
#include "formats/temporary_files.h"

namespace waylight {
namespace {

using namespace testing;

const std::string kScene = WAYLIGHT_SOURCE_DIR "/tests/golden/scenes/box.xml";

class EmptyCache : public TemporaryFiles {
 protected:
  void SetUp() override {
    TemporaryFiles::SetUp();
    CacheFile file{small_provenance(), {}};
    file.provenance.scene = import_mitsuba(kScene, {}).hash;
    write_cache(path("empty.cache"), file);
  }
};

TEST_F(EmptyCache, IsReadAsItWasWritten) {
  EXPECT_TRUE(read_cache(path("empty.cache")).cache.cells.empty());
  EXPECT_TRUE(MappedCache(path("empty.cache")).view().cells.empty());
}

TEST_F(EmptyCache, IsRefusedByRenderWhichWritesNothing) {
  const std::string command =
      fmt::format("{}/render {} -o {} --mode illumination --cache {} --spp 1 2> {}",
                  WAYLIGHT_BIN_DIR, kScene, path("a.exr"), path("empty.cache"), path("message"));
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_TRUE(mentions(read_whole_file(path("message")), "has no cells")) << command;
  EXPECT_EQ(file_count(), 2u);
}

}  // namespace
}  // namespace waylight
