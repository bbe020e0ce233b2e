#pragma once
// Directions at which a lobe is looked at: for EM, for Ceres, and for judging what they make.

#include <span>
#include <vector>

#include "libguide/directional/expectation_maximization.h"
#include "libguide/fit/lobe_target.h"

namespace waylight {

// Random numbers of one sequence, drawn once: all entries share them. Neighbours in elevation are
// then fitted to points that move with the lobe, and equal lobes get equal fits.
struct UnitPoint {
  float u;
  Vec2 u2;
};
std::vector<UnitPoint> unit_points(uint64_t seed, uint64_t stream, int count);

// A direction on the disk with f (luminance, without the cosine) and the density of what drew it,
// both per steradian.
struct LobePoint {
  Vec2 y;
  float f, pdf;
};

// By the BSDF's own sampler; nothing where it fails. pdf is that of the sampler alone.
std::optional<LobePoint> sample_lobe(const LobeTarget& target, const UnitPoint& u);
// At a given point of the unit disk.
LobePoint evaluate_lobe(const LobeTarget& target, const Vec2& y);

// Eight points in lanes. target is f normalised to integrate to one over the unit disk, area the
// share of the disk that the point stands for, 1 / (count pdf): sums of area * g estimate the
// integral of g over the disk. Points that fill the last row up have no area.
struct LobeRow {
  Lanes x{}, y{}, target{}, area{};
};
// drawn: how many were tried; failures stand for f = 0. Empty where f is zero everywhere.
std::vector<LobeRow> lobe_rows(std::span<const LobePoint> points, int drawn);

}  // namespace waylight
