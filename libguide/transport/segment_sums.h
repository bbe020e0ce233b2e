#pragma once
// What paths contribute to an image, by their number of edges.

#include <array>
#include <cmath>
#include <cstdint>

namespace waylight {

// Index 0 is one edge, an emitter seen by the camera; the last index takes all longer paths.
struct SegmentSums {
  static constexpr int kCount = 64;
  std::array<double, kCount> luminance{};  // sum over samples, filter weights included
  std::array<uint64_t, kCount> reached{};  // edges traced, those of split copies included
  uint64_t samples = 0;

  static int index(int edges) { return (edges < kCount ? edges : kCount) - 1; }
  void add(int edges, float value) {
    if (std::isfinite(value)) luminance[index(edges)] += value;
  }
  void reach(int edges) { ++reached[index(edges)]; }

  void merge(const SegmentSums& other) {
    for (int i = 0; i < kCount; ++i) {
      luminance[i] += other.luminance[i];
      reached[i] += other.reached[i];
    }
    samples += other.samples;
  }
};

}  // namespace waylight
