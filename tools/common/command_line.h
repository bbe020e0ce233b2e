#pragma once
// What the options of a command line are: inputs, outputs, and the words that provenance keeps.

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace waylight {

// How as_input() and as_output() mark an option.
inline constexpr const char* kInput = "INPUT";
inline constexpr const char* kOutput = "OUTPUT";

// Files given to options so marked, without "-".
std::vector<std::string> files_of(const CLI::App& app, const char* kind);

// Whether an option so marked was given "-".
bool uses_standard_stream(const CLI::App& app, const char* kind);

bool is_flag(const CLI::Option& option);

// See ToolRun::command_line().
std::string canonical_command_line(const CLI::App& app, const std::string& tool);

// The sentence for words that no option takes, naming the option that is spelt most like it.
std::string unknown_words(const CLI::App& app);

}  // namespace waylight
