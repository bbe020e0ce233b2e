// What made the pictures of a scene.

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "formats/file_bytes.h"
#include "tools/report/figures.h"
#include "tools/report/gallery.h"
#include "tools/report/html.h"

namespace waylight {
namespace {

using Rows = std::vector<std::vector<std::string>>;

void add_attributes(Rows& rows, const std::string& name, const Attributes& attributes) {
  const std::string prefix = "waylight.";
  std::string shown = name;
  for (const auto& [key, value] : attributes) {
    if (!key.starts_with(prefix)) continue;
    rows.push_back({shown, escaped(key.substr(prefix.size())), escaped(value)});
    shown.clear();
  }
}

nlohmann::json read_stats(const std::string& file) {
  const auto stats = nlohmann::json::parse(read_whole_file(file), nullptr, false);
  if (!stats.is_object()) fail("\"{}\": is not a JSON object of statistics", file);
  return stats;
}

// A value of statistics, or `otherwise` where there is none.
template <typename T>
T value_of(const nlohmann::json& stats, const std::string& file, const char* key, T otherwise) {
  try {
    return stats.value(key, otherwise);
  } catch (const nlohmann::json::type_error&) {
    fail("\"{}\": \"{}\" is not a {}; let the stage write its statistics again", file, key,
         std::is_arithmetic_v<T> ? "number" : "text");
  }
}

// What a render found out by itself, where its statistics are beside it.
void add_findings(Rows& rows, const std::string& image) {
  const std::string file = std::filesystem::path(image).replace_extension(".json");
  if (!std::filesystem::exists(file)) return;
  const nlohmann::json stats = read_stats(file);
  for (const char* key : {"cpu_seconds", "rays", "guiding_share", "bsdf_share", "auto"})
    if (stats.contains(key)) rows.push_back({"", key, escaped(stats[key].dump())});
}

std::vector<std::string> stats_files(const SceneRuns& scene) {
  std::vector<std::string> files;
  for (const Method& method : scene.methods)
    for (const std::string& file : method.last().preprocess_stats)
      if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  return files;
}

std::vector<std::string> stage_row(const std::string& file) {
  const nlohmann::json stats = read_stats(file);
  const std::string none;
  return {text_of(value_of(stats, file, "seconds", 0.0)),
          bytes_of(value_of(stats, file, "peak_memory_bytes", 0.0)),
          escaped(value_of(stats, file, "tool", none)),
          escaped(value_of(stats, file, "command", none))};
}

}  // namespace

std::string provenance(const SceneRuns& scene, const Pictures& pictures) {
  Rows images, stages;
  add_attributes(images, "reference", pictures.reference.attributes);
  for (size_t i = 0; i < scene.methods.size(); ++i) {
    add_attributes(images, escaped(scene.methods[i].name), pictures.methods[i].attributes);
    add_findings(images, scene.methods[i].last().image);
  }
  for (const std::string& file : stats_files(scene)) stages.push_back(stage_row(file));
  std::string html = "<details><summary>Parameters and provenance</summary>\n";
  if (!stages.empty())
    html += "<h3>Preprocessing</h3>\n" +
            html_table({"seconds", "peak memory", "tool", "command"}, stages, true);
  html += "<h3>Images</h3>\n" + html_table({"image", "what", "value"}, images, true);
  return html + "</details>\n";
}

}  // namespace waylight
