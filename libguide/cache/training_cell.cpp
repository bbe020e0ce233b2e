#include "libguide/cache/training_cell.h"

#include <algorithm>
#include <cmath>

#include "libguide/cache/cell_moments.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/cache/mixture_growth.h"
#include "libguide/directional/em_step.h"
#include "libguide/directional/frame_carry.h"
#include "libguide/directional/mixture_refit.h"
#include "libguide/math/frame.h"
#include "libguide/math/warp.h"

namespace waylight {
namespace {

// The frame of a cell follows the mean normal of its photons once it is off by more than 5 degrees
// and the photons agree about it: where they do not, it would only wander.
constexpr float kTurnCosine = 0.9962f, kTurnAgreement = 0.5f;

// Photons before the area of a cell is its own: that of n photons has a relative standard deviation
// of about 1 / sqrt(n).
constexpr float kOwnAreaPhotons = 32;

// Photons that tell on which side of a surface a new cell lies.
constexpr float kOwnSidePhotons = 8;

// Photons that tell how far a cell reaches: no further than their box (of all but strays) and a
// share of its radius, and than so many standard deviations from their mean and a little, since
// surfaces are flat.
constexpr uint32_t kOwnExtentPhotons = 64;
constexpr float kRoom = 0.25f, kDeviations = 3, kThickness = 0.01f;

// Photons that a mixture is fitted to again, at least, and at least this share of those that it has
// learned from, what it inherited included: a cell in the dark keeps what its parent knew.
constexpr int kRefitPhotons = 64;
constexpr double kRefitShare = 0.5;

// Then what was learned on the way, from photons of a larger place, counts for as much as the
// photons that it was fitted to are not, and for so much at least: without it the trimmed relMSE of
// the interior scene is 5 % higher, with a half 2 %.
constexpr double kLearnedShare = 0.3;

// Of photons as CellTraining has it, W; of what camera paths found, W/m^2.
float weight_of(const Photon& photon, float emitted) {
  const float power = luminance(photon.power);
  return photon.from == TracedFrom::lights ? power * emitted : power;
}

// The half of a box that a child has; flat where the box, which leaves out strays, ends before the
// split.
Bounds half_of(Bounds box, const CellSplit& split, bool upper) {
  float& inner = upper ? box.min[split.axis] : box.max[split.axis];
  float& outer = upper ? box.max[split.axis] : box.min[split.axis];
  inner = split.value;
  outer = upper ? std::max(outer, inner) : std::min(outer, inner);
  return box;
}

bool drops(const Photon& photon, const CellTrainingOptions& options) {
  return options.drop_direct && photon.path_depth == 0;
}

}  // namespace

std::vector<GaussianComponent> GaussianLobes::fit(std::span<const WeightedPoint> batch, int count,
                                                  const MixturePrior& prior) {
  EmOptions em;
  em.components = count;
  em.max_iterations = 16;
  em.prior = prior;
  return fit_mixture(batch, em).components;
}

StepwiseResult GaussianLobes::update(std::span<GaussianComponent> components,
                                     std::span<ComponentStatistics> statistics, float& step,
                                     std::span<const WeightedPoint> batch, float samples,
                                     const MixturePrior& prior) {
  return stepwise_update(components, statistics, step, batch, samples, prior);
}

size_t GaussianLobes::grow(std::span<GaussianComponent> components,
                           std::span<ComponentStatistics> statistics, size_t count, size_t wanted) {
  return grow_mixture(components, statistics, count, wanted);
}

size_t TrainingCell::absorb(std::span<const Photon> block, std::span<const uint32_t> indices,
                            float emitted, const CellTrainingOptions& options) {
  locate(block, indices, emitted, options);
  if (on_other_side()) forget();
  size_t capped = 0;
  for (uint32_t i : indices) {
    const Photon& photon = block[i];
    if (!guides(photon, options)) continue;
    const float factor = options.mixes ? evidence_.factor(photon.from) : 1;
    if (wait(photon.direction, weight_of(photon, emitted) * factor)) capped += update(options);
  }
  return capped;
}

// Where the light of the cell is, and how much.
void TrainingCell::locate(std::span<const Photon> block, std::span<const uint32_t> indices,
                          float emitted, const CellTrainingOptions& options) {
  MomentBatch moments(training_, block[indices.front()]);
  for (uint32_t i : indices) {
    const Photon& photon = block[i];
    const float weight = weight_of(photon, emitted);
    const bool guided = weight > 0 && !drops(photon, options);
    if (options.mixes) evidence_.add(photon, weight, guided);
    const bool from_lights = photon.from == TracedFrom::lights;
    if (!from_lights && !guided) continue;
    moments.add(photon, from_lights ? weight : 0);
    own_.add(photon.position);
  }
  moments.merge_into(training_);
}

// A child may lie on the other side of the wall that its parent knew.
bool TrainingCell::on_other_side() const {
  return training_.step > 0 && training_.count >= kOwnSidePhotons &&
         training_.normal_mean.norm() > kTurnAgreement &&
         mean_normal(training_, record_.normal).dot(record_.normal) < kMinNormalCosine;
}

size_t TrainingCell::flush(const CellTrainingOptions& options) {
  keep_components(options.components);
  return enough_wait() ? update(options) : 0;
}

bool TrainingCell::guides(const Photon& photon, const CellTrainingOptions& options) const {
  if (drops(photon, options) || !(luminance(photon.power) > 0)) return false;
  return training_.step == 0 || photon.normal.dot(record_.normal) >= kMinNormalCosine;
}

std::optional<WeightedPoint> TrainingCell::point_of(const Photon& photon, float emitted,
                                                    const CellTrainingOptions& options) const {
  if (training_.step == 0 || !guides(photon, options)) return std::nullopt;
  const float factor = options.mixes ? evidence_.factor(photon.from) : 1;
  return WeightedPoint{direction_to_disk(Frame(record_.normal).to_local(photon.direction)),
                       weight_of(photon, emitted) * factor};
}

bool TrainingCell::refit(const PhotonSample<WeightedPoint>& photons,
                         const CellTrainingOptions& options) {
  const std::vector<WeightedPoint>& kept = photons.kept();
  const double old = options.old_share * record_.photon_count, learned = record_.photon_count - old;
  const BatchWeights weights = scan_weights(kept, kMaxTrainingWeight);
  if (weights.used < kRefitPhotons || photons.seen() < kRefitShare * learned) return false;
  const double fitted = static_cast<double>(kept.size()) / (photons.seen() + old);
  const double share = std::max(kLearnedShare, 1 - fitted);
  replace_mixture(refit_mixture(kept, components(), options.components, options.prior,
                                static_cast<float>(share)));
  const double sum = weights.used / weights.scale, per_kept = photons.seen() / kept.size();
  state_evidence(photons.seen(), per_kept * sum, per_kept * sum * sum / weights.effective, old);
  return true;
}

size_t TrainingCell::update(const CellTrainingOptions& options) {
  turn_to_photons();
  Batch batch;
  return learn(batch_on_disk(batch), options);
}

// Carrying the components over and starting the statistics anew from them is exact up to the
// first-order map of the covariance: the next M-step gives the same components again but for the
// prior.
void TrainingCell::turn_to_photons() {
  const Vec3 normal = mean_normal(training_, record_.normal);
  if (training_.step > 0 &&
      (training_.normal_mean.norm() < kTurnAgreement || normal.dot(record_.normal) > kTurnCosine))
    return;
  turn_to(normal);
}

void TrainingCell::turn_to(const Vec3& normal) {
  const Frame from(record_.normal), to(normal);
  Mat3 rotation;
  for (int i = 0; i < 3; ++i) rotation.col(i) = to.to_local(from.to_world(Vec3::Unit(i)));
  for (uint32_t k = 0; k < record_.component_count; ++k) {
    components_[k] = carry(components_[k], rotation);
    statistics_[k] = statistics_of(components_[k]);
  }
  record_.normal = normal;
}

// Areas add up better than the area of all photons follows from their covariance; later photons
// take it from there. So the flux is restated for the area that irradiance() will take.
void TrainingCell::unite(const TrainingCell& sibling, const CellReach& reach, double now,
                         double min_area) {
  const double both = area(min_area) + sibling.area(min_area);
  const double exposures = exposure(now, min_area) + sibling.exposure(now, min_area);
  inherited_ = extent();
  inherited_.extend(sibling.extent());
  own_ = {};
  made_with_ = reach;
  add_moments(training_, sibling.training_);
  training_.inherited_area = static_cast<float>(both);
  training_.flux =
      (training_.flux + sibling.training_.flux) * (both > 0 ? area(min_area) / both : 1);
  training_.born = std::clamp(now - (both > 0 ? exposures / both : 0), 0.0, now);
  evidence_.add(sibling.evidence_);
  add_evidence(sibling);
}

void TrainingCell::take_mixture(std::span<const GaussianComponent> mixture) {
  replace_mixture(mixture);
}

double TrainingCell::irradiance_samples() const {
  const double share =
      record_.photon_count > 0 ? record_.effective_samples / record_.photon_count : 1;
  return (training_.count + kInheritedPhotons) * std::min(share, 1.0);
}

std::span<WeightedPoint> TrainingCell::batch_on_disk(Batch& batch) const {
  const Frame frame(record_.normal);
  const std::span<const Pending> photons = pending();
  for (size_t i = 0; i < photons.size(); ++i)
    batch[i] = {direction_to_disk(frame.to_local(photons[i].direction)), photons[i].weight};
  return std::span(batch).first(photons.size());
}

TrainingCell TrainingCell::child(const CellSplit& split, bool upper, double now, double min_area,
                                 const CellTrainingOptions& options) const {
  TrainingCell child;
  child.record_.normal = record_.normal;
  child.training_.position_mean = training_.position_mean;  // until it has photons
  child.training_.born = now;
  child.training_.inherited_area = static_cast<float>(std::max(photon_area(training_), min_area));
  child.inherited_ = extent();
  if (split.by_normal()) return child;
  child.inherited_ = half_of(extent(), split, upper);
  inherit_irradiance(child.training_, now, min_area);
  child.evidence_ = evidence_.share(std::min(0.5, kInheritedPhotons / training_.count));
  child.inherit_as_child(*this, upper, options);
  return child;
}

Bounds TrainingCell::extent() const {
  if (own_.count() >= kOwnExtentPhotons) return own_.box();
  return inherited_;
}

// Where most photons of a cell lie in front of a wall and more than two stray ones behind it, their
// box goes through the wall, but their standard deviations hardly do. These are of the photons of
// earlier streams too: where those lie elsewhere, nothing but the box tells where the new ones are.
CellReach TrainingCell::reach() const {
  const bool by_own = own_.count() >= kOwnExtentPhotons;
  if (made_with_ && !by_own) return *made_with_;
  const Bounds box = extent();
  if (box.empty()) return {};
  const Vec3 room = Vec3::Constant(kRoom * box.radius());
  const CellReach whole{box.min - room, box.max + room};
  if (!by_own) return whole;
  const Vec3 spread = kDeviations * (training_.position_m2 / training_.count).cwiseSqrt() +
                      Vec3::Constant(kThickness * box.radius());
  const CellReach reach{whole.min.cwiseMax(training_.position_mean - spread),
                        whole.max.cwiseMin(training_.position_mean + spread)};
  return (reach.min.array() <= reach.max.array()).all() ? reach : whole;
}

Bounds TrainingCell::lit() const {
  const Bounds box = extent();
  const CellReach within = reach();
  return {box.min.cwiseMax(within.min), box.max.cwiseMin(within.max)};
}

void TrainingCell::inherit_mixture(const TrainingCell& from, float share) {
  record_.normal = from.record_.normal;
  inherit(from, share);
}

// As if the child had seen kInheritedPhotons of its half of the parent's photons: where it is dark
// and the rest of the parent is not, the time without photons soon outweighs them.
void TrainingCell::inherit_irradiance(CellTraining& child, double now, double min_area) const {
  child.inherited_area *= 0.5f;
  const double photons_of_all = (now - training_.born) / training_.count;  // per photon of the cell
  const double exposure = 2 * kInheritedPhotons * photons_of_all;
  child.flux = photon_irradiance(now, min_area) * child.inherited_area * exposure;
  child.born = now - exposure;
}

double TrainingCell::area(double min_area) const {
  const bool own = training_.count >= kOwnAreaPhotons || training_.inherited_area <= 0;
  return std::max(own ? photon_area(training_) : double{training_.inherited_area}, min_area);
}

double TrainingCell::photon_irradiance(double now, double min_area) const {
  const double spread = exposure(now, min_area);
  return spread > 0 ? training_.flux / spread : 0;
}

void TrainingCell::balance_sources(double now, double min_area, double photons_per_particle) {
  evidence_.balance(photon_irradiance(now, min_area) * photons_per_particle);
}

float TrainingCell::irradiance(double now, double min_area, double photons_per_particle) const {
  const double by_photons = photon_irradiance(now, min_area) * photons_per_particle;
  return evidence_.irradiance(by_photons, photons_per_particle > 0 && now > training_.born);
}

}  // namespace waylight
