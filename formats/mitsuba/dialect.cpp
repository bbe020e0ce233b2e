#include "formats/mitsuba/dialect.h"

#include <map>

namespace waylight::mitsuba {
namespace {

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
char lowered(char c) { return is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c; }

std::map<std::string, TagRule> make_rules() {
  std::map<std::string, TagRule> rules;
  for (const char* tag : {"shape", "bsdf", "emitter", "sensor", "film", "rfilter", "sampler",
                          "integrator", "texture", "medium", "phase", "volume", "subsurface"})
    rules[tag] = {TagKind::object, {}};
  rules["scene"] = {TagKind::object, {"version"}};
  for (const char* tag : {"float", "integer", "boolean", "string", "color"})
    rules[tag] = {TagKind::value, {"value"}};
  rules["rgb"] = rules["srgb"] = {TagKind::value, {"value", "intent"}};
  rules["spectrum"] = {TagKind::value, {"value", "filename", "scale", "intent"}};
  rules["blackbody"] = {TagKind::value, {"temperature", "scale"}};
  rules["point"] = rules["vector"] = {TagKind::value, {"x", "y", "z", "value"}};
  rules["transform"] = {TagKind::value, {}};
  rules["translate"] = rules["scale"] = {TagKind::step, {"x", "y", "z", "value"}};
  rules["rotate"] = {TagKind::step, {"x", "y", "z", "value", "angle"}};
  rules["lookat"] = {TagKind::step, {"origin", "target", "up"}};
  rules["matrix"] = {TagKind::step, {"value"}};
  rules["ref"] = {TagKind::reference, {}};
  rules["default"] = rules["path"] = {TagKind::directive, {"value"}};
  rules["include"] = {TagKind::directive, {"filename"}};
  rules["alias"] = {TagKind::directive, {"as"}};
  rules["mode"] = rules["hide"] = {TagKind::ignored, {}};
  return rules;
}

const std::map<std::string, TagRule>& rules() {
  static const std::map<std::string, TagRule> all = make_rules();
  return all;
}

}  // namespace

const TagRule& tag_rule(const std::string& tag) {
  static const TagRule unknown;
  const auto found = rules().find(tag);
  return found == rules().end() ? unknown : found->second;
}

std::vector<std::string> known_tags() {
  std::vector<std::string> tags;
  for (const auto& [tag, rule] : rules())
    if (rule.kind != TagKind::ignored) tags.push_back(tag);
  return tags;
}

std::string modern_tag(const std::string& tag) {
  if (tag == "lookAt" || tag == "look_at") return "lookat";
  if (tag == "luminaire") return "emitter";
  if (tag == "camera") return "sensor";
  return tag;
}

std::string snake_case(const std::string& camel_case) {
  std::string snake;
  for (size_t i = 0; i < camel_case.size(); ++i) {
    const char c = camel_case[i];
    const bool after_lower = i > 0 && is_upper(c) && !is_upper(camel_case[i - 1]);
    const bool ends_acronym = i > 0 && is_upper(c) && is_upper(camel_case[i - 1]) &&
                              i + 1 < camel_case.size() && is_lower(camel_case[i + 1]);
    if ((after_lower || ends_acronym) && snake.back() != '_') snake += '_';
    snake += lowered(c);
  }
  return snake;
}

}  // namespace waylight::mitsuba
