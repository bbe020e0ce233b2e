#pragma once
// For messages about names that nobody knows.

#include <string>
#include <vector>

namespace waylight {

// The known name with the smallest edit distance; nullptr when nothing is near.
const std::string* nearest_name(const std::string& unknown, const std::vector<std::string>& known);

}  // namespace waylight
