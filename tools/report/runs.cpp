#include "tools/report/runs.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>

#include "libguide/base/error.h"
#include "tools/common/csv.h"

namespace waylight {
namespace {

namespace fs = std::filesystem;

// As the table says, or by its name beside the table: a folder of results can be moved.
std::string find_beside(const std::string& path, const std::string& table) {
  const fs::path beside = fs::path(table).parent_path() / fs::path(path).filename();
  return fs::exists(path) || !fs::exists(beside) ? path : beside.string();
}

class RowReader {
 public:
  RowReader(const CsvTable& table, const std::string& path) : table_(table), path_(path) {}

  // What the noise of the reference, taken out, can leave of an error.
  bool below_noise(size_t index) const { return !(number(index, "relmse") > 0); }
  std::string what(size_t index, const char* column) const {
    return fmt::format("\"{}\": record {}: {}", path_, index + 2, column);
  }

  Checkpoint read(size_t index) const {
    Checkpoint c;
    c.scene = text(index, "scene");
    c.method = text(index, "method");
    c.seed = optional_text(index, "seed");
    c.seconds = positive(index, "seconds");
    c.spp = positive(index, "spp");
    c.relmse = number(index, "relmse");
    c.relmse_trimmed = optional(index, "relmse_trimmed");
    c.preprocess_seconds = optional(index, "preprocess_seconds");
    c.sample_ms = optional(index, "sample_ms");
    c.path_length = optional(index, "path_length");
    c.memory_bytes = optional(index, "memory_bytes");
    c.image = picture(index, "image");
    c.reference = picture(index, "reference");
    std::istringstream stats(optional_text(index, "preprocess_stats"));
    for (std::string file; std::getline(stats, file, ';');)
      if (fs::exists(find_beside(file, path_)))
        c.preprocess_stats.push_back(find_beside(file, path_));
    return c;
  }

 private:
  std::string text(size_t index, const char* column) const {
    return table_.rows[index][column_of(table_, column, path_)];
  }
  std::string optional_text(size_t index, const char* column) const {
    const int found = table_.find(column);
    return found < 0 ? "" : table_.rows[index][found];
  }
  double optional(size_t index, const char* column) const {
    const std::string cell = optional_text(index, column);
    return cell.empty() ? 0 : number_in(cell, what(index, column));
  }
  double number(size_t index, const char* column) const {
    return number_in(text(index, column), what(index, column));
  }
  double positive(size_t index, const char* column) const {
    const double value = number(index, column);
    if (!(value > 0)) fail("{} is not above 0", what(index, column));
    return value;
  }
  std::string picture(size_t index, const char* column) const {
    const std::string file = find_beside(text(index, column), path_);
    if (!fs::is_regular_file(file))
      fail("{} \"{}\" is not there; run image-compare again where the images are",
           what(index, column), file);
    return file;
  }

