#include "tools/report/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/common/cli.h"
#include "tools/report/html.h"

namespace waylight {
namespace {

double seconds_of(const Checkpoint& c) { return c.seconds; }
double spp_of(const Checkpoint& c) { return c.spp; }
double relmse_of(const Checkpoint& c) { return c.relmse; }

// The background says at a glance: green sooner, red later, stronger the farther from 1.
std::string ratio_cell(const Reach& r) {
  const double strength = std::min(std::abs(std::log(r.total_ratio)) / std::log(20.0), 1.0) * 0.55;
  return fmt::format(
      "<span class=cell style=\"background:rgba(var(--{}),{:.2f})\">{}{}&times; <small>{}&times;"
      "</small></span>",
      r.total_ratio >= 1 ? "good" : "bad", strength, r.extrapolated ? "&asymp;" : "",
      text_of(r.ratio), text_of(r.total_ratio));
}

std::vector<std::string> method_names(const SceneRuns& scene) {
  std::vector<std::string> names;
  for (const Method& method : scene.methods) names.push_back(escaped(method.name));
  return names;
}

double least_spp(const SceneRuns& scene) {
  double least = INFINITY;
  for (const Method& method : scene.methods) least = std::min(least, final_mean(method, spp_of).y);
  return least;
}

std::vector<std::string> final_row(const Method& method, const Method& base, double spp) {
  const ChartPoint error = line_of(method, seconds_of, relmse_of).points.back();
  const double base_error = line_of(base, seconds_of, relmse_of).points.back().y;
  const auto mean = [&](Field field) { return text_of(final_mean(method, field).y); };
  return {escaped(method.name),
          fmt::to_string(error.rows),
          mean(seconds_of),
          mean([](const Checkpoint& c) { return c.preprocess_seconds; }),
          mean(spp_of),
          with_range(error),
          mean([](const Checkpoint& c) { return c.relmse_trimmed; }),
          text_of(base_error / error.y) + "&times;",
          text_of(cross(line_of(method, spp_of, relmse_of).points, spp)),
          mean([](const Checkpoint& c) { return c.sample_ms; }),
          mean([](const Checkpoint& c) { return c.path_length; }),
          bytes_of(final_mean(method, [](const Checkpoint& c) { return c.memory_bytes; }).y)};
}

}  // namespace

std::string text_of(double value) {
  if (value == 0) return "&ndash;";
  return std::abs(value) >= 1000 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

std::string bytes_of(double value) { return value > 0 ? format_bytes(value) : text_of(0); }

std::string with_range(const ChartPoint& p) {
  const std::string mean = text_of(p.y);
  if (p.rows < 2) return mean;
  return fmt::format("{} <small>({} to {})</small>", mean, text_of(p.low), text_of(p.high));
}

std::string summary_tables(const std::vector<SceneRuns>& scenes) {
  std::string html;
  for (size_t i = 0; i < scenes.size();) {
    const std::vector<std::string> names = method_names(scenes[i]);
    std::vector<std::string> heading{"scene"};
    heading.insert(heading.end(), names.begin(), names.end());
    std::vector<std::vector<std::string>> rows;
    for (; i < scenes.size() && method_names(scenes[i]) == names; ++i) {
      rows.push_back({escaped(scenes[i].name)});
      for (const Reach& reach : reach_table(scenes[i])) rows.back().push_back(ratio_cell(reach));
    }
    html += html_table(heading, rows);
  }
  return html;
}

std::string final_table(const SceneRuns& scene) {
  const double spp = least_spp(scene);
  std::vector<std::vector<std::string>> rows;
  for (const Method& method : scene.methods)
    rows.push_back(final_row(method, scene.methods[0], spp));
  return html_table({"method", "seeds", "seconds", "preprocessing&nbsp;s", "samples per pixel",
                     "relMSE", "trimmed", "less error", "relMSE at " + text_of(spp) + " samples",
                     "ms per sample", "edges per path", "peak memory"},
                    rows);
}

std::string reach_table_html(const SceneRuns& scene) {
  std::vector<std::vector<std::string>> rows;
  for (const Reach& r : reach_table(scene))
    rows.push_back({escaped(r.method),
                    (r.extrapolated ? "&asymp;" : "") +
                        with_range({0, r.seconds, r.low, r.high, r.low < r.high ? 2 : 1, ""}),
                    text_of(r.ratio) + "&times;", text_of(r.preprocess_seconds),
                    text_of(r.seconds + r.preprocess_seconds), text_of(r.total_ratio) + "&times;",
                    text_of(r.trimmed_ratio) + "&times;"});
  return html_table({"method", "seconds", "sooner", "preprocessing&nbsp;s", "together s",
                     "sooner with preprocessing", "sooner by trimmed relMSE"},
                    rows);
}

}  // namespace waylight
