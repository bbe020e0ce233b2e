#include "formats/mitsuba/parse_value.h"

#include <charconv>

namespace waylight::mitsuba {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

template <typename T>
bool parse_all(std::string_view text, T& value) {
  text = trimmed(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

double parse_number(const Element& element, std::string_view text) {
  double value = 0;
  if (!parse_all(text, value)) fail_at(element, "\"{:.40}\" is no number", text);
  if (!std::isfinite(static_cast<float>(value)))
    fail_at(element, "{:.40} is not finite or too large", text);
  return value;
}

std::vector<double> parse_numbers(const Element& element, std::string_view text) {
  std::vector<double> numbers;
  const std::string_view separators = ", \t\r\n";
  for (size_t begin = text.find_first_not_of(separators); begin < text.size();) {
    const size_t end = std::min(text.find_first_of(separators, begin), text.size());
    numbers.push_back(parse_number(element, text.substr(begin, end - begin)));
    begin = text.find_first_not_of(separators, end);
  }
  if (numbers.empty()) fail_at(element, "has no number");
  return numbers;
}

int parse_integer(const Element& element, std::string_view text) {
  int value = 0;
  if (!parse_all(text, value)) fail_at(element, "\"{:.40}\" is no integer", text);
  return value;
}

bool parse_boolean(const Element& element, std::string_view text) {
  if (trimmed(text) == "true") return true;
  if (trimmed(text) == "false") return false;
  fail_at(element, "\"{:.40}\" is neither \"true\" nor \"false\"", text);
}

const std::string& required_attribute(const Element& element, const std::string& key) {
  const std::string* value = element.attribute(key);
  if (!value) fail_at(element, "needs \"{}\"", key);
  return *value;
}

Eigen::Vector3d parse_vector(const Element& element, const Eigen::Vector3d& otherwise) {
  Eigen::Vector3d result = otherwise;
  if (const std::string* value = element.attribute("value")) {
    const std::vector<double> numbers = parse_numbers(element, *value);
    if (numbers.size() != 1 && numbers.size() != 3)
      fail_at(element, "has {} numbers, 1 or 3 are needed", numbers.size());
    for (int i = 0; i < 3; ++i) result[i] = numbers.size() == 1 ? numbers[0] : numbers[i];
  }
  const char* const axes[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i)
    if (const std::string* text = element.attribute(axes[i]))
      result[i] = parse_number(element, *text);
  return result;
}

}  // namespace waylight::mitsuba
