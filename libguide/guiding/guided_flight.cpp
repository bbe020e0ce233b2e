#include "libguide/guiding/guided_flight.h"

#include "libguide/math/fast_exp.h"

namespace waylight {
namespace {

// 1 - e^-x within 1e-6 of itself, for thin bins too: the difference alone would lose their digits.
Lanes attenuated_share(Lanes x) {
  const Lanes series = x * (1 - x * (0.5f - x * (1.0f / 6 - x * (1.0f / 24))));
  return x < 0.0625f ? series : 1 - exp_clamped(-x);
}

}  // namespace

GuidedFlight::GuidedFlight(const FlightSpace& space, const FlightOptions& options)
    : space_(space), bins_(space) {
  const Color &s = bins_.sigma, &p = space.channels;
  process_count_ = s[0] == s[1] && s[1] == s[2] ? 1 : 3;
  for (int c = 0; c < 3; ++c) processes_[c] = {process_count_ == 1 ? p.sum() : p[c], s[c]};
  weigh(options.standard_share);
}

void GuidedFlight::weigh(float standard_share) {
  Lanes sum{}, direct{};
  for (int i = 0; i < bins_.count; i += kLanes) {
    const Lanes depth = lanes_load(&bins_.depth[i]);
    const Lanes thickness = lanes_load(&bins_.density[i]) * lanes_load(&bins_.length[i]);
    Lanes mass{};
    for (int c = 0; c < process_count_; ++c) {
      const auto [prob, sigma] = processes_[c];
      mass += prob * exp_clamped(-sigma * depth) * attenuated_share(sigma * thickness);
    }
    lanes_store(mass, &mass_[i]);
    const Lanes guided = mass * lanes_load(&bins_.source[i]);
    sum += guided;
    direct += guided * lanes_load(&bins_.direct[i]);
  }
  float passed = 0;
  for (int c = 0; c < process_count_; ++c)
    passed += processes_[c].prob * std::exp(-processes_[c].sigma * bins_.end_depth);
  const float total = lanes_sum(sum) + bins_.end_radiance * passed;
  const bool knows = total > 0 && std::isfinite(total);
  standard_ = knows ? standard_share : 1;
  guided_ = knows ? (1 - standard_share) / total : 0;
  pass_ = passed * (standard_ + guided_ * bins_.end_radiance);
  from_emitters_ = knows ? guided_ * lanes_sum(direct) : 0;
}

void GuidedFlight::aim_at(const Vec3& light) {
  near_light_ = EquiangularRange(space_, bins_.sigma, light);
  aimed_ = near_light_.empty() ? 0 : near_light_.angle() * (1 / kPi);
}

float GuidedFlight::standard_mass(const Process& process, int bin) const {
  const float thickness = process.sigma * bins_.density[bin] * bins_.length[bin];
  return process.prob * std::exp(-process.sigma * bins_.depth[bin]) * -std::expm1(-thickness);
}

float GuidedFlight::pdf_in(int bin, float t) const {
  const float depth = bins_.depth_at(bin, t);
  float standard = 0;  // per unit depth
  for (int c = 0; c < process_count_; ++c)
    standard += processes_[c].prob * processes_[c].sigma * std::exp(-processes_[c].sigma * depth);
  return standard * bins_.density[bin] * factor(bin);
}

// By the truncated exponential of one process, chosen by its share of the bin's mass.
float GuidedFlight::place(int bin, const Vec2& u) const {
  int c = 0;
  if (process_count_ > 1) {
    float left = u.y() * mass_[bin];
    while (c < 2 && (left -= standard_mass(processes_[c], bin)) >= 0) ++c;
  }
  const float sigma = processes_[c].sigma * bins_.density[bin], length = bins_.length[bin];
  const float thickness = sigma * length;
  const float s =
      thickness > 1e-4f ? -std::log1p(u.x() * std::expm1(-thickness)) / sigma : u.x() * length;
  return bins_.start[bin] + std::min(s, length);
}

// By the exponentials that the density has, so that their ratio is right where they underflow.
Color GuidedFlight::transmittance(float t, Sampler& sampler) const {
  if (!space_.medium.homogeneous()) {
    RandomStream random(sampler);
    return space_.medium.transmittance(space_.ray, t, random);
  }
  Color result = Color::Constant(exponential_transmittance(bins_.sigma[0], t));
  for (int c = 1; c < process_count_; ++c) result[c] = exponential_transmittance(bins_.sigma[c], t);
  return result;
}

// The bin where the flight ends, or -1 where it passes. What rounding leaves is the last one's.
int GuidedFlight::choose(float u) const {
  int chosen = -1;
  float left = u - pass_;
  for (int i = 0; i < bins_.count && left >= 0; ++i) {
    const float prob = mass_[i] * factor(i);
    left -= prob;
    if (prob > 0) chosen = i;
  }
  return chosen;
}

Flight GuidedFlight::scatter(float t, float pdf, Sampler& sampler) const {
  const MediumCoefficients here = space_.medium.at(space_.ray(t));
  if (!(pdf > 0)) return {t, true, Color::Zero(), here};  // nothing is seen through so much
  return {t, true, transmittance(t, sampler) * here.sigma_t / pdf, here};
}

Flight GuidedFlight::sample(Sampler& sampler) const {
  const float choice = sampler.next() - aimed_share();
  const Vec2 u = sampler.next_2d();
  if (choice < 0) {
    const float t = near_light_.sample(u.x());
    return scatter(t, pdf(t), sampler);
  }
  const int bin = choose(choice);
  if (bin < 0) return {space_.t_max, false, transmittance(space_.t_max, sampler) / pass_, {}};
  const float t = place(bin, u);
  return scatter(t, pdf_in(bin, t) + aimed_share() * near_light_.pdf(t), sampler);
}

float GuidedFlight::pdf(float t) const {
  const int bin = bins_.find(t);
  return (bin < 0 ? 0 : pdf_in(bin, t)) + aimed_share() * near_light_.pdf(t);
}

}  // namespace waylight
