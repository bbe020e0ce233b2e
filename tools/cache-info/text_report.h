#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace waylight {

// Lines for people: a name and its value each, objects on one line, arrays of objects as tables.
std::vector<std::string> text_report(const nlohmann::ordered_json& info);

}  // namespace waylight
