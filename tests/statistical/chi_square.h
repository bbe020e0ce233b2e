#pragma once
// Pearson's test of counts against probabilities.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace waylight::testing {

// Q(a, x), the regularised upper incomplete gamma function: the series below a + 1, Lentz's
// continued fraction above it.
inline double upper_gamma(double a, double x) {
  if (x <= 0) return 1;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < 2000 && term > 1e-16 * sum; ++n) sum += term *= x / (a + n);
    return 1 - front * sum;
  }
  double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;
  for (int n = 1; n < 2000; ++n) {
    const double numerator = -n * (n - a);
    b += 2;
    d = 1 / (numerator * d + b);
    c = b + numerator / c;
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-15) break;
  }
  return front * h;
}

struct ChiSquare {
  double statistic = 0, p_value = 1;
  int freedom = 0;
  std::string table;  // observed and expected counts of the worst bins
};

// Bins expected to hold fewer than `min_expected` samples are pooled into one.
inline ChiSquare chi_square(const std::vector<double>& probability, const std::vector<int>& count,
                            double min_expected = 8) {
  const double n = std::accumulate(count.begin(), count.end(), 0.0);
  ChiSquare result;
  std::vector<std::pair<double, std::string>> rows;
  auto add = [&](double expected, double observed, const std::string& label) {
    const double term = (observed - expected) * (observed - expected) / expected;
    result.statistic += term;
    ++result.freedom;
    rows.emplace_back(term, fmt::format("{:>10} expected {:10.2f} observed {:8} chi2 {:8.2f}\n",
                                        label, expected, observed, term));
  };
  double pooled_expected = 0, pooled_observed = 0;
  for (size_t i = 0; i < count.size(); ++i) {
    const double expected = n * probability[i];
    if (expected >= min_expected) {
      add(expected, count[i], fmt::format("bin {}", i));
    } else {
      pooled_expected += expected;
      pooled_observed += count[i];
    }
  }
  // A pool in which next to nothing is expected counts as half a sample: finite, and any sample
  // that falls where the density is zero still shows.
  if (pooled_observed > 0 || pooled_expected >= min_expected)
    add(std::max(pooled_expected, 0.5), pooled_observed, "pool");
  result.freedom = std::max(result.freedom - 1, 1);
  result.p_value = upper_gamma(0.5 * result.freedom, 0.5 * result.statistic);
  std::sort(rows.rbegin(), rows.rend());
  for (size_t i = 0; i < std::min<size_t>(rows.size(), 12); ++i) result.table += rows[i].second;
  return result;
}

}  // namespace waylight::testing
