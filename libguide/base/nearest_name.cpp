#include "libguide/base/nearest_name.h"

#include <algorithm>

namespace waylight {
namespace {

// Insertions, deletions, replacements and swaps of neighbours [Damerau 1964, restricted].
size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<size_t> before, last(b.size() + 1), row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

}  // namespace

const std::string* nearest_name(const std::string& unknown, const std::vector<std::string>& known) {
  constexpr size_t kLongest = 128;  // names beyond are no slips, and the distance is quadratic
  if (unknown.size() > kLongest) return nullptr;
  const std::string* nearest = nullptr;
  size_t least = std::max<size_t>(2, unknown.size() / 3) + 1;
  for (const std::string& candidate : known) {
    if (candidate.size() > kLongest) continue;
    const size_t distance = edit_distance(unknown, candidate);
    if (distance < least && distance < candidate.size()) least = distance, nearest = &candidate;
  }
  return nearest;
}

}  // namespace waylight
