#include "tools/report/reach.h"

#include <algorithm>
#include <cmath>

namespace waylight {
namespace {

double seconds_of(const Checkpoint& c) { return c.seconds; }
double relmse_of(const Checkpoint& c) { return c.relmse; }

double trimmed_of(const Checkpoint& c) { return c.relmse_trimmed; }

double error_at_end(const Method& method, Field error) {
  return line_of(method, seconds_of, error).points.back().y;
}

double time_at(const Method& method, Field error, double target, bool* beyond = nullptr) {
  std::vector<ChartPoint> points = line_of(method, error, seconds_of).points;
  std::erase_if(points, [](const ChartPoint& p) { return !(p.x > 0); });  // below the noise
  return cross(points, target, beyond);
}

// 0 where the table has no trimmed errors.
double trimmed_ratio(const Method& method, const Method& base) {
  const double target = error_at_end(base, trimmed_of);
  if (!(target > 0) || !(error_at_end(method, trimmed_of) > 0)) return 0;
  return time_at(base, trimmed_of, target) / time_at(method, trimmed_of, target);
}

Reach reach_of(const Method& method, double target) {
  Reach reach;
  reach.method = method.name;
  reach.target = target;
  reach.seconds = time_at(method, relmse_of, target, &reach.extrapolated);
  reach.low = reach.high = reach.seconds;
  for (const std::vector<Checkpoint>& run : method.seeds) {
    const double seconds = time_at({method.name, {run}}, relmse_of, target);
    reach.low = std::min(reach.low, seconds);
    reach.high = std::max(reach.high, seconds);
  }
  reach.preprocess_seconds =
      final_mean(method, [](const Checkpoint& c) { return c.preprocess_seconds; }).y;
  return reach;
}

}  // namespace

double cross(const std::vector<ChartPoint>& line, double x, bool* beyond) {
  for (size_t i = line.size(); i-- > 0;) {
    const ChartPoint& b = line[i];
    if (b.x == x) return b.y;
    const ChartPoint& a = line[i > 0 ? i - 1 : i];
    if ((a.x - x) * (b.x - x) >= 0) continue;
    return a.y * std::pow(b.y / a.y, std::log(x / a.x) / std::log(b.x / a.x));
  }
  const auto distance = [&](const ChartPoint& p) { return std::abs(std::log(p.x / x)); };
  const ChartPoint& end =
      distance(line.front()) < distance(line.back()) ? line.front() : line.back();
  if (beyond) *beyond = distance(end) > 1e-9;
  return end.x * end.y / x;
}

std::vector<Reach> reach_table(const SceneRuns& scene) {
  const double target = error_at_end(scene.methods[0], relmse_of);
  std::vector<Reach> table;
  for (const Method& method : scene.methods) {
    Reach reach = reach_of(method, target);
    const Reach& base = table.empty() ? reach : table[0];
    reach.scene = scene.name;
    reach.ratio = base.seconds / reach.seconds;
    reach.total_ratio =
        (base.seconds + base.preprocess_seconds) / (reach.seconds + reach.preprocess_seconds);
    reach.trimmed_ratio = trimmed_ratio(method, scene.methods[0]);
    table.push_back(reach);
  }
  return table;
}

}  // namespace waylight
