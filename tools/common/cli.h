#pragma once
// What all tools share: option parsing, help, exit codes, threads, progress, interruption.
// A tool's main declares its options, calls its stage once, and reports.

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "libguide/base/run_control.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace waylight {

// 0 success; the others are also what `Error`, `Misuse` and `Interrupted` become.
enum ExitCode { kSuccess = 0, kFailure = 1, kMisuse = 2, kInterrupted = 130 };

struct ToolInfo {
  const char* name;      // of the executable
  const char* summary;   // one line
  const char* usage;     // what follows the name in the usage line
  const char* teaching;  // end of --help: what to know, and examples
};

// Thrown by ToolRun::stop_if_interrupted().
struct Interrupted {};

// One run of a tool, handed to its body.
class ToolRun {
 public:
  RunControl control;

  // Canonical command line for provenance: what can change the result, in a fixed order and
  // spelling; inputs by their file names without folders, no outputs, no thread count.
  const std::string& command_line() const { return command_line_; }
  // One line of the human-readable summary: to stdout (stderr while the result goes there);
  // nothing with --quiet.
  void print(const std::string& line) const;
  // Writes the file of --stats, if asked for; with a tag, its file tagged(..., tag).
  void write_stats(const nlohmann::ordered_json& stats, const std::string& tag = {}) const;
  // Throws Misuse where an output, or another file that is written, would overwrite a file that is
  // read without being an option's input.
  void check_referred(const std::string& file, const std::vector<std::string>& written = {}) const;
  // For stages whose partial result is of no use.
  void stop_if_interrupted() const;

 private:
  friend class ToolRunner;
  std::string command_line_, stats_path_;
  std::vector<std::string> outputs_;
  bool quiet_ = false, stdout_taken_ = false;
};

// Parses, runs the body, prints the one error message, returns the exit code. Before the body
// runs: inputs exist, outputs have a folder and are none of the inputs.
int run_tool(int argc, char** argv, const ToolInfo& info,
             const std::function<void(CLI::App&)>& declare,
             const std::function<void(ToolRun&)>& body);

// Marks an option (or positional) as naming input or output files; "-" is stdin or stdout.
CLI::Option* as_input(CLI::Option* option);
// An output's name must end in one of `endings`, if there are any.
CLI::Option* as_output(CLI::Option* option, const std::vector<std::string>& endings = {});

// --seed. A negative one is refused, where CLI11 would take a large one for it.
CLI::Option* add_seed(CLI::App& app, uint64_t& seed,
                      const std::string& description = "Seed of the random numbers");

// An option that takes one of some words; `choose` is given its place. The first is the default.
CLI::Option* add_choice(CLI::App& app, const std::string& name,
                        const std::vector<std::string>& choices,
                        const std::function<void(size_t)>& choose, const std::string& description);

// "image.exr" with tag "2s": "image-2s.exr"; without tag the path itself.
std::string tagged(const std::string& path, const std::string& tag);

const char* version();                   // of the release
size_t peak_memory_bytes();              // of this process
std::string format_bytes(double bytes);  // "1.5 MB"
std::string format_count(double count);  // "1.5 M"

// JSON as all tools write it. File names are bytes: what is no UTF-8 becomes U+FFFD.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace waylight
