#include "tools/common/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

#include "tools/common/cli.h"

namespace waylight {
namespace {

std::string format_seconds(double seconds) {
  if (seconds < 60) return fmt::format("{:.0f} s", seconds);
  const long minutes = static_cast<long>(seconds / 60 + 0.5);
  if (minutes < 60) return fmt::format("{} min", minutes);
  return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
}

}  // namespace

ProgressPrinter::ProgressPrinter(std::string tool)
    : tool_(std::move(tool)), terminal_(::isatty(STDERR_FILENO) == 1) {}

std::string ProgressPrinter::line(double done, double total, double rate) const {
  std::string text = fmt::format("{}: {} {}", tool_, format_count(done), unit_);
  if (total > 0) text += fmt::format(" ({:.0f} %)", 100 * done / total);
  if (!(rate > 0)) return text;
  text += fmt::format(", {}/s", format_count(rate));
  if (total > done) text += fmt::format(", {} left", format_seconds((total - done) / rate));
  return text;
}

void ProgressPrinter::update(double done, double total, const char* unit) {
  const Clock::time_point now = Clock::now();
  if (unit_ != unit || done < done_) {
    unit_ = unit;
    started_ = printed_ = now;
    done_at_start_ = done;
  }
  done_ = done;
  const double interval = terminal_ ? 0.2 : 10.0;
  if (std::chrono::duration<double>(now - printed_).count() < interval) return;
  printed_ = now;
  const double seconds = std::chrono::duration<double>(now - started_).count();
  const double rate = seconds > 0 ? (done - done_at_start_) / seconds : 0;
  const std::string text = line(done, total, rate);
  // "\033[K" clears what a longer line left behind.
  std::fputs((terminal_ ? "\r" + text + "\033[K" : text + "\n").c_str(), stderr);
  std::fflush(stderr);
  shown_ = terminal_;
}

void ProgressPrinter::warn(const std::string& message) {
  clear();
  std::fputs(fmt::format("{}: warning: {}\n", tool_, message).c_str(), stderr);
}

void ProgressPrinter::clear() {
  if (!shown_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace waylight
