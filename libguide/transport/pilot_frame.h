#pragma once
// Where a small render before the render looks: the whole film, coarsely.

#include <algorithm>
#include <cmath>

#include "libguide/base/sampler.h"
#include "libguide/scene/camera.h"

namespace waylight {

// The value of places of some mean, as in relMSE.
inline double relative_scale(double mean) { return 1 / std::sqrt(mean * mean + 0.01); }

// A grid of about 16,000 places on the film, or as many as it has pixels, in tiles of 4 x 4. Each
// place is one pixel of the film, another one in every round.
class PilotFrame {
 public:
  static constexpr int kTile = 4;

  PilotFrame(const SensorDescription& sensor, uint64_t seed);

  int places() const { return columns_ * rows_; }
  int tiles() const { return tiles_x_ * ((rows_ + kTile - 1) / kTile); }

  // visit(place) for each of the tile.
  template <typename Visit>
  void for_places(int tile, const Visit& visit) const {
    const int x0 = tile % tiles_x_ * kTile, y0 = tile / tiles_x_ * kTile;
    for (int y = y0; y < std::min(y0 + kTile, rows_); ++y)
      for (int x = x0; x < std::min(x0 + kTile, columns_); ++x) visit(y * columns_ + x);
  }
  // Independent over samples; those of one round share the pixel.
  Sampler sampler(int place, int round, int sample) const;
  Ray ray(int place, int round, Sampler& sampler) const;

 private:
  Camera camera_;
  uint64_t seed_;
  int columns_, rows_, tiles_x_;
};

// The order in which tiles are visited: those of one turn lie far apart, so that a pilot that is
// stopped has seen all of the film.
class FrameTurns {
 public:
  // No more than rounds * tiles, and than so many as can be afforded.
  FrameTurns(int tiles, int per_turn, int rounds, double affordable)
      : tiles_(tiles),
        stride_((tiles + per_turn - 1) / per_turn),
        count_(static_cast<int>(std::min(double(stride_) * rounds, affordable * stride_ / tiles))) {
  }

  int count() const { return count_; }
  int round(int turn) const { return turn / stride_; }
  int tiles(int turn) const { return (tiles_ - turn % stride_ + stride_ - 1) / stride_; }
  int tile(int turn, int i) const { return turn % stride_ + i * stride_; }

 private:
  int tiles_, stride_, count_;
};

}  // namespace waylight
