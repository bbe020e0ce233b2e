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

void print_z_row(const char* what, const ZDistribution& z) {
  const auto with_chance = [](uint64_t beyond, double expected) {
    return fmt::format("{} ({:.1f})", beyond, expected);
  };
  fmt::print("{:<10}{:>10}{:>10.3f}{:>10.3f}{:>22}{:>22}{:>10.2f}{:>13}\n", what, z.count, z.mean,
             z.stddev, with_chance(z.beyond2, z.expected2()), with_chance(z.beyond3, z.expected3()),
             z.largest, z.unexplained);
}

}  // namespace

void print_json(const ImageLabels& labels, const ComparisonReport& report) {
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
  if (report.z)
    json["z"] = {{"pixels", as_json(report.z->pixels)}, {"tiles", as_json(report.z->tiles)}};
  fmt::print("{}\n", json.dump(2));
}

void print_table(const ComparisonReport& report) {
  const CompareFigures& f = report.figures;
  fmt::print("{:<16}{:.6g}\n", "MSE", f.mse);
  fmt::print("{:<16}{:.6g}\n", "relMSE", f.relmse);
  fmt::print("{:<16}{:.6g}\n", "trimmed relMSE", f.relmse_trimmed);
  fmt::print("{:<16}{:.4g} %\n", "MAPE", 100 * f.mape);
  fmt::print("{:<16}{:.6g}\n", "mean", f.mean);
  fmt::print("{:<16}{:.6g}\n", "reference mean", f.ref_mean);
  fmt::print("{:<16}{:.6g}\n", "ratio of means", f.mean_ratio());
  if (!report.z) return;
  fmt::print("\n{:<10}{:>10}{:>10}{:>10}{:>22}{:>22}{:>10}{:>13}\n", "z of", "scores", "mean",
             "stddev", "|z|>2 (chance)", "|z|>3 (chance)", "largest", "unexplained");
  print_z_row("pixels", report.z->pixels);
  print_z_row("tiles", report.z->tiles);
}

}  // namespace waylight
