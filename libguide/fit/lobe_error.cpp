#include "libguide/fit/lobe_error.h"

namespace waylight {
namespace {

// Shares of what makes the points.
constexpr float kLobeShare = 0.4f, kMixtureShare = 0.4f;
constexpr float kUniformShare = 1 - kLobeShare - kMixtureShare;

// From one of the mixtures; u in [0, 1).
std::optional<Vec2> sample_one(std::span<const FitDensity> mixtures, float u, const Vec2& u2) {
  const float scaled = u * mixtures.size();
  const size_t chosen = std::min<size_t>(scaled, mixtures.size() - 1);
  return mixtures[chosen].sample(std::min(scaled - chosen, kOneMinusEpsilon), u2);
}

std::optional<LobePoint> draw(const LobeTarget& target, std::span<const FitDensity> mixtures,
                              const UnitPoint& unit) {
  if (unit.u < kLobeShare) return sample_lobe(target, {unit.u / kLobeShare, unit.u2});
  if (unit.u >= kLobeShare + kMixtureShare) return evaluate_lobe(target, square_to_disk(unit.u2));
  const auto y = sample_one(mixtures, (unit.u - kLobeShare) / kMixtureShare, unit.u2);
  if (!y || y->squaredNorm() >= 1) return std::nullopt;
  return evaluate_lobe(target, *y);
}

float mean_pdf(std::span<const FitDensity> mixtures, const Vec2& y) {  // per steradian
  float sum = 0;
  for (const FitDensity& mixture : mixtures) sum += mixture.pdf(y);
  return sum / (mixtures.size() * kSteradianPerDiskArea);
}

}  // namespace

FitDensity::FitDensity(std::span<const GaussianComponent> components) {
  const size_t first = std::min<size_t>(components.size(), GaussianMixture::kMaxComponents);
  parts_[0] = GaussianMixture(components.first(first));
  if (first == components.size()) return;
  parts_[1] = GaussianMixture(components.subspan(first));
  float total = 0;
  first_share_ = 0;
  for (size_t k = 0; k < components.size(); ++k) {
    total += components[k].weight;
    if (k < first) first_share_ += components[k].weight;
  }
  first_share_ /= total;
}

float FitDensity::pdf(const Vec2& y) const {
  const float pdf = parts_[0].pdf(y);
  return first_share_ < 1 ? lerp(parts_[1].pdf(y), pdf, first_share_) : pdf;
}

std::optional<Vec2> FitDensity::sample(float u, const Vec2& u2) const {
  if (u < first_share_) return parts_[0].sample(u / first_share_, u2);
  return parts_[1].sample((u - first_share_) / (1 - first_share_), u2);
}

LobeJudge::LobeJudge(const LobeTarget& target, std::span<const FitDensity> mixtures,
                     std::span<const UnitPoint> units)
    : drawn_(units.size()) {
  points_.reserve(units.size());
  for (const UnitPoint& unit : units) {
    std::optional<LobePoint> p = draw(target, mixtures, unit);
    if (!p) continue;
    p->pdf = kLobeShare * p->pdf + kMixtureShare * mean_pdf(mixtures, p->y) +
             kUniformShare * kHemispherePdf;
    points_.push_back(*p);
    f_integral_ += p->f / p->pdf;
  }
}

float LobeJudge::error(const FitDensity& mixture) const {
  if (!(f_integral_ > 0)) return 0;
  const double normalise = drawn_ / f_integral_;
  double difference = 0;
  for (const LobePoint& p : points_)
    difference += std::abs(p.f * normalise - mixture.pdf(p.y) / kSteradianPerDiskArea) / p.pdf;
  return static_cast<float>(std::min(difference / drawn_, 2.0));
}

float held_out_error(const LobeTarget& target, const GaussianMixture& mixture, uint64_t seed) {
  constexpr int kPoints = 1024;
  constexpr uint64_t kStream = 0x4e1d;  // apart from every sequence of the fit
  const FitDensity density(mixture);
  const LobeJudge judge(target, std::span(&density, 1), unit_points(seed, kStream, kPoints));
  return judge.error(density);
}

}  // namespace waylight
