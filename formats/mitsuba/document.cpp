// Parsing of scene files into a Document.

#include <algorithm>
#include <filesystem>
#include <pugixml.hpp>
#include <set>

#include "formats/file_bytes.h"
#include "formats/mitsuba/dialect.h"
#include "formats/mitsuba/element.h"
#include "formats/mitsuba/references.h"

namespace waylight::mitsuba {
namespace {

namespace fs = std::filesystem;

// No scene made for rendering comes near these; a hostile one would need memory without end.
constexpr size_t kMaxBytes = 32 << 20;  // of all files together, and of all values of $names
constexpr size_t kMaxElements = 1 << 20, kMaxIncludes = 4096;
constexpr int kMaxDepth = 64, kMaxIncludeDepth = 32;

// One XML file while it is read.
struct SourceFile {
  std::string path;
  std::vector<size_t> line_starts;
  pugi::xml_document xml;
  bool old_dialect = false;

  int line(ptrdiff_t offset) const {
    const auto next = std::upper_bound(line_starts.begin(), line_starts.end(),
                                       static_cast<size_t>(std::max<ptrdiff_t>(offset, 0)));
    return static_cast<int>(next - line_starts.begin());
  }
};

// Takes the size of the file from the bytes that may still be read.
void load(SourceFile& file, size_t& budget) {
  std::error_code error;
  const uintmax_t size = fs::file_size(file.path, error);
  if (!error && size > budget)
    fail("\"{}\": a scene of more than {} MiB of XML; move its data into mesh files", file.path,
         kMaxBytes >> 20);
  const std::string text = read_whole_file(file.path);
  budget -= std::min(text.size(), budget);
  file.line_starts = {0};
  for (size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') file.line_starts.push_back(i + 1);
  const pugi::xml_parse_result result =
      file.xml.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!result)
    fail("\"{}\":{}: not well-formed XML: {}", file.path, file.line(result.offset),
         result.description());
  if (!file.xml.document_element()) fail("\"{}\": there is no element in it", file.path);
}

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

bool may_have_children(const Element& element) {
  const bool plugin = element.tag == "spectrum" && !element.type.empty();
  return plugin || element.tag == "transform" || tag_rule(element.tag).kind == TagKind::object;
}

class DocumentParser {
 public:
  DocumentParser(const std::string& path, const ImportOptions& options)
      : options_(options), parameters_(options.defines) {
    document_.path = path;
    document_.on_file = options.on_file;
  }

  Document parse() {
    SourceFile file;
    file.path = document_.path;
    load(file, bytes_left_);
    const pugi::xml_node root = file.xml.document_element();
    document_.root = read_attributes(file, root);
    if (document_.root.tag != "scene")
      fail_at(document_.root, "a Mitsuba scene begins with <scene version=\"...\">");
    file.old_dialect = document_.old_dialect = is_old(document_.root);
    open_files_ = {file.path};
    read_children(file, root, document_.root, 1);
    for (const auto& [name, value] : options_.defines)
      if (!used_parameters_.count(name)) document_.unused_defines.push_back(name);
    return std::move(document_);
  }

  const std::vector<Element>& aliases() const { return aliases_; }

 private:
  void warn(const std::string& message) const {
    if (options_.on_warning) options_.on_warning(message);
  }

  bool is_old(const Element& scene) const {
    const std::string* version = scene.attribute("version");
    if (!version) fail_at(scene, "needs a version: \"0.6.0\" or \"3.0.0\"");
    int major = -1, minor = 0;
    if (std::sscanf(version->c_str(), "%9d.%9d", &major, &minor) < 1 || major < 0)
      fail_at(scene, "\"{}\" is no version; write for example \"3.0.0\"", *version);
    if (major == 0 && minor < 4)
      fail_at(scene, "version {} is too old; update the scene to 0.4 or later", *version);
    if (major > 3)
      warn(fmt::format("{}: version {} is newer than what is known, 3", scene.where(), *version));
    return major < 2;
  }

  // `text` with every $name replaced: by the whole name where that is defined, else by the longest
  // defined one that it begins with.
  std::string substitute(const Element& element, std::string_view text) {
    std::string result;
    for (size_t i = 0; i < text.size();) {
      if (text[i] != '$') {
        result += text[i++];
        continue;
      }
      size_t end = i + 1;
      while (end < text.size() && is_name_character(text[end])) ++end;
      const std::string name = parameter(element, std::string(text.substr(i + 1, end - i - 1)));
      const std::string& value = parameters_.at(name);
      take_from_budget(element, name, value.size());
      result += value;
      i += 1 + name.size();
    }
    return result;
  }

  // Defaults may hold names: without a limit a dozen lines would make any number of bytes.
  void take_from_budget(const Element& element, const std::string& name, size_t bytes) {
    if (bytes > value_bytes_left_)
      fail_at(element,
              "${}: the values of names make more than {} MiB of this scene; give the <default>s "
              "shorter values",
              name, kMaxBytes >> 20);
    value_bytes_left_ -= bytes;
  }

  std::string parameter(const Element& element, const std::string& wanted) {
    for (std::string name = wanted; !name.empty(); name.pop_back())
      if (parameters_.count(name)) {
        used_parameters_.insert(name);
        return name;
      }
    std::vector<std::string> known;
    for (const auto& [name, value] : parameters_) known.push_back(name);
    fail_at(element, "${} is not defined; give it a <default> or -D {}=VALUE{}", wanted, wanted,
            did_you_mean(wanted, known));
  }

