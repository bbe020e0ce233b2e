#include "formats/byte_stream.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "libguide/base/error.h"

namespace waylight {
namespace {

// A pipe of 64 KiB, the default, makes both ends take turns many times per chunk. What the system
// refuses does no harm.
constexpr int kPipeBytes = 1 << 20;

void enlarge_pipe(int descriptor) { ::fcntl(descriptor, F_SETPIPE_SZ, kPipeBytes); }

int open_output(const std::optional<AtomicFile>& file) {
  if (!file) return STDOUT_FILENO;
  const int descriptor =
      ::open(file->temporary().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) fail("\"{}\": cannot write: {}", file->temporary(), std::strerror(errno));
  return descriptor;
}

int open_input(const std::string& path) {
  if (path == "-") return STDIN_FILENO;
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail("\"{}\": cannot open: {}", path, std::strerror(errno));
  return descriptor;
}

// While it lives, a write to a pipe without reader returns EPIPE and kills nobody. The mask is the
// thread's own; a signal handler would be everyone's.
class NoBrokenPipeSignal {
 public:
  NoBrokenPipeSignal() {
    ::sigemptyset(&broken_pipe_);
    ::sigaddset(&broken_pipe_, SIGPIPE);
    ::pthread_sigmask(SIG_BLOCK, &broken_pipe_, &before_);
  }
  ~NoBrokenPipeSignal() {
    const int error = errno;
    if (::sigismember(&before_, SIGPIPE) == 0) {
      const timespec now = {};
      while (::sigtimedwait(&broken_pipe_, nullptr, &now) < 0 && errno == EINTR) {
      }
      ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    errno = error;
  }

 private:
  sigset_t broken_pipe_, before_;
};

ssize_t write_some(int descriptor, std::string_view bytes) {
  const NoBrokenPipeSignal guard;
  ssize_t count;
  do count = ::write(descriptor, bytes.data(), bytes.size());
  while (count < 0 && errno == EINTR);
  return count;
}

}  // namespace

bool Descriptor::close() {
  const bool owned = value_ > STDERR_FILENO;
  const int descriptor = value_;
  if (owned) value_ = -1;
  return !owned || ::close(descriptor) == 0;
}

ByteSink::ByteSink(const std::string& path)
    : name_(path == "-" ? "standard output" : path),
      file_(path == "-" ? std::nullopt : std::make_optional<AtomicFile>(path)),
      descriptor_(open_output(file_)) {
  enlarge_pipe(descriptor_.value());
}

void ByteSink::write(std::string_view bytes) {
  hash_.add(bytes);
  while (!bytes.empty()) {
    const ssize_t count = write_some(descriptor_.value(), bytes);
    if (count < 0 && errno == EPIPE) fail("\"{}\": whoever read it has stopped reading", name_);
    if (count < 0) fail("\"{}\": cannot write: {}", name_, std::strerror(errno));
    if (count == 0) fail("\"{}\": cannot write any more", name_);
    bytes.remove_prefix(static_cast<size_t>(count));
  }
}

void ByteSink::commit() {
  if (!descriptor_.close()) fail("\"{}\": cannot write: {}", name_, std::strerror(errno));
  if (file_) file_->commit();
}

ByteSource::ByteSource(const std::string& path)
    : name_(path == "-" ? "standard input" : path), descriptor_(open_input(path)) {
  struct stat status = {};
  const bool known = ::fstat(descriptor_.value(), &status) == 0;
  if (known && S_ISDIR(status.st_mode)) fail("\"{}\": is a folder, not a file", name_);
  if (known && S_ISREG(status.st_mode)) size_ = static_cast<uint64_t>(status.st_size);
  enlarge_pipe(descriptor_.value());
}

size_t ByteSource::read(std::span<char> buffer) {
  size_t done = 0;
  while (done < buffer.size()) {
    const ssize_t count = ::read(descriptor_.value(), buffer.data() + done, buffer.size() - done);
    // A handler ran: someone asks to stop, and a pipe may stay silent for ever.
    if (count < 0 && errno == EINTR) fail("\"{}\": reading was interrupted", name_);
    if (count < 0) fail("\"{}\": cannot read: {}", name_, std::strerror(errno));
    if (count == 0) break;
    done += static_cast<size_t>(count);
  }
  hash_.add(buffer.data(), done);
  read_ += done;
  return done;
}

}  // namespace waylight
