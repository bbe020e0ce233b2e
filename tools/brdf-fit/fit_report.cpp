#include "tools/brdf-fit/fit_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace waylight {
namespace {

using Json = nlohmann::ordered_json;

// A family does not say by which method its entries were made.
Json by_method(const MaterialFitSummary& m, double value) {
  return m.from_family ? Json(nullptr) : Json(value);
}

std::string text_by_method(const MaterialFitSummary& m, double value) {
  return m.from_family ? "-" : fmt::format("{:.3f}", value);
}

Json to_json(const MaterialFitSummary& m) {
  return {{"name", m.name},
          {"kind", m.kind},
          {"textured", m.textured},
          {"widths", m.widths},
          {"entries", m.entries},
          {"mean_components", m.mean_components},
          {"held_out_error", m.held_out_error},
          {"em_error", by_method(m, m.em_error)},
          {"ceres_error", by_method(m, m.ceres_error)},
          {"ceres_share", by_method(m, m.ceres_share)},
          {"seconds", m.seconds},
          {"em_seconds", m.em_seconds},
          {"ceres_seconds", m.ceres_seconds},
          {"bytes", m.bytes},
          {"from_family", m.from_family},
          {"shares_with", m.shares_with}};
}

Json to_json(const FitCost& cost) {
  return {{"entries", cost.entries}, {"bytes", cost.bytes}, {"seconds", cost.seconds}};
}

std::string remark(const MaterialFitSummary& m) {
  if (!m.shares_with.empty()) return fmt::format("  as {}", m.shares_with);
  if (m.widths > 0)
    return fmt::format("  {} widths", m.widths) + (m.from_family ? " of its family" : "");
  if (m.from_family) return "  of its family";
  return m.textured ? "  mean of its textures" : "";
}

void print_totals(const ToolRun& run, const BrdfFitSummary& summary, double seconds) {
  run.print(fmt::format("{} materials, {} entries, {} in {:.2f} s", summary.materials.size(),
                        summary.cost.entries, format_bytes(double(summary.cost.bytes)), seconds));
  if (summary.cost.bytes < summary.bytes_at_most_components)
    run.print(fmt::format("with all components in every entry: {}",
                          format_bytes(double(summary.bytes_at_most_components))));
  if (summary.full.entries == summary.cost.entries) return;
  run.print(
      fmt::format("unshared and at full resolution: {} entries, {}, {:.1f} times the CPU time",
                  summary.full.entries, format_bytes(double(summary.full.bytes)),
                  summary.full.seconds / std::max(summary.cost.seconds, 1e-9)));
}

}  // namespace

void print_table(const ToolRun& run, const BrdfFitSummary& summary, double seconds) {
  run.print(fmt::format("{:28} {:16} {:>7} {:>5} {:>7} {:>7} {:>7} {:>8} {:>8}", "material", "kind",
                        "entries", "comp.", "error", "EM", "Ceres", "CPU ms", "size"));
  for (const MaterialFitSummary& m : summary.materials)
    run.print(fmt::format("{:28} {:16} {:>7} {:>5.1f} {:>7.3f} {:>7} {:>7} {:>8.1f} {:>8}{}",
                          m.name, m.kind, m.entries, m.mean_components, m.held_out_error,
                          text_by_method(m, m.em_error), text_by_method(m, m.ceres_error),
                          1000 * m.seconds, format_bytes(double(m.bytes)), remark(m)));
  for (const std::string& name : summary.skipped) run.print("not fitted: " + name);
  print_totals(run, summary, seconds);
}

Json to_json(const BrdfFitSummary& summary) {
  Json materials = Json::array();
  for (const MaterialFitSummary& m : summary.materials) materials.push_back(to_json(m));
  return {{"entries", summary.cost.entries},
          {"bytes", summary.cost.bytes},
          {"bytes_at_most_components", summary.bytes_at_most_components},
          {"full", to_json(summary.full)},
          {"materials", materials},
          {"skipped", summary.skipped}};
}

CsvTable entry_table(const BrdfFitSummary& summary, const BrdfFitOptions& options) {
  CsvTable table;
  table.columns = {
      "material", "kind",        "theta", "max_components", "components",       "method", "error",
      "em_error", "ceres_error", "em_ms", "ceres_ms",       "ceres_iterations", "ms"};
  for (const EntryFitSummary& e : summary.entries) {
    const MaterialFitSummary& m = summary.materials[e.material];
    const auto number = [](double v) { return fmt::format("{:.6g}", v); };
    table.rows.push_back({m.name, m.kind, number(e.theta * 180 / kPi),
                          fmt::to_string(options.components), fmt::to_string(e.components),
                          e.fit.method == FitMethod::em ? "em" : "ceres", number(e.fit.error),
                          number(e.fit.em_error), number(e.fit.ceres_error),
                          number(1e3 * e.fit.em_seconds), number(1e3 * e.fit.ceres_seconds),
                          fmt::to_string(e.fit.ceres_iterations), number(1e3 * e.fit.seconds)});
  }
  return table;
}

}  // namespace waylight
