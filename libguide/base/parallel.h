#pragma once
// Parallel loops over oneTBB. Results never depend on the number of threads: each index writes to
// its own place, and reductions are made afterwards in index order.

#include <cstddef>
#include <functional>

namespace waylight {

// Limits all parallel loops while alive; 0 means all cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

// Threads that parallel loops may use now.
int thread_count();

// Calls body(i) for each i in [0, count), with denormals flushed to zero in the worker.
void parallel_for(size_t count, const std::function<void(size_t)>& body);

}  // namespace waylight
