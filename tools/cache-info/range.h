#pragma once

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>

namespace waylight {

// Least, mean and largest of some numbers.
class Range {
 public:
  void add(double value) {
    least_ = count_ == 0 ? value : std::min(least_, value);
    largest_ = count_ == 0 ? value : std::max(largest_, value);
    sum_ += value;
    ++count_;
  }
  nlohmann::ordered_json json() const {
    return {{"least", least_},
            {"mean", count_ > 0 ? sum_ / static_cast<double>(count_) : 0},
            {"largest", largest_}};
  }

 private:
  uint64_t count_ = 0;
  double sum_ = 0, least_ = 0, largest_ = 0;
};

}  // namespace waylight
