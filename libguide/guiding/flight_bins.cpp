#include "libguide/guiding/flight_bins.h"

namespace waylight {
namespace {

constexpr float kRounding = 1e-6f;  // of the ends of bins
constexpr float kFaintDepth = 14;   // e^-14 of the light is left: a millionth

struct Stretch {
  float t0 = 0, t1 = 0, density = 0;
  uint32_t cell = 0;
};

// Walks what blocks of extinction and cells of the cache have in common.
class StretchWalk {
 public:
  explicit StretchWalk(const FlightSpace& space)
      : homogeneous_(space.medium.homogeneous()),
        blocks_(space.medium.walk(space.ray, std::min(space.t_max, kFar))),
        cells_(space.guides.walk(space.ray, std::min(space.t_max, kFar))) {}

  // False at the end.
  bool next(Stretch& stretch) {
    do {
      if (t_ >= block_.t1) {
        if (!blocks_.next(block_)) return false;
        t_ = block_.t0;
      }
      while (cell_.t1 <= t_)
        if (!cells_.next(cell_)) return false;
      stretch.t0 = t_;
      stretch.t1 = t_ = std::min(block_.t1, cell_.t1);
    } while (!(stretch.t1 > stretch.t0));
    stretch.density = homogeneous_ ? 1 : block_.mean;
    stretch.cell = cell_.cell;
    return true;
  }

 private:
  bool homogeneous_;
  BlockWalk blocks_;
  RayBlock block_;
  LeafWalk cells_;
  LeafSpan cell_;
  float t_ = 0;
};

}  // namespace

// The cells are found first and read then: so the processor waits for many of them together.
FlightBins::FlightBins(const FlightSpace& space)
    : sigma(space.medium.homogeneous() ? space.medium.at(space.ray.origin).sigma_t
                                       : Color(Color::Ones())) {
  Cells cells;
  lay_out(space, cells);
  look_up(space, cells);
  pad();
}

void FlightBins::lay_out(const FlightSpace& space, Cells& cells) {
  const float faint = kFaintDepth / sigma.minCoeff();
  StretchWalk walk(space);
  for (Stretch next; end_depth < faint && walk.next(next);) {
    const int i = std::min(count, kMax - 1);
    const bool full = i < count;
    start[i] = full ? start[i] : next.t0;
    depth[i] = full ? depth[i] : end_depth;
    end_depth += next.density * (next.t1 - next.t0);
    length[i] = next.t1 - start[i];
    density[i] = full ? (end_depth - depth[i]) / length[i] : next.density;
    cells[i] = next.cell;
    count = i + 1;
  }
  if (count == 0 || end_depth < faint) return;
  length[count - 1] = std::min(space.t_max, kFar) - start[count - 1];
  end_depth = depth_at(count - 1, std::min(space.t_max, kFar));
}

// A cell that is not known takes after the one before.
void FlightBins::look_up(const FlightSpace& space, const Cells& cells) {
  const int looking = space.guides.bins(space.index).of(space.ray.direction);
  float scattered = 0, from_emitters = 0;
  for (int i = 0; i < count; ++i) {
    const float known = space.guides.scattered(space.index, cells[i], looking);
    if (known >= 0) {
      scattered = known;
      from_emitters = space.guides.direct_share(cells[i]);
    }
    source[i] = luminance(space.medium.albedo_at(space.ray(start[i]))) * scattered;
    direct[i] = from_emitters;
  }
  if (count == 0) return;
  const MediumGuide& last = space.guides.at(space.index, space.ray(std::min(space.t_max, kFar)));
  end_radiance = last.known() ? last.incident(space.ray.direction, space.with_direct) : scattered;
}

void FlightBins::pad() {
  for (int i = count; i % kLanes != 0; ++i)
    start[i] = length[i] = density[i] = depth[i] = source[i] = direct[i] = 0;
}

int FlightBins::find(float t) const {
  int i = count - 1;
  while (i >= 0 && t < start[i]) --i;
  return i >= 0 && t <= (start[i] + length[i]) * (1 + kRounding) ? i : -1;
}

}  // namespace waylight