  Element read_attributes(const SourceFile& file, const pugi::xml_node& node) {
    if (++elements_ > kMaxElements)
      fail("\"{}\": the scene has more than {} elements", document_.path, kMaxElements);
    Element element;
    element.tag = modern_tag(node.name());
    element.file = file.path;
    element.line = file.line(node.offset_debug());
    const TagRule& rule = tag_rule(element.tag);
    if (rule.kind == TagKind::unknown)
      fail_at(element, "unknown element{}", did_you_mean(element.tag, known_tags()));
    if (rule.kind == TagKind::ignored) return element;
    for (const pugi::xml_attribute& attribute : node.attributes())
      store(element, rule, attribute.name(), substitute(element, attribute.value()));
    check(element, rule);
    if (file.old_dialect && rule.kind != TagKind::directive)
      element.name = snake_case(element.name);
    return element;
  }

  static void store(Element& element, const TagRule& rule, const std::string& key,
                    std::string value) {
    if (key == "name")
      element.name = std::move(value);
    else if (key == "type")
      element.type = std::move(value);
    else if (key == "id")
      element.id = std::move(value);
    else if (std::find(rule.attributes.begin(), rule.attributes.end(), key) ==
             rule.attributes.end())
      fail_at(element, "unknown attribute \"{}\"{}", key, did_you_mean(key, rule.attributes));
    else if (!element.attributes.emplace(key, std::move(value)).second)
      fail_at(element, "has the attribute \"{}\" twice", key);
  }

  static void check(const Element& element, const TagRule& rule) {
    if (rule.kind == TagKind::object && element.tag != "scene" && element.type.empty())
      fail_at(element, "needs a type");
    if (rule.kind == TagKind::value && element.name.empty()) fail_at(element, "needs a name");
    if (rule.kind == TagKind::reference && element.id.empty()) fail_at(element, "needs an id");
  }

  void read_children(SourceFile& file, const pugi::xml_node& node, Element& parent, int depth) {
    if (depth > kMaxDepth) fail_at(parent, "elements are nested deeper than {}", kMaxDepth);
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
        fail_at(parent, "text between elements: \"{:.40}\"", child.value());
      if (child.type() == pugi::node_element) read_child(file, child, parent, depth);
    }
  }

  void read_child(SourceFile& file, const pugi::xml_node& node, Element& parent, int depth) {
    Element element = read_attributes(file, node);
    const TagKind kind = tag_rule(element.tag).kind;
    if (kind == TagKind::ignored)
      return warn(fmt::format("{}: not an element of Mitsuba, ignored", element.where()));
    if (kind == TagKind::directive) return obey(file, element, parent, depth);
    if (element.tag == "scene") fail_at(element, "a <scene> within another element");
    if (!may_have_children(parent) || (kind == TagKind::step) != (parent.tag == "transform"))
      fail_at(element, "cannot stand in {}", parent.where());
    read_children(file, node, element, depth + 1);
    parent.children.push_back(std::move(element));
  }

  void obey(const SourceFile& file, const Element& directive, Element& parent, int depth) {
    if (directive.tag == "include") return include(file, directive, parent, depth);
    if (directive.tag == "alias") return aliases_.push_back(directive);
    const std::string* value = directive.attribute("value");
    if (!value) fail_at(directive, "needs a value");
    if (directive.tag == "path") return add_folder(directive, *value);
    if (directive.name.empty()) fail_at(directive, "needs a name");
    parameters_.emplace(directive.name, *value);  // keeps what -D or an earlier default says
  }

  void add_folder(const Element& directive, const std::string& folder) {
    std::error_code error;
    for (const std::string& file : {directive.file, document_.path}) {
      const fs::path candidate = fs::path(file).parent_path() / folder;
      if (fs::is_directory(candidate, error))
        return document_.search_folders.push_back(candidate.string());
    }
    fail_at(directive, "there is no folder \"{}\"", folder);
  }

  void include(const SourceFile& by, const Element& directive, Element& parent, int depth) {
    const std::string* name = directive.attribute("filename");
    if (!name) fail_at(directive, "needs a filename");
    SourceFile file;
    file.path = document_.find_file(directive, *name);
    file.old_dialect = by.old_dialect;
    std::error_code error;
    for (const std::string& open : open_files_)
      if (fs::equivalent(open, file.path, error))
        fail_at(directive, "\"{}\" includes itself", file.path);
    if (open_files_.size() >= kMaxIncludeDepth)
      fail_at(directive, "includes are nested deeper than {}", kMaxIncludeDepth);
    if (++includes_ > kMaxIncludes)
      fail_at(directive, "there are more than {} includes", kMaxIncludes);
    load(file, bytes_left_);
    open_files_.push_back(file.path);
    splice(file, parent, depth);
    open_files_.pop_back();
  }

  // The children of a <scene>, or the one other element that the file holds.
  void splice(SourceFile& file, Element& parent, int depth) {
    const pugi::xml_node root = file.xml.document_element();
    if (std::string(root.name()) != "scene") return read_child(file, root, parent, depth);
    const Element scene = read_attributes(file, root);
    file.old_dialect = is_old(scene);
    read_children(file, root, parent, depth);
  }

  const ImportOptions& options_;
  std::map<std::string, std::string> parameters_;
  std::set<std::string> used_parameters_;
  std::vector<std::string> open_files_;
  std::vector<Element> aliases_;
  size_t elements_ = 0, includes_ = 0, bytes_left_ = kMaxBytes;
  size_t value_bytes_left_ = kMaxBytes;
  Document document_;
};

}  // namespace

Document parse_document(const std::string& path, const ImportOptions& options) {
  DocumentParser parser(path, options);
  Document document = parser.parse();
  collect_ids(document, parser.aliases());
  check_references(document);
  return document;
}

}  // namespace waylight::mitsuba
