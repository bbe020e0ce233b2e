#include "formats/ply_header.h"

#include <algorithm>
#include <charconv>

#include "libguide/base/error.h"

namespace waylight {
namespace {

using Words = std::vector<std::string_view>;

Words split_words(std::string_view line) {
  Words words;
  for (size_t begin = 0; begin < line.size();) {
    const size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
    if (end > begin) words.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

PlyType type_of(std::string_view name) {
  struct Name {
    std::string_view text;
    PlyType type;
  };
  static constexpr Name kNames[] = {
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  for (const Name& candidate : kNames)
    if (candidate.text == name) return candidate.type;
  return PlyType::none;
}

class HeaderParser {
 public:
  HeaderParser(std::string_view file, const std::string& path) : file_(file), path_(path) {}

  PlyHeader parse() {
    if (next_line() != Words{"ply"}) fail("\"{}\": is not a PLY file", path_);
    bool has_format = false;
    for (Words words = next_line(); words != Words{"end_header"}; words = next_line()) {
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "format") {
        parse_format(words);
        has_format = true;
      } else if (words[0] == "element") {
        parse_element(words);
      } else if (words[0] == "property") {
        parse_property(words);
      } else {
        defect(fmt::format("unknown keyword \"{}\"", words[0]));
      }
    }
    if (!has_format) defect("no format is given");
    header_.body_offset = offset_;
    return std::move(header_);
  }

 private:
  [[noreturn]] void defect(const std::string& what) const {
    fail("\"{}\": line {} of the header: {}", path_, line_, what);
  }

  Words next_line() {
    ++line_;
    const size_t end = file_.find('\n', offset_);
    if (end == std::string_view::npos) defect("the file is truncated, or not a PLY file");
    const Words words = split_words(file_.substr(offset_, end - offset_));
    offset_ = end + 1;
    return words;
  }

  void parse_format(const Words& words) {
    const std::string_view name = words.size() > 1 ? words[1] : "";
    if (name == "ascii")
      header_.encoding = PlyEncoding::ascii;
    else if (name == "binary_little_endian")
      header_.encoding = PlyEncoding::little_endian;
    else if (name == "binary_big_endian")
      header_.encoding = PlyEncoding::big_endian;
    else
      defect(fmt::format("unknown format \"{}\"", name));
  }

  void parse_element(const Words& words) {
    if (words.size() != 3) defect("an element has a name and a count");
    PlyElement element;
    element.name = words[1];
    refuse_second(element.name);
    const char* end = words[2].data() + words[2].size();
    const auto [stop, error] = std::from_chars(words[2].data(), end, element.count);
    if (error != std::errc() || stop != end) defect(fmt::format("\"{}\" is not a count", words[2]));
    header_.elements.push_back(std::move(element));
  }

  // One mesh has one list of each; what else there is twice is skipped.
  void refuse_second(const std::string& name) const {
    if (name != "vertex" && name != "face") return;
    for (const PlyElement& earlier : header_.elements)
      if (earlier.name == name)
        defect(fmt::format("a second element \"{}\"; write one mesh to a file", name));
  }

  void parse_property(const Words& words) {
    const bool list = words.size() == 5 && words[1] == "list";
    if (!list && words.size() != 3) defect("a property has a type and a name");
    if (header_.elements.empty()) defect("a property before the first element");
    PlyProperty property{std::string(words.back()), type_of(words[words.size() - 2]),
                         list ? type_of(words[2]) : PlyType::none};
    if (property.type == PlyType::none || (list && property.count_type == PlyType::none))
      defect("unknown property type");
    header_.elements.back().properties.push_back(std::move(property));
  }

  std::string_view file_;
  const std::string& path_;
  PlyHeader header_;
  size_t offset_ = 0, line_ = 0;
};

}  // namespace

int PlyElement::find(std::initializer_list<std::string_view> names) const {
  for (size_t i = 0; i < properties.size(); ++i)
    if (std::find(names.begin(), names.end(), properties[i].name) != names.end())
      return static_cast<int>(i);
  return -1;
}

size_t ply_size(PlyType type) {
  static constexpr size_t kSizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<size_t>(type)];
}

PlyHeader parse_ply_header(std::string_view file, const std::string& path) {
  return HeaderParser(file, path).parse();
}

}  // namespace waylight
