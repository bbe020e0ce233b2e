// Photon streams through pipes, as between two tools.

#include <fcntl.h>
#include <unistd.h>

#include <thread>

#include "formats/small_caches.h"
#include "formats/temporary_files.h"

namespace waylight {
namespace {

using namespace testing;

// Puts another descriptor in the place of a standard stream while it lives.
class Redirection {
 public:
  Redirection(int standard, int descriptor) : standard_(standard), saved_(::dup(standard)) {
    ::dup2(descriptor, standard);
    ::close(descriptor);
  }
  ~Redirection() { end(); }
  void end() {
    if (saved_ < 0) return;
    ::dup2(saved_, standard_);
    ::close(saved_);
    saved_ = -1;
  }

 private:
  int standard_, saved_;
};

class Pipe : public TemporaryFiles {
 protected:
  void SetUp() override {
    TemporaryFiles::SetUp();
    ASSERT_EQ(::pipe2(ends_, O_CLOEXEC), 0);
  }
  int ends_[2] = {};
};

TEST_F(Pipe, CarriesEveryPhotonFromStdoutToStdin) {
  const std::vector<Photon> out = random_photons(100'000);
  std::fflush(stdout);
  Redirection input(STDIN_FILENO, ends_[0]), output(STDOUT_FILENO, ends_[1]);
  std::thread writer([&] {
    write_photons("-", out);
    output.end();  // closes the pipe
  });
  std::vector<Photon> in;
  const std::string error = error_of([&] { in = read_photons("-"); });
  writer.join();
  input.end();
  EXPECT_EQ(error, "no error");
  ASSERT_EQ(in.size(), out.size());
  for (size_t i = 0; i < in.size(); ++i) ASSERT_EQ(in[i].position, out[i].position);
}

TEST_F(Pipe, WriterWhoseReaderLeftGetsAnError) {
  std::fflush(stdout);
  ::close(ends_[0]);
  Redirection output(STDOUT_FILENO, ends_[1]);
  const std::string error = error_of([&] { write_photons("-", random_photons(10)); });
  output.end();
  EXPECT_TRUE(mentions(error, "\"standard output\": whoever read it has stopped reading")) << error;
}

TEST_F(Pipe, ReaderWhoseWriterDiedSaysTruncated) {
  write_photons(path("a.photons"), random_photons(20'000));
  const std::string bytes = read_whole_file(path("a.photons"));
  Redirection input(STDIN_FILENO, ends_[0]);
  std::thread writer([&] {
    for (size_t done = 0; done < 500'000;)
      done += static_cast<size_t>(::write(ends_[1], bytes.data() + done, 500'000 - done));
    ::close(ends_[1]);
  });
  const std::string error = error_of([&] { read_photons("-"); });
  writer.join();
  input.end();
  EXPECT_TRUE(mentions(error, "\"standard input\": is truncated")) << error;
}

TEST_F(Pipe, FullDiskIsAnError) {
  if (::access("/dev/full", W_OK) != 0) GTEST_SKIP() << "this system has no /dev/full";
  const std::string error = error_of([&] { write_photons("/dev/full", random_photons(10)); });
  EXPECT_TRUE(mentions(error, "cannot write: No space left")) << error;
}

}  // namespace
}  // namespace waylight
