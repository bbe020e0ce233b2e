#include "tools/common/cli.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "formats/atomic_file.h"
#include "libguide/base/error.h"
#include "libguide/base/parallel.h"
#include "tools/common/command_line.h"
#include "tools/common/progress.h"

namespace waylight {
namespace {

std::atomic<bool> stop_requested{false};

// The first signal asks for an orderly end; the handler is gone then, so the second one kills.
void install_signal_handlers() {
  struct sigaction action = {};
  action.sa_handler = [](int) { stop_requested.store(true, std::memory_order_relaxed); };
  action.sa_flags = SA_RESETHAND;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

bool same_file(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  return fs::weakly_canonical(fs::absolute(a), error) ==
         fs::weakly_canonical(fs::absolute(b), error);
}

// Before any work is done, so that an hour's result is not lost to a misspelt folder.
void check_files(const CLI::App& app) {
  const std::vector<std::string> inputs = files_of(app, kInput), outputs = files_of(app, kOutput);
  for (size_t i = 0; i < outputs.size(); ++i) {
    for (const std::string& input : inputs)
      require(!same_file(outputs[i], input),
              "the output \"{}\" is also an input: name another file", outputs[i]);
    for (size_t j = 0; j < i; ++j)
      require(!same_file(outputs[i], outputs[j]), "two outputs have the same name \"{}\"",
              outputs[i]);
  }
  for (const std::string& input : inputs) {
    if (!std::filesystem::exists(input)) fail("\"{}\": no such file", input);
    if (std::filesystem::is_directory(input)) fail("\"{}\": is a folder, not a file", input);
    if (::access(input.c_str(), R_OK) != 0) fail("\"{}\": cannot be read (permissions)", input);
  }
  for (const std::string& output : outputs) check_writable(output);
}

// Inside a Slurm job the job's share counts, not the machine's.
int default_threads() {
  const char* slurm = std::getenv("SLURM_CPUS_PER_TASK");
  return slurm ? std::max(0, std::atoi(slurm)) : 0;
}

}  // namespace

// Holds what lives as long as one run.
class ToolRunner {
 public:
  ToolRunner(const ToolInfo& info, const std::function<void(CLI::App&)>& declare) : info_(info) {
    app_.name(info.name);
    app_.description(info.summary);
    app_.usage_line = fmt::format("Usage: {} {}", info.name, info.usage);
    app_.footer(info.teaching);
    app_.option_defaults()->always_capture_default();
    declare(app_);
    declare_common();
  }

  int run(int argc, char** argv, const std::function<void(ToolRun&)>& body) {
    if (argc <= 1) return short_usage();
    try {
      app_.parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help, --version
      return app_.exit(asked);
    } catch (const CLI::ParseError& error) {
      const std::string message = app_.remaining().empty() ? error.what() : unknown_words(app_);
      return print_error(fmt::format("{} (see {} --help)", message, info_.name), kMisuse);
    }
    return run_parsed(body);
  }

 private:
  // CLI11 2.1 writes its own usage line and has no setter for it.
  class App : public CLI::App {
   public:
    std::string usage_line;
  };
  class Formatter : public CLI::Formatter {
   public:
    std::string make_usage(const CLI::App* app, std::string) const override {
      return static_cast<const App*>(app)->usage_line + "\n";
    }
    // "INT (=5)"; CLI11 would print the range twice and an empty default as "[]".
    std::string make_option_opts(const CLI::Option* option) const override {
      if (is_flag(*option)) return {};
      const std::string type = option->get_type_name(), value = option->get_default_str();
      const bool file = type == kInput || type == kOutput;
      std::string text = " " + (file ? "FILE" : type.substr(0, type.find(':')));
      if (file && option->get_positional()) text.clear();
      if (!value.empty() && value != "[]" && value != "\"\"") text += " (=" + value + ")";
      if (option->get_required()) text += " (required)";
      return text;
    }
  };

