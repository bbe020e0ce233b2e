#include "tools/report/html.h"

#include <cstdint>

namespace waylight {
namespace {

std::string base64(const std::string& bytes) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](size_t j) -> uint32_t {
      return j < bytes.size() ? static_cast<unsigned char>(bytes[j]) : 0;
    };
    const uint32_t group = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (size_t digit = 0; digit < 4; ++digit)
      text += digit <= bytes.size() - i ? kDigits[group >> (18 - 6 * digit) & 63] : '=';
  }
  return text;
}

std::string table_row(const std::vector<std::string>& cells, const char* tag) {
  std::string row = "<tr>";
  for (const std::string& cell : cells)
    row.append("<").append(tag).append(">").append(cell).append("</").append(tag).append(">");
  return row + "</tr>\n";
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

std::string data_uri(const std::string& kind, const std::string& bytes) {
  return "data:image/" + kind + ";base64," + base64(bytes);
}

std::string html_table(const std::vector<std::string>& heading,
                       const std::vector<std::vector<std::string>>& rows, bool words) {
  std::string table = words ? "<div class=scroll><table class=words>\n<thead>"
                            : "<div class=scroll><table>\n<thead>";
  table += table_row(heading, "th") + "</thead>\n<tbody>\n";
  for (const std::vector<std::string>& row : rows) table += table_row(row, "td");
  return table + "</tbody></table></div>\n";
}

std::string filled(std::string page,
                   const std::vector<std::pair<std::string, std::string>>& texts) {
  std::string result;
  size_t begin = 0;
  for (size_t open; (open = page.find("{{", begin)) != std::string::npos;) {
    const size_t close = page.find("}}", open);
    const std::string name = page.substr(open + 2, close - open - 2);
    result.append(page, begin, open - begin);
    for (const auto& [key, text] : texts)
      if (key == name) result += text;
    begin = close + 2;
  }
  return result.append(page, begin, std::string::npos);
}

}  // namespace waylight
