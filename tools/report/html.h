#pragma once
// Pieces of HTML. All text that comes from files goes through escaped().

#include <string>
#include <utility>
#include <vector>

namespace waylight {

std::string escaped(const std::string& text);

// "data:image/png;base64,..." of the content of a file of that kind ("png", "jpeg").
std::string data_uri(const std::string& kind, const std::string& bytes);

// Cells are HTML. Columns behind the first are numbers, set flush right, unless `words` is true.
std::string html_table(const std::vector<std::string>& heading,
                       const std::vector<std::vector<std::string>>& rows, bool words = false);

// The template with each {{NAME}} replaced by the text of that name.
std::string filled(std::string page, const std::vector<std::pair<std::string, std::string>>& texts);

}  // namespace waylight
