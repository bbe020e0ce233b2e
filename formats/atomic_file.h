#pragma once
// Outputs appear complete or not at all.

#include <functional>
#include <string>

namespace waylight {

// Calls write(temporary path), then flushes it to disk and renames it to `path`. Removes the
// temporary file and rethrows when write throws. Throws Error naming the path when the folder is
// missing or not writable. Something that is not a regular file, such as /dev/null, is written to
// in place.
void write_atomically(const std::string& path,
                      const std::function<void(const std::string& temporary)>& write);

// The same for who writes piece by piece: the file at temporary() takes its name with commit(), and
// is removed when that never comes.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::string& temporary() const { return temporary_; }
  void commit();

 private:
  std::string path_, temporary_;
  bool done_ = false;
};

void write_text_atomically(const std::string& path, const std::string& text);

// Throws Error when write_atomically would fail for want of a folder or of permission.
void check_writable(const std::string& path);

}  // namespace waylight
