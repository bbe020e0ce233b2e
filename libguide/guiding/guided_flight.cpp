#include "libguide/guiding/guided_flight.h"

#include <memory>

namespace waylight {
namespace {

constexpr int kMaxBins = 96;
constexpr float kFaint = 1e-6f;  // share of light that is left where bins are no longer told apart

// What the ray has in one block of extinction and one cell of the cache.
struct Bin {
  float t0 = 0, t1 = 0;
  Color sigma = Color::Zero();     // what the processes go by
  float source = 0;                // albedo Li
  Color standard = Color::Zero();  // mass of the standard process here, by channel
  Color scatter = Color::Zero();   // and of the mixture of both

  float length() const { return t1 - t0; }
  // Density of the place s behind t0, given that a process of each channel scatters here.
  Color place_pdf(float s) const {
    const Color depth = sigma * length();
    return (depth > 1e-4f)
        .select(sigma * (-sigma * s).exp() / (1 - (-depth).exp()), Color::Constant(1 / length()));
  }
  float pdf(float t) const { return (scatter * place_pdf(t - t0)).sum(); }
  void append(const Bin& bin) {
    const float both = bin.t1 - t0;
    sigma = (sigma * length() + bin.sigma * bin.length()) / both;
    t1 = bin.t1;
  }
};

// 1 - e^-x; media of one colour are the rule, and one exponential is then enough.
Color attenuated_share(const Color& x) {
  if (x[0] == x[1] && x[1] == x[2]) return Color::Constant(1 - std::exp(-x[0]));
  return 1 - (-x).exp();
}

// Walks the bins of a flight: what blocks of extinction and cells of the cache have in common.
class BinWalk {
 public:
  explicit BinWalk(const FlightSpace& space)
      : space_(space),
        blocks_(space.medium.walk(space.ray, std::min(space.t_max, kFar))),
        cells_(space.guides.walk(space.ray, std::min(space.t_max, kFar))) {}

  // False at the end. A cell that is not known takes after the one before.
  bool next(Bin& bin) {
    do {
      if (t_ >= block_.t1) {
        if (!blocks_.next(block_)) return false;
        t_ = block_.t0;
      }
      while (cell_.t1 <= t_)
        if (!cells_.next(cell_)) return false;
      bin.t0 = t_;
      bin.t1 = t_ = std::min(block_.t1, cell_.t1);
    } while (!(bin.t1 > bin.t0));
    const MediumCoefficients here = space_.medium.at(space_.ray(bin.t0));
    bin.sigma = space_.medium.homogeneous() ? here.sigma_t : Color::Constant(block_.mean);
    const float known = space_.guides.scattered(space_.index, cell_.cell, looking_);
    if (known >= 0) scattered_ = known;
    bin.source = luminance(here.albedo) * scattered_;
    return true;
  }
  // Radiance that the last cell sees along the ray.
  float end_radiance() const {
    const MediumGuide& guide = space_.guides.guide(space_.index, cell_.cell);
    return guide.known() ? guide.incident(space_.ray.direction, space_.with_direct) : scattered_;
  }

 private:
  const FlightSpace& space_;
  int looking_ = ScatteredBins::of(space_.ray.direction);
  BlockWalk blocks_;
  RayBlock block_;
  LeafWalk cells_;
  LeafSpan cell_;
  float t_ = 0;
  float scattered_ = 0;  // Li where it was known last
};

}  // namespace

// All bins of a flight, with their masses.
struct GuidedFlight::Plan {
  Plan(const FlightSpace& space, float standard_share) {
    BinWalk walk(space);
    for (Bin bin; walk.next(bin);) add(bin, space.channels);
    weigh(space.channels, standard_share, walk.end_radiance());
  }

  int count = 0;
  union {  // not initialised: the first `count` are set
    std::array<Bin, kMaxBins> bins;
  };
  Color pass = Color::Zero();

 private:
  void add(const Bin& bin, const Color& channels) {
    const bool faint = (left * channels).sum() < kFaint;
    if (count == kMaxBins || (faint && count > 0))
      bins[count - 1].append(bin);
    else
      std::construct_at(&bins[count++], bin);
    if (!faint) left *= 1 - attenuated_share(bin.sigma * bin.length());
  }

  void weigh(const Color& channels, float share, float end_radiance) {
    Color mass = channels;
    float sum = 0;
    for (int i = 0; i < count; ++i) {
      bins[i].standard = mass * attenuated_share(bins[i].sigma * bins[i].length());
      mass -= bins[i].standard;
      sum += bins[i].source * bins[i].standard.sum();
    }
    sum += end_radiance * mass.sum();
    const bool knows = sum > 0 && std::isfinite(sum);
    const float standard = knows ? share : 1.0f, guided = knows ? (1 - share) / sum : 0.0f;
    for (int i = 0; i < count; ++i)
      bins[i].scatter = bins[i].standard * (standard + guided * bins[i].source);
    pass = mass * (standard + guided * end_radiance);
  }

  Color left = Color::Ones();
};

namespace {

// By the truncated exponential of one channel, chosen by its share of the bin's mass.
float place_in(const Bin& bin, float u, float u_channel) {
  const Color& mass = bin.scatter;
  float left = u_channel * mass.sum();
  int channel = 0;
  while (channel < 2 && left >= mass[channel]) left -= mass[channel++];
  const float length = bin.t1 - bin.t0, depth = bin.sigma[channel] * length;
  if (!(depth > 1e-4f)) return bin.t0 + u * length;
  const float s = -std::log1p(u * std::expm1(-depth)) / bin.sigma[channel];
  return std::min(bin.t0 + s, bin.t1);
}

}  // namespace

Flight GuidedFlight::sample(Sampler& sampler) const {
  double left = sampler.next();
  const Vec2 u = sampler.next_2d();
  RandomStream random(sampler);
  const Plan plan(space_, options_.standard_share);
  for (int i = 0; i < plan.count; ++i) {
    const Bin& bin = plan.bins[i];
    left -= bin.scatter.sum();
    if (left >= 0) continue;
    const float t = place_in(bin, u.x(), u.y());
    const MediumCoefficients here = space_.medium.at(space_.ray(t));
    const Color transmittance = space_.medium.transmittance(space_.ray, t, random);
    return {t, true, transmittance * here.sigma_t / bin.pdf(t), here};
  }
  const Color transmittance = space_.medium.transmittance(space_.ray, space_.t_max, random);
  return {space_.t_max, false, transmittance / plan.pass.sum(), {}};
}

float GuidedFlight::pdf(float t) const {
  const Plan plan(space_, options_.standard_share);
  for (int i = 0; i < plan.count; ++i)
    if (t >= plan.bins[i].t0 && t < plan.bins[i].t1) return plan.bins[i].pdf(t);
  return 0;
}

float GuidedFlight::pass_prob() const { return Plan(space_, options_.standard_share).pass.sum(); }

}  // namespace waylight
