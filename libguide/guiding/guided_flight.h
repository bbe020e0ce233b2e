#pragma once
// Guided product distance sampling: whether and where a flight through a medium scatters
// [Herholz et al. 2019].

#include "libguide/guiding/equiangular_range.h"
#include "libguide/guiding/flight_bins.h"

namespace waylight {

// The density over distance of one flight. Bins are what the ray has in one block of extinction and
// one cell of the cache. The standard process reaches and scatters in bin i with probability
//   m_i = T(0, t_i) (1 - e^(-s d))
// for extinction s and length d; the guided one with
//   m_i albedo Li / sum,
// Li the radiance scattered towards the camera as the cell of the bin has it. It passes with
// T(0, t_max) L / sum, L the radiance that the last cell sees along the ray. Herholz et al. decide
// bin by bin, against the L of each bin's own cell: then what one cell has too low ends the flight
// in it, and thin media, where light from behind is mostly none, suffer; the sum over the ray needs
// no cell to agree with the others about what is behind. Within a bin, both processes place the
// event by the truncated exponential, so the density is the standard one times a factor that is
// constant in the bin. One process is chosen per flight, and one channel, whose extinction it goes
// by; the density is the sum over them all. So the weight of a flight is at most 1 / standard_share
// times that of the standard process alone, whatever the cache says.
// Cells are too coarse for the light near a lamp, which falls with the square of the distance. So,
// of what emitters send straight to the bins, a share is given to flights spread evenly over the
// angle under which a point of a lamp sees the ray [Kulla, Fajardo 2012]: that angle over pi, next
// to nothing for lamps far away, whose light is the same all over a cell.
// For homogeneous media; in others the mean of the block stands for the extinction, which is exact
// too but puts events where a block is empty: see TrackedFlight.
class GuidedFlight {
 public:
  // space must outlive this.
  GuidedFlight(const FlightSpace& space, const FlightOptions& options);

  Flight sample(Sampler& sampler) const;
  float pdf(float t) const;  // per unit length
  float pass_prob() const { return pass_; }

  // Of all flights, those guided by light straight from emitters, as far as its share in the
  // fluence of cells is that in what they scatter.
  float from_emitters() const { return from_emitters_; }
  // Gives a part of them to the point of a light. Given any one, the flight is unbiased.
  void aim_at(const Vec3& light);

 private:
  // The standard process by the extinction of one channel, or of all where they are equal.
  struct Process {
    float prob, sigma;
  };

  void weigh(float standard_share);
  float standard_mass(const Process& process, int bin) const;
  float factor(int bin) const {
    return standard_ + guided_ * bins_.source[bin] * (1 - aimed_ * bins_.direct[bin]);
  }
  float aimed_share() const { return aimed_ * from_emitters(); }
  float pdf_in(int bin, float t) const;
  int choose(float u) const;
  float place(int bin, const Vec2& u) const;
  Color transmittance(float t, Sampler& sampler) const;
  Flight scatter(float t, float pdf, Sampler& sampler) const;

  const FlightSpace& space_;
  FlightBins bins_;
  int process_count_;
  std::array<Process, 3> processes_;
  float standard_ = 1, guided_ = 0;  // what is added, by the factor, in a bin
  float pass_ = 1;
  float from_emitters_ = 0;
  EquiangularRange near_light_;
  float aimed_ = 0;                   // the part of from_emitters_ that near_light_ has, in [0, 1]
  alignas(32) FlightBins::Row mass_;  // of the standard processes in each bin
};

}  // namespace waylight
