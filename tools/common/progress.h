#pragma once
// Progress on stderr: one refreshed line on a terminal, a plain line every ten seconds elsewhere.

#include <chrono>
#include <string>

namespace waylight {

class ProgressPrinter {
 public:
  explicit ProgressPrinter(std::string tool);
  ~ProgressPrinter() { clear(); }
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;

  // A new unit starts a new clock, and so does what goes back: stages of a run have their own
  // rates.
  void update(double done, double total, const char* unit);
  void warn(const std::string& message);
  // Removes the refreshed line, so that other output can follow.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::string line(double done, double total, double rate) const;

  std::string tool_, unit_;
  bool terminal_, shown_ = false;
  Clock::time_point started_, printed_;
  double done_ = 0, done_at_start_ = 0;
};

}  // namespace waylight
