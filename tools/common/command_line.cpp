#include "tools/common/command_line.h"

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <filesystem>

#include "libguide/base/nearest_name.h"
#include "tools/common/cli.h"

namespace waylight {
namespace {

// Words that a shell would split are quoted.
std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && word.find_first_of(" \t\n\"'$\\|&;<>*?()") == word.npos;
  return plain ? word : fmt::format("'{}'", word);
}

std::string canonical_value(const CLI::Option& option, const std::string& value) {
  if (option.get_type_name() != kInput || value == "-") return quoted(value);
  return quoted(std::filesystem::path(value).filename().string());
}

void append_option(const CLI::Option& option, std::string& text) {
  const std::string name = option.get_positional() ? "" : option.get_name();
  if (is_flag(option)) {
    text += " " + name;
    return;
  }
  if (option.results().size() > 1 && option.get_expected_max() == 1 && !name.empty()) {
    for (const std::string& value : option.results())
      text += fmt::format(" {} {}", name, canonical_value(option, value));
    return;
  }
  if (!name.empty()) text += " " + name;
  for (const std::string& value : option.results()) text += " " + canonical_value(option, value);
}

// Without dashes, of which any number may have been typed.
std::string did_you_mean(const CLI::App& app, std::string word) {
  word.erase(0, word.find_first_not_of('-'));
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    names.insert(names.end(), option->get_lnames().begin(), option->get_lnames().end());
  const std::string* nearest = nearest_name(word, names);
  return nearest ? fmt::format("; did you mean --{}?", *nearest) : "";
}

}  // namespace

std::vector<std::string> files_of(const CLI::App& app, const char* kind) {
  std::vector<std::string> files;
  for (const CLI::Option* option : app.get_options())
    if (option->get_type_name() == kind && option->count() > 0)
      for (const std::string& file : option->results())
        if (file != "-") files.push_back(file);
  return files;
}

bool uses_standard_stream(const CLI::App& app, const char* kind) {
  for (const CLI::Option* option : app.get_options())
    if (option->get_type_name() == kind && option->count() > 0)
      for (const std::string& file : option->results())
        if (file == "-") return true;
  return false;
}

bool is_flag(const CLI::Option& option) { return option.get_items_expected_max() == 0; }

std::string canonical_command_line(const CLI::App& app, const std::string& tool) {
  std::string text = tool;
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || option->get_type_name() == kOutput || name == "--threads" ||
        name == "--quiet")
      continue;
    append_option(*option, text);
  }
  return text;
}

std::string unknown_words(const CLI::App& app) {
  const std::string word = app.remaining().front();
  if (word.size() < 2 || word[0] != '-')
    return fmt::format("\"{}\": there is no place for another file", word);
  const std::string name = word.substr(0, word.find('='));
  return fmt::format("there is no option {}{}", name, did_you_mean(app, name));
}

CLI::Option* as_input(CLI::Option* option) { return option->type_name(kInput); }

CLI::Option* as_output(CLI::Option* option, const std::vector<std::string>& endings) {
  option->type_name(kOutput);
  if (endings.empty()) return option;
  return option->check([endings](const std::string& file) {
    for (const std::string& ending : endings)
      if (file.ends_with(ending)) return std::string();
    return fmt::format("\"{}\" does not end in {}", file, fmt::join(endings, " or "));
  });
}

CLI::Option* add_seed(CLI::App& app, uint64_t& seed, const std::string& description) {
  return app.add_option("--seed", seed, description)->check([](const std::string& text) {
    uint64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error == std::errc() && stop == end) return std::string();
    return fmt::format("\"{}\" is no whole number from 0 to 2^64 - 1", text);
  });
}

CLI::Option* add_choice(CLI::App& app, const std::string& name,
                        const std::vector<std::string>& choices,
                        const std::function<void(size_t)>& choose, const std::string& description) {
  const auto take = [name, choices, choose](const std::string& text) {
    const auto found = std::find(choices.begin(), choices.end(), text);
    if (found == choices.end())
      throw CLI::ValidationError(
          name, fmt::format("\"{}\" is none of {}", text, fmt::join(choices, ", ")));
    choose(found - choices.begin());
  };
  return app.add_option_function<std::string>(name, take, description)
      ->type_name(fmt::format("{}", fmt::join(choices, "|")))
      ->default_str(choices.front());
}

}  // namespace waylight
