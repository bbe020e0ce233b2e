#include "libguide/base/error.h"
#include "libguide/scene/camera.h"

namespace waylight {
namespace {

constexpr int kCellsPerPixel = 64;

float default_radius(FilterType type) {
  switch (type) {
    case FilterType::box:
      return 0.5f;
    case FilterType::tent:
      return 1;
    case FilterType::gaussian:
    case FilterType::mitchell:
      return 2;
  }
  fail("film: unknown reconstruction filter");
}

// [Mitchell, Netravali 1988], x in [0, 2].
double mitchell(double x, double b, double c) {
  if (x >= 2) return 0;
  if (x < 1)
    return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + 6 - 2 * b) / 6;
  return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x + 8 * b +
          24 * c) /
         6;
}

// Unnormalised, at distance x from the centre. The gaussian is lowered to meet zero (Mitsuba's).
double evaluate(const FilmDescription& film, double radius, double x) {
  const double a = -0.5 / (static_cast<double>(film.filter_stddev) * film.filter_stddev);
  switch (film.filter) {
    case FilterType::box:
      return 1;
    case FilterType::tent:
      return std::max(0.0, 1 - x / radius);
    case FilterType::gaussian:
      return std::max(0.0, std::exp(a * x * x) - std::exp(a * radius * radius));
    case FilterType::mitchell:
      return mitchell(2 * x / radius, film.filter_b, film.filter_c);
  }
  return 0;
}

}  // namespace

FilterSampler::FilterSampler(const FilmDescription& film) {
  const float radius = film.filter_radius > 0 ? film.filter_radius : default_radius(film.filter);
  if (!(radius <= kMaxRadius && film.filter_stddev > 0))
    fail("film: the filter needs a radius of at most {} pixels and a deviation above 0",
         kMaxRadius);
  const int cells = std::max(2, static_cast<int>(std::ceil(2 * radius * kCellsPerPixel)));
  for (int i = 0; i <= cells; ++i) {
    const double x = radius * (2.0 * i / cells - 1);
    const float value = static_cast<float>(evaluate(film, radius, std::abs(x)));
    if (i > 0 && value * nodes_.back().value < 0) {
      const Node& last = nodes_.back();
      const float part = last.value / (last.value - value);
      nodes_.push_back({lerp(last.x, static_cast<float>(x), part), 0, 0});
    }
    nodes_.push_back({static_cast<float>(x), value, 0});
  }
  double total = 0, absolute = 0;
  for (size_t i = 1; i < nodes_.size(); ++i) {
    const double area =
        0.5 * (nodes_[i].x - nodes_[i - 1].x) * (nodes_[i].value + nodes_[i - 1].value);
    total += area;
    absolute += std::abs(area);
    nodes_[i].cdf = static_cast<float>(absolute);
  }
  if (!(total > 0)) fail("film: the reconstruction filter integrates to {}", total);
  for (Node& node : nodes_) node.cdf /= nodes_.back().cdf;
  weight_ = static_cast<float>(sqr(static_cast<float>(absolute / total)));
}

// Inverts the cdf of the linear density between two nodes of like sign.
float FilterSampler::axis(float u, float& sign) const {
  const auto above =
      std::upper_bound(nodes_.begin(), nodes_.end() - 1, u,
                       [](float value, const Node& node) { return value < node.cdf; });
  const Node &b = *above, &a = *(above - 1);
  sign = a.value + b.value < 0 ? -sign : sign;
  const float part = (u - a.cdf) / (b.cdf - a.cdf);
  const float first = std::abs(a.value), last = std::abs(b.value);
  // int_0^s (first + (last - first) t) dt = part (first + last) / 2, solved without cancellation.
  const float root = std::sqrt(lerp(first * first, last * last, part));
  const float s = first + root > 0 ? part * (first + last) / (first + root) : part;
  return lerp(a.x, b.x, std::clamp(s, 0.0f, 1.0f));
}

FilterSampler::Sample FilterSampler::sample(const Vec2& u) const {
  float sign = 1;
  const float x = axis(u.x(), sign), y = axis(u.y(), sign);
  return {{x, y}, sign * weight_};
}

}  // namespace waylight
