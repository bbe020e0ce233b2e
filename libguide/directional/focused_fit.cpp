#include "libguide/directional/focused_fit.h"

#include <algorithm>

#include "libguide/directional/focused_em.h"
#include "libguide/directional/focused_mixture.h"

namespace waylight {
namespace {

constexpr int kIterations = 12;

// What foci have to gain over as many iterations without: nats for each of them [Schwarz 1978], and
// nats of a sample, below which no image would show it.
constexpr double kGainOfFocus = 6, kGainOfSample = 0.03;

constexpr float kFarthest = 1e15f;

}  // namespace

std::vector<FocusedLobe> fit_focused_lobes(std::span<const PlacedDirection> photons,
                                           std::span<const VmfComponent> start,
                                           const VmfPrior& prior, float far) {
  if (start.empty() || start.size() > FocusedMixture::kMaxLobes || !(far <= kFarthest)) return {};
  FocusedEm focused(photons, start, prior);
  focused.iterate(1, true);
  if (focused.foci() == 0) return {};
  focused.iterate(kIterations - 1, true);
  FocusedEm fixed(photons, start, prior);
  fixed.iterate(kIterations, false);
  const double gain = focused.log_likelihood() - fixed.log_likelihood();
  const double least = kGainOfFocus * focused.foci() + kGainOfSample * focused.samples();
  if (focused.foci() == 0 || !(gain > least)) return {};
  std::vector<FocusedLobe> lobes = focused.lobes(far);
  return std::ranges::all_of(lobes, is_focused_lobe) ? lobes : std::vector<FocusedLobe>();
}

}  // namespace waylight