  void declare_common() {
    app_.formatter(std::make_shared<Formatter>());
    app_.get_formatter()->column_width(32);
    app_.set_help_flag("-h,--help", "Print this help and exit");
    app_.set_version_flag("--version", fmt::format("{} (Waylight) {}", info_.name, version()));
    app_.add_option("--threads", threads_, "Threads to use; 0: all cores (never changes results)")
        ->check(CLI::Range(0, 4096))
        ->group("Common");
    as_output(app_.add_option("--stats", run_.stats_path_, "Write statistics as JSON"))
        ->group("Common");
    app_.add_flag("-q,--quiet", run_.quiet_, "Print errors and warnings only")->group("Common");
  }

  int run_parsed(const std::function<void(ToolRun&)>& body) {
    try {
      check_files(app_);
      prepare();
      body(run_);
    } catch (const Interrupted&) {
      return print_error("interrupted", kInterrupted);
    } catch (const Misuse& error) {
      return print_error(error.what(), kMisuse);
    } catch (const std::bad_alloc&) {
      return print_error("out of memory", kFailure);
    } catch (const std::exception& error) {
      if (stop_requested) return print_error("interrupted", kInterrupted);
      return print_error(error.what(), kFailure);
    }
    progress_.clear();
    return stop_requested ? print_error("interrupted", kInterrupted) : finish_output();
  }

  // A full disk or a closed pipe shows only when the last buffer is written.
  int finish_output() {
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return kSuccess;
    return print_error("cannot write to the standard output", kFailure);
  }

  void prepare() {
    install_signal_handlers();
    limit_.emplace(threads_ > 0 ? threads_ : default_threads());
    run_.command_line_ = canonical_command_line(app_, info_.name);
    run_.outputs_ = files_of(app_, kOutput);
    run_.stdout_taken_ = uses_standard_stream(app_, kOutput);
    run_.control.stop = &stop_requested;
    run_.control.on_warning = [this](const std::string& message) { progress_.warn(message); };
    if (run_.quiet_) return;
    run_.control.on_progress = [this](double done, double total, const char* unit) {
      progress_.update(done, total, unit);
    };
  }

  int short_usage() {
    std::fputs(fmt::format("{}: {}\nUsage: {} {}\nSee {} --help.\n", info_.name, info_.summary,
                           info_.name, info_.usage, info_.name)
                   .c_str(),
               stderr);
    return kMisuse;
  }

  int print_error(const std::string& message, ExitCode code) {
    progress_.clear();
    std::fflush(stdout);
    std::fputs(fmt::format("{}: {}\n", info_.name, message).c_str(), stderr);
    return code;
  }

  ToolInfo info_;
  App app_;
  ProgressPrinter progress_{info_.name};
  ToolRun run_;
  int threads_ = 0;
  std::optional<ThreadLimit> limit_;
};

void ToolRun::print(const std::string& line) const {
  if (!quiet_) std::fputs((line + "\n").c_str(), stdout_taken_ ? stderr : stdout);
}

void ToolRun::write_stats(const nlohmann::ordered_json& stats, const std::string& tag) const {
  if (!stats_path_.empty())
    write_text_atomically(tagged(stats_path_, tag), json_text(stats) + "\n");
}

void ToolRun::check_referred(const std::string& file,
                             const std::vector<std::string>& written) const {
  for (const std::vector<std::string>* outputs : {&outputs_, &written})
    for (const std::string& output : *outputs)
      require(!same_file(output, file), "the output \"{}\" is also read: name another file",
              output);
}

void ToolRun::stop_if_interrupted() const {
  if (control.stopped()) throw Interrupted();
}

int run_tool(int argc, char** argv, const ToolInfo& info,
             const std::function<void(CLI::App&)>& declare,
             const std::function<void(ToolRun&)>& body) {
  return ToolRunner(info, declare).run(argc, argv, body);
}

std::string tagged(const std::string& path, const std::string& tag) {
  if (tag.empty()) return path;
  const std::filesystem::path name(path);
  return name.parent_path() / (name.stem().string() + "-" + tag + name.extension().string());
}

std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', /*ensure_ascii=*/false,
                   nlohmann::ordered_json::error_handler_t::replace);
}

const char* version() { return WAYLIGHT_VERSION; }

size_t peak_memory_bytes() {
  struct rusage usage = {};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<size_t>(usage.ru_maxrss) * 1024;  // Linux counts KiB
}

}  // namespace waylight
