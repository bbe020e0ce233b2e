#include "tools/image-compare/report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace waylight {
namespace {

// A label that reads as a number is one.
nlohmann::ordered_json as_json(const std::string& label) {
  const auto value = nlohmann::ordered_json::parse(label, nullptr, /*allow_exceptions=*/false);
  return value.is_number() ? value : nlohmann::ordered_json(label);
}

nlohmann::ordered_json as_json(const ZDistribution& z) {
  return {{"count", z.count},
          {"mean", z.mean},
          {"stddev", z.stddev},
          {"beyond2", z.beyond2},
          {"expected2", z.expected2()},
          {"beyond3", z.beyond3},
          {"expected3", z.expected3()},
          {"largest", z.largest},
          {"unexplained", z.unexplained}};
}

std::string z_row(const char* what, const ZDistribution& z) {
  const auto with_chance = [](uint64_t beyond, double expected) {
    return fmt::format("{} ({:.1f})", beyond, expected);
  };
  return fmt::format("{:<10}{:>10}{:>10.3f}{:>10.3f}{:>22}{:>22}{:>10.2f}{:>13}", what, z.count,
                     z.mean, z.stddev, with_chance(z.beyond2, z.expected2()),
                     with_chance(z.beyond3, z.expected3()), z.largest, z.unexplained);
}

}  // namespace

nlohmann::ordered_json to_json(const ImageLabels& labels, const ComparisonReport& report) {
  nlohmann::ordered_json json;
  for (const auto& [name, value] : labels)
    if (!value.empty()) json[name] = as_json(value);
  const CompareFigures& f = report.figures;
  json.update({{"pixels", f.pixels},
               {"non_finite", f.non_finite},
               {"mse", f.mse},
               {"relmse", f.relmse},
               {"relmse_trimmed", f.relmse_trimmed},
               {"mape", f.mape},
               {"mean", f.mean},
               {"ref_mean", f.ref_mean},
               {"mean_ratio", f.mean_ratio()}});
  if (report.relmse_of_each.size() > 1) json["relmse_of_each"] = report.relmse_of_each;
  if (report.z)
    json["z"] = {{"pixels", as_json(report.z->pixels)}, {"tiles", as_json(report.z->tiles)}};
  return json;
}

void print_table(const ToolRun& run, const ComparisonReport& report) {
  const CompareFigures& f = report.figures;
  run.print(fmt::format("{:<16}{:.6g}", "MSE", f.mse));
  run.print(fmt::format("{:<16}{:.6g}", "relMSE", f.relmse));
  run.print(fmt::format("{:<16}{:.6g}", "trimmed relMSE", f.relmse_trimmed));
  run.print(fmt::format("{:<16}{:.4g} %", "MAPE", 100 * f.mape));
  run.print(fmt::format("{:<16}{:.6g}", "mean", f.mean));
  run.print(fmt::format("{:<16}{:.6g}", "reference mean", f.ref_mean));
  if (f.ref_mean != 0) run.print(fmt::format("{:<16}{:.6g}", "ratio of means", f.mean_ratio()));
  if (!report.z) return;
  run.print(fmt::format("\n{:<10}{:>10}{:>10}{:>10}{:>22}{:>22}{:>10}{:>13}", "z of", "scores",
                        "mean", "stddev", "|z|>2 (chance)", "|z|>3 (chance)", "largest",
                        "unexplained"));
  run.print(z_row("pixels", report.z->pixels));
  run.print(z_row("tiles", report.z->tiles));
}

}  // namespace waylight
