// Rows that the disk has no room for.

#include "tools/common/csv.h"

#include <sys/resource.h>

#include <csignal>

#include "formats/temporary_files.h"

namespace waylight {
namespace {

using testing::error_of;
using testing::mentions;
using CsvTest = testing::TemporaryFiles;

// Files cannot grow beyond a size while it lives, as on a disk that is full then.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(size_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const struct rlimit limit = {bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }

 private:
  struct rlimit old_ = {};
  void (*old_handler_)(int);
};

TEST_F(CsvTest, RowThatDoesNotFitLeavesTheTableAsItWas) {
  const CsvRow row = {{"scene", "box"}, {"method", "product"}, {"relmse", "0.5"}};
  append_csv(path("t.csv"), row);
  const std::string before = read_whole_file(path("t.csv"));
  std::string error;
  {
    const FileSizeLimit limit(before.size() + 7);
    error = error_of([&] { append_csv(path("t.csv"), row); });
  }
  EXPECT_TRUE(mentions(error, "cannot write: File too large")) << error;
  EXPECT_EQ(read_whole_file(path("t.csv")), before);
  append_csv(path("t.csv"), row);
  EXPECT_EQ(read_csv(path("t.csv")).rows.size(), 2u);
}

}  // namespace
}  // namespace waylight
