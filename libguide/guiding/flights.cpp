#include "libguide/guiding/flights.h"

#include "libguide/guiding/biased_flight.h"
#include "libguide/guiding/equiangular_flight.h"
#include "libguide/guiding/guided_flight.h"
#include "libguide/guiding/probability_flight.h"
#include "libguide/guiding/tracked_flight.h"

namespace waylight {
namespace {

Flight standard_flight(const FlightSpace& space, Sampler& sampler) {
  return space.medium.fly(space.ray, space.t_max, space.channels, sampler);
}

Flight equiangular_flight(const Scene& scene, const FlightSpace& space, Sampler& sampler) {
  const std::optional<Vec3> light = light_point(scene, space, sampler);
  return light ? EquiangularFlight(space, *light).sample(sampler) : standard_flight(space, sampler);
}

// Where emitters add little, finding one costs more than it saves.
Flight guided_flight(const Scene& scene, const FlightSpace& space, const FlightOptions& options,
                     Sampler& sampler) {
  constexpr float kWorthAiming = 0.02f;
  GuidedFlight flight(space, options);
  if (flight.from_emitters() > kWorthAiming)
    if (const std::optional<Vec3> light = light_point(scene, space, sampler)) flight.aim_at(*light);
  return flight.sample(sampler);
}

}  // namespace

Flight sample_flight(FlightMethod method, const Scene& scene, const FlightSpace& space,
                     const FlightOptions& options, Sampler& sampler) {
  switch (method) {
    case FlightMethod::guided:
      return space.medium.homogeneous() ? guided_flight(scene, space, options, sampler)
                                        : TrackedFlight(space, options).sample(sampler);
    case FlightMethod::probability:
      return ProbabilityFlight(space, options).sample(sampler);
    case FlightMethod::equiangular:
      return equiangular_flight(scene, space, sampler);
    case FlightMethod::exponential:
      return BiasedFlight(space, options).sample(sampler);
    case FlightMethod::standard:
      break;
  }
  return standard_flight(space, sampler);
}

}  // namespace waylight
