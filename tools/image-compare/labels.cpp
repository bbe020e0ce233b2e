// Labels of an image: from the statistics that stages write, and from the command line.

#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "formats/file_bytes.h"
#include "tools/common/csv.h"
#include "tools/image-compare/compare_tool.h"

namespace waylight {
namespace {

using Json = nlohmann::json;

Json read_statistics(const std::string& path) {
  const Json json = Json::parse(read_whole_file(path), nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) fail("\"{}\": is not a JSON object of statistics", path);
  return json;
}

// A number or a string, or null.
Json find_value(const Json& statistics, const char* key) {
  const auto found = statistics.find(key);
  return found != statistics.end() && (found->is_number() || found->is_string()) ? *found : Json();
}

std::string as_text(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

void take_statistics(const std::string& path, ImageLabels& labels) {
  const Json statistics = read_statistics(path);
  const auto take = [&](const char* label, const char* key) {
    const Json value = find_value(statistics, key);
    if (!value.is_null()) labels[label] = as_text(value);
  };
  take("scene", "scene");
  take("method", "mode");
  take("seed", "seed");
  take("seconds", "seconds");
  take("cpu_seconds", "cpu_seconds");
  take("spp", "spp");
  take("path_length", "mean_path_length");
  take("memory_bytes", "peak_memory_bytes");
}

double preprocess_seconds(const std::vector<std::string>& paths) {
  double sum = 0;
  for (const std::string& path : paths) {
    const Json seconds = find_value(read_statistics(path), "seconds");
    if (!seconds.is_number()) fail("\"{}\": holds no number \"seconds\"", path);
    sum += seconds.get<double>();
  }
  return sum;
}

// In milliseconds, or empty where it is not known.
std::string time_of_a_sample(const ImageLabels& labels) {
  const std::string &seconds = labels.at("seconds"), &spp = labels.at("spp");
  if (seconds.empty() || spp.empty() || !(number_in(spp, "spp") > 0)) return {};
  return fmt::format("{:.6g}", 1000 * number_in(seconds, "seconds") / number_in(spp, "spp"));
}

// Columns of words; chart takes numbers from all others.
bool is_text(const std::string& label) {
  return label == "scene" || label == "method" || label == "seed";
}

}  // namespace

ImageLabels collect_labels(const ImageCompareOptions& options) {
  ImageLabels labels;
  for (const char* name : kImageLabels) labels[name] = "";
  if (!options.stats.empty()) take_statistics(options.stats, labels);
  if (!options.preprocess_stats.empty())
    labels["preprocess_seconds"] =
        fmt::format("{:.6g}", preprocess_seconds(options.preprocess_stats));
  for (const std::string& label : options.labels) {
    const size_t equals = label.find('=');
    const std::string name = label.substr(0, equals);
    require(equals != std::string::npos && labels.count(name),
            "--label \"{}\" is not one of {}=", label, fmt::join(kImageLabels, "=, "));
    labels[name] = label.substr(equals + 1);
    require(is_text(name) || labels[name].empty() || finite_number(labels[name]),
            "--label \"{}\": chart needs a number there", label);
  }
  if (labels["sample_ms"].empty()) labels["sample_ms"] = time_of_a_sample(labels);
  return labels;
}

}  // namespace waylight
