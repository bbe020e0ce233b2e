#pragma once
// How a stage reports progress and warnings, and how it learns that it should stop.

#include <atomic>
#include <functional>
#include <string>

namespace waylight {

// Passed to every stage. Default-constructed it is silent and never stops.
struct RunControl {
  // Called from one thread at a time with work done and work in all, in `unit`s.
  std::function<void(double done, double total, const char* unit)> on_progress;
  std::function<void(const std::string& message)> on_warning;
  const std::atomic<bool>* stop = nullptr;

  bool stopped() const { return stop && stop->load(std::memory_order_relaxed); }
  void progress(double done, double total, const char* unit) const {
    if (on_progress) on_progress(done, total, unit);
  }
  void warn(const std::string& message) const {
    if (on_warning) on_warning(message);
  }
};

}  // namespace waylight
