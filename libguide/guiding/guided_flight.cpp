#include "libguide/guiding/guided_flight.h"

namespace waylight {
namespace {

constexpr float kMaxScatterProb = 0.999f;
constexpr float kFar = 1e30f;  // keeps 0 times infinity out

// The remaining probability of each channel's standard and guided process.
struct Masses {
  Color standard, guided;

  float sum() const { return (standard + guided).sum(); }
};

struct Bin {
  float t0, t1;
  Color sigma;     // what the processes go by
  Masses scatter;  // of the masses that reached the bin

  // Density of the place s behind t0, given that a process of each channel scatters here.
  Color place_pdf(float s) const {
    const Color depth = sigma * (t1 - t0);
    return (depth > 1e-4f)
        .select(sigma * (-sigma * s).exp() / (1 - (-depth).exp()), Color::Constant(1 / (t1 - t0)));
  }
  float pdf(float t) const {
    return ((scatter.standard + scatter.guided) * place_pdf(t - t0)).sum();
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
  BinWalk(const FlightSpace& space, float standard_share)
      : space_(space),
        homogeneous_(space.medium.homogeneous()),
        blocks_(space.medium.walk(space.ray, std::min(space.t_max, kFar))),
        cells_(space.guides.walk(space.ray, std::min(space.t_max, kFar))),
        masses_{standard_share * space.channels, (1 - standard_share) * space.channels} {}

  // False at the end; masses() is then the probability to pass.
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
    bin.sigma = homogeneous_ ? here.sigma_t : Color::Constant(block_.mean);
    scatter(bin, ratio(space_.guides.guide(space_.index, cell_.cell), luminance(here.albedo)));
    return true;
  }
  const Masses& masses() const { return masses_; }

 private:
  // albedo Li / L, or 1 where it is not known.
  float ratio(const MediumGuide& guide, float albedo) const {
    if (!guide.known()) return 1;
    const Vec3& w = space_.ray.direction;
    const float incident = guide.incident(w, space_.with_direct);
    const float ratio = albedo * guide.scattered(w) / incident;
    return std::isfinite(ratio) ? ratio : 1;
  }
  void scatter(Bin& bin, float ratio) {
    const Color standard = attenuated_share(bin.sigma * (bin.t1 - bin.t0));
    const Color guided = (ratio * standard).min(kMaxScatterProb);
    bin.scatter = {masses_.standard * standard, masses_.guided * guided};
    masses_.standard -= bin.scatter.standard;
    masses_.guided -= bin.scatter.guided;
  }

  const FlightSpace& space_;
  bool homogeneous_;
  BlockWalk blocks_;
  RayBlock block_;
  LeafWalk cells_;
  LeafSpan cell_;
  float t_ = 0;
  Masses masses_;
};

// By the truncated exponential of one channel, chosen by its share of the bin's mass.
float place_in(const Bin& bin, float u, float u_channel) {
  const Color mass = bin.scatter.standard + bin.scatter.guided;
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
  BinWalk bins(space_, options_.standard_share);
  for (Bin bin; bins.next(bin);) {
    left -= bin.scatter.sum();
    if (left >= 0) continue;
    const float t = place_in(bin, u.x(), u.y());
    const MediumCoefficients here = space_.medium.at(space_.ray(t));
    const Color transmittance = space_.medium.transmittance(space_.ray, t, random);
    return {t, true, transmittance * here.sigma_t / bin.pdf(t), here};
  }
  const Color transmittance = space_.medium.transmittance(space_.ray, space_.t_max, random);
  return {space_.t_max, false, transmittance / bins.masses().sum(), {}};
}

float GuidedFlight::pdf(float t) const {
  BinWalk bins(space_, options_.standard_share);
  for (Bin bin; bins.next(bin);)
    if (t >= bin.t0 && t < bin.t1) return bin.pdf(t);
  return 0;
}

float GuidedFlight::pass_prob() const {
  BinWalk bins(space_, options_.standard_share);
  for (Bin bin; bins.next(bin);) {
  }
  return bins.masses().sum();
}

}  // namespace waylight
