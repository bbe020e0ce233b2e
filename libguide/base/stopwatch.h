#pragma once

#include <chrono>
#include <ctime>

namespace waylight {

// Processor seconds of this thread: other work on the machine does not count.
inline double thread_seconds() {
  timespec now;
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

// Seconds of work: those in which checkpoints are written do not count.
class Stopwatch {
 public:
  // processors: 0 counts seconds as they pass; n > 0 counts processor seconds of this process over
  // n, which other processes of a busy machine do not lengthen.
  explicit Stopwatch(int processors = 0) : processors_(processors) {}

  double seconds() const { return processors_ > 0 ? cpu_seconds() / processors_ : now() - start_; }
  double cpu_seconds() const { return cpu_now() - cpu_start_; }
  template <typename Work>
  void paused(const Work& work) {
    const double begin = now(), cpu_begin = cpu_now();
    work();
    start_ += now() - begin;
    cpu_start_ += cpu_now() - cpu_begin;
  }

 private:
  static double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
  static double cpu_now() { return double(std::clock()) / CLOCKS_PER_SEC; }

  int processors_;
  double start_ = now(), cpu_start_ = cpu_now();
};

}  // namespace waylight
