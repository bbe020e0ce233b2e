#pragma once

#include <chrono>
#include <ctime>

namespace waylight {

// Seconds of work: those in which checkpoints are written do not count.
class Stopwatch {
 public:
  double seconds() const { return now() - start_; }
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

  double start_ = now(), cpu_start_ = cpu_now();
};

}  // namespace waylight
