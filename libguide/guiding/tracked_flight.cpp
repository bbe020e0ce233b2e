#include "libguide/guiding/tracked_flight.h"

#include "libguide/medium/faint_roulette.h"
#include "libguide/medium/tentative_collisions.h"

namespace waylight {
namespace {

constexpr float kMinCandidates = 6;  // expected along a ray
constexpr float kFaint = 0.02f;      // share of light below which roulette ends the sweep

// How a flight could end, and how much of it tracking and the guide see in that.
struct Ending {
  Flight flight;  // its weight is by channel, before the division by its probability
  float tracked = 0, guided = 0;
};

// Keeps one of many by weight.
struct Reservoir {
  float total = 0;
  Ending kept;

  void offer(const Ending& ending, float weight, float u) {
    if (!(weight > 0)) return;
    total += weight;
    if (u * total < weight) kept = ending;
  }
};

class Sweep {
 public:
  Sweep(const FlightSpace& space, RandomStream& random)
      : space_(space),
        random_(random),
        t_max_(std::min(space.t_max, kFar)),
        cells_(space.guides.walk(space.ray, t_max_)) {}

  void run() {
    const BlockWalk blocks = space_.medium.walk(space_.ray, t_max_);
    tentative_collisions(blocks, rate_factor(blocks, kMinCandidates), random_.next(), random_,
                         [&](float t, float rate) {
                           consider(t, rate);
                           return goes_on();
                         });
    if (!is_black(left_)) offer({{space_.t_max, false, left_, {}}, mean(left_), 0}, end_radiance());
  }
  const Reservoir& tracked() const { return tracked_; }
  const Reservoir& guided() const { return guided_; }

 private:
  float mean(const Color& c) const { return (space_.channels * c).sum(); }

  void consider(float t, float rate) {
    const MediumCoefficients here = space_.medium.at(space_.ray(t));
    const Color real = (here.sigma_t / rate).min(1.0f), weight = left_ * real;
    left_ *= 1 - real;
    while (cell_.t1 < t && cells_.next(cell_)) {
    }
    const float known = space_.guides.scattered(space_.index, cell_.cell, looking_);
    if (known >= 0) scattered_ = known;
    offer({{t, true, weight, here}, mean(weight), 0}, luminance(here.albedo) * scattered_);
  }
  // The guide sees nothing where no cell has been known yet; tracking does.
  void offer(Ending ending, float radiance) {
    ending.guided = ending.tracked * radiance;
    tracked_.offer(ending, ending.tracked, random_.next());
    guided_.offer(ending, ending.guided, random_.next());
  }
  float end_radiance() {
    const MediumGuide& guide = space_.guides.at(space_.index, space_.ray(t_max_));
    return guide.known() ? guide.incident(space_.ray.direction, space_.with_direct) : scattered_;
  }
  bool goes_on() {
    left_ *= faint_roulette(mean(left_), kFaint, random_);
    return !is_black(left_);
  }

  const FlightSpace& space_;
  RandomStream& random_;
  int looking_ = space_.guides.bins(space_.index).of(space_.ray.direction);
  float t_max_;
  LeafWalk cells_;
  LeafSpan cell_;
  float scattered_ = 0;         // Li where it was known last
  Color left_ = Color::Ones();  // transmittance estimate
  Reservoir tracked_, guided_;
};

}  // namespace

Flight TrackedFlight::sample(Sampler& sampler) const {
  const float u = sampler.next();
  RandomStream random(sampler);
  Sweep sweep(space_, random);
  sweep.run();
  const Reservoir &tracked = sweep.tracked(), &guided = sweep.guided();
  if (!(tracked.total > 0)) return {space_.t_max, false, Color::Zero(), {}};
  const bool knows = guided.total > 0 && std::isfinite(guided.total);
  const float share = knows ? options_.standard_share : 1.0f;
  const Ending& chosen = u < share ? tracked.kept : guided.kept;
  const float prob = share * chosen.tracked / tracked.total +
                     (knows ? (1 - share) * chosen.guided / guided.total : 0.0f);
  Flight flight = chosen.flight;
  flight.weight /= prob;
  return flight;
}

}  // namespace waylight