  const CsvTable& table_;
  const std::string& path_;
};

// The element of that name, made when there is none yet.
template <typename T>
T& named(std::vector<T>& list, const std::string& name) {
  for (T& element : list)
    if (element.name == name) return element;
  return list.emplace_back(T{name, {}});
}

using Run = std::vector<Checkpoint>;  // of one seed

Run& run_of(std::vector<SceneRuns>& scenes, const Checkpoint& c) {
  Method& method = named(named(scenes, c.scene).methods, c.method);
  for (Run& run : method.seeds)
    if (run[0].seed == c.seed) return run;
  return method.seeds.emplace_back();
}

// A render that ends before its last checkpoints writes them all then: one of them counts.
void add(std::vector<SceneRuns>& scenes, const Checkpoint& c, const std::string& where) {
  Run& run = run_of(scenes, c);
  for (const Checkpoint& other : run) {
    if (other.seconds != c.seconds) continue;
    if (other.spp == c.spp && other.relmse == c.relmse) return;
    fail(
        "{}: scene {}, method {}, seed {} has another row of the same time; "
        "remove one, or give them methods or seeds of their own",
        where, c.scene, c.method, c.seed);
  }
  run.push_back(c);
}

double apart(const Checkpoint& a, const Checkpoint& b) {
  return std::abs(std::log(a.seconds / b.seconds));
}

const Checkpoint& nearest(const Run& run, const Checkpoint& c) {
  return *std::min_element(run.begin(), run.end(), [&](const Checkpoint& a, const Checkpoint& b) {
    return apart(a, c) < apart(b, c);
  });
}

// The checkpoint of `other` that is c of `own` at another seed, or nullptr: each is the nearest to
// the other. A render writes within half a pass of the time it was told, which may be far for the
// first ones; times that double must stay apart.
const Checkpoint* partner(const Checkpoint& c, const Run& own, const Run& other) {
  constexpr double kMostApart = 0.5 * std::numbers::ln2;
  const Checkpoint& found = nearest(other, c);
  return &nearest(own, found) == &c && apart(c, found) < kMostApart ? &found : nullptr;
}

// The checkpoints that all seeds have, so that those of one index are of one time.
std::vector<Run> common_checkpoints(const std::vector<Run>& seeds) {
  std::vector<Run> common(seeds.size());
  for (const Checkpoint& c : seeds[0]) {
    std::vector<const Checkpoint*> partners;
    for (const Run& run : seeds)
      if (const Checkpoint* found = partner(c, seeds[0], run)) partners.push_back(found);
    if (partners.size() < seeds.size()) continue;
    for (size_t i = 0; i < seeds.size(); ++i) common[i].push_back(*partners[i]);
  }
  return common;
}

size_t count(const std::vector<Run>& seeds) {
  size_t sum = 0;
  for (const Run& run : seeds) sum += run.size();
  return sum;
}

void align(const SceneRuns& scene, Method& method, const RunControl& control) {
  for (Run& run : method.seeds)
    std::sort(run.begin(), run.end(),
              [](const Checkpoint& a, const Checkpoint& b) { return a.seconds < b.seconds; });
  const size_t read = count(method.seeds);
  method.seeds = common_checkpoints(method.seeds);
  if (method.seeds[0].empty())
    fail(
        "scene {}, method {}: no time is common to all its seeds; render them with the same "
        "--checkpoints",
        scene.name, method.name);
  if (const size_t lost = read - count(method.seeds); lost > 0)
    control.warn(
        fmt::format("scene {}, method {}: {} of {} rows are left out, of times that not "
                    "all its seeds have",
                    scene.name, method.name, lost, read));
}

void put_first(SceneRuns& scene, const std::string& base) {
  const auto found = std::find_if(scene.methods.begin(), scene.methods.end(),
                                  [&](const Method& method) { return method.name == base; });
  if (found == scene.methods.end())
    fail("--base {}: scene {} has no such method", base, scene.name);
  std::rotate(scene.methods.begin(), found, found + 1);
}

ChartPoint mean_at(const Method& method, size_t checkpoint, Field x, Field y) {
  ChartPoint point{0, 0, INFINITY, 0, 0, ""};
  for (const Run& run : method.seeds) {
    point.x += x(run[checkpoint]) / static_cast<double>(method.seeds.size());
    const double value = y(run[checkpoint]);
    point.y += value / static_cast<double>(method.seeds.size());
    point.low = std::min(point.low, value);
    point.high = std::max(point.high, value);
    ++point.rows;
  }
  return point;
}

}  // namespace

std::vector<SceneRuns> read_runs(const std::vector<std::string>& tables, const std::string& base,
                                 const RunControl& control) {
  std::vector<SceneRuns> scenes;
  for (const std::string& path : tables) {
    const CsvTable table = read_csv(path);
    const RowReader reader(table, path);
    for (size_t i = 0; i < table.rows.size(); ++i)
      if (reader.below_noise(i))
        control.warn(reader.what(i, "relmse") + " is not above 0, below the noise: left out");
      else
        add(scenes, reader.read(i), fmt::format("\"{}\": record {}", path, i + 2));
  }
  if (scenes.empty()) fail("\"{}\": there are no rows to report", tables[0]);
  for (SceneRuns& scene : scenes) {
    if (!base.empty()) put_first(scene, base);
    for (Method& method : scene.methods) align(scene, method, control);
  }
  return scenes;
}

ChartLine line_of(const Method& method, Field x, Field y) {
  ChartLine line{method.name, {}};
  for (size_t i = 0; i < method.seeds[0].size(); ++i)
    line.points.push_back(mean_at(method, i, x, y));
  return line;
}

ChartPoint final_mean(const Method& method, Field y) {
  return mean_at(method, method.seeds[0].size() - 1, y, y);
}

}  // namespace waylight
