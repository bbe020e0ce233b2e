#include "tools/report/runs.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
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

  Checkpoint read(size_t index) const {
    Checkpoint c;
    c.scene = text(index, "scene");
    c.method = text(index, "method");
    c.seed = optional_text(index, "seed");
    c.seconds = positive(index, "seconds");
    c.spp = positive(index, "spp");
    c.relmse = positive(index, "relmse");
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
  std::string what(size_t index, const char* column) const {
    return fmt::format("\"{}\": record {}: {}", path_, index + 2, column);
  }
  std::string optional_text(size_t index, const char* column) const {
    const int found = table_.find(column);
    return found < 0 ? "" : table_.rows[index][found];
  }
  double optional(size_t index, const char* column) const {
    const std::string cell = optional_text(index, column);
    return cell.empty() ? 0 : number_in(cell, what(index, column));
  }
  double positive(size_t index, const char* column) const {
    const double value = number_in(text(index, column), what(index, column));
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

void add(std::vector<SceneRuns>& scenes, const Checkpoint& c) {
  Method& method = named(named(scenes, c.scene).methods, c.method);
  for (std::vector<Checkpoint>& run : method.seeds)
    if (run[0].seed == c.seed) return run.push_back(c);
  method.seeds.push_back({c});
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
  for (const std::vector<Checkpoint>& run : method.seeds) {
    point.x += std::log(x(run[checkpoint])) / static_cast<double>(method.seeds.size());
    const double value = y(run[checkpoint]);
    point.y += std::log(value) / static_cast<double>(method.seeds.size());
    point.low = std::min(point.low, value);
    point.high = std::max(point.high, value);
    ++point.rows;
  }
  point.x = std::exp(point.x);
  point.y = std::exp(point.y);
  return point;
}

}  // namespace

std::vector<SceneRuns> read_runs(const std::vector<std::string>& tables, const std::string& base) {
  std::vector<SceneRuns> scenes;
  for (const std::string& path : tables) {
    const CsvTable table = read_csv(path);
    const RowReader reader(table, path);
    for (size_t i = 0; i < table.rows.size(); ++i) add(scenes, reader.read(i));
  }
  if (scenes.empty()) fail("\"{}\": there are no rows to report", tables[0]);
  for (SceneRuns& scene : scenes) {
    if (!base.empty()) put_first(scene, base);
    for (Method& method : scene.methods)
      for (std::vector<Checkpoint>& run : method.seeds)
        std::stable_sort(run.begin(), run.end(), [](const Checkpoint& a, const Checkpoint& b) {
          return a.seconds < b.seconds;
        });
  }
  return scenes;
}

ChartLine line_of(const Method& method, Field x, Field y) {
  size_t checkpoints = method.seeds[0].size();
  for (const std::vector<Checkpoint>& run : method.seeds)
    checkpoints = std::min(checkpoints, run.size());
  ChartLine line{method.name, {}};
  for (size_t i = 0; i < checkpoints; ++i) line.points.push_back(mean_at(method, i, x, y));
  return line;
}

ChartPoint final_mean(const Method& method, Field y) {
  ChartPoint point{0, 0, INFINITY, 0, static_cast<int>(method.seeds.size()), ""};
  for (const std::vector<Checkpoint>& run : method.seeds) {
    const double value = y(run.back());
    point.y += value / point.rows;
    point.low = std::min(point.low, value);
    point.high = std::max(point.high, value);
  }
  return point;
}

}  // namespace waylight
