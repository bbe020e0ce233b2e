#include "libguide/cache/training_cell.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libguide/cache/cell_moments.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/cache/mixture_growth.h"
#include "libguide/directional/em_step.h"
#include "libguide/directional/frame_carry.h"
#include "libguide/math/frame.h"
#include "libguide/math/warp.h"

namespace waylight {
namespace {

// One component per so many effective samples of a first batch: fewer points than that under a
// lobe fit the noise. With 24 of them held-out photons were less likely, by up to 0.2 nats: lobes
// that only splits add later find the light less well.
constexpr float kSamplesPerComponent = 8;

// After a position split the next step has eta = 6^-0.7 = 0.29: ten batches of its own, 640
// photons, leave 15 % of what the parent knew. Of 1 .. 20 none makes held-out photons more likely
// by more than 0.013 nats, in rooms where light varies fast or slowly with the place.
constexpr float kInheritedStep = 5;

// The frame of a cell follows the mean normal of its photons once it is off by more than 5 degrees
// and the photons agree about it: where they do not, it would only wander.
constexpr float kTurnCosine = 0.9962f, kTurnAgreement = 0.5f;

// Photons before the area of a cell is its own: that of n photons has a relative standard deviation
// of about 1 / sqrt(n).
constexpr float kOwnAreaPhotons = 32;

// What the parent knew of the irradiance counts like so many photons.
constexpr double kInheritedPhotons = 8;

// Photons that tell on which side of a surface a new cell lies.
constexpr float kOwnSidePhotons = 8;

int components_for(float effective_samples, const CellTrainingOptions& options) {
  const float supported = std::max(effective_samples / kSamplesPerComponent, 1.0f);
  return supported < options.components ? static_cast<int>(supported) : options.components;
}

float step_size(float step) { return std::pow(step + 1, -0.7f); }

// Bounds weights; returns how many were above the bound.
size_t cap_weights(std::span<WeightedPoint> batch, float cap) {
  size_t capped = 0;
  for (WeightedPoint& point : batch) {
    capped += point.weight > cap;
    point.weight = std::min(point.weight, cap);
  }
  return capped;
}

}  // namespace

TrainingCell::TrainingCell(const CacheCell& cell, const CellTraining& training,
                           std::span<const GaussianComponent> components,
                           std::span<const ComponentStatistics> statistics)
    : cell_(cell), training_(training), carried_over_(cell.photon_count > 0) {
  set_mixture(components, statistics);
}

size_t TrainingCell::absorb(std::span<const Photon> block, std::span<const uint32_t> indices,
                            float emitted, const CellTrainingOptions& options) {
  MomentBatch moments(training_, block[indices.front()]);
  for (uint32_t i : indices) moments.add(block[i], luminance(block[i].power) * emitted);
  moments.merge_into(training_);
  if (on_other_side()) forget_mixture();
  size_t capped = 0;
  for (uint32_t i : indices) {
    if (!guides(block[i], options)) continue;
    pending_[pending_count_++] = {block[i].direction, luminance(block[i].power) * emitted};
    if (pending_count_ == kBatchSize) capped += update(options);
  }
  return capped;
}

// A child may lie on the other side of the wall that its parent knew.
bool TrainingCell::on_other_side() const {
  return training_.step > 0 && training_.count >= kOwnSidePhotons &&
         training_.normal_mean.norm() > kTurnAgreement &&
         mean_normal(training_, cell_.normal).dot(cell_.normal) < kMinNormalCosine;
}

void TrainingCell::forget_mixture() {
  cell_.component_count = 0;
  cell_.photon_count = 0;
  training_.step = training_.samples = 0;
  training_.weight_sum = training_.weight_sum2 = 0;
  pending_count_ = 0;
  weigh_evidence();
}

size_t TrainingCell::flush(const CellTrainingOptions& options) {
  const bool enough = training_.step > 0 ? pending_count_ >= kBatchSize / 2
                                         : pending_count_ >= kMinEffectiveSamples;
  return enough ? update(options) : 0;
}

bool TrainingCell::guides(const Photon& photon, const CellTrainingOptions& options) const {
  if (options.drop_direct && photon.path_depth == 0) return false;
  return training_.step == 0 || photon.normal.dot(cell_.normal) >= kMinNormalCosine;
}

size_t TrainingCell::update(const CellTrainingOptions& options) {
  turn_to_photons();
  Batch storage;
  const std::span<WeightedPoint> batch = batch_on_disk(storage);
  const size_t capped = cap_weights(batch, weight_cap(batch));
  double sum = 0, sum2 = 0;
  for (const WeightedPoint& point : batch) {
    sum += point.weight;
    sum2 += double{point.weight} * point.weight;
  }
  const float effective_samples = static_cast<float>(sum * sum / sum2);
  if (training_.step > 0)
    step(batch, effective_samples, options);
  else
    begin(batch, effective_samples, options);
  if (carried_over_) carry_evidence_over(sum, batch.size());
  cell_.photon_count += static_cast<float>(batch.size());
  training_.weight_sum += sum;
  training_.weight_sum2 += sum2;
  weigh_evidence();
  pending_count_ = 0;
  return capped;
}

// Against the mean of all that the mixture saw, which one batch cannot move far; in the first batch
// against the mean of the batch. Light that fewer than one photon in 32 carries is underestimated
// by it, never lost; without it one firefly owns a first batch.
float TrainingCell::weight_cap(std::span<const WeightedPoint> batch) const {
  if (cell_.photon_count == 0 || carried_over_) return scan_weights(batch, kMaxTrainingWeight).cap;
  const double mean = training_.weight_sum / cell_.photon_count;
  return static_cast<float>(kMaxTrainingWeight * mean);
}

// Guided photons are many and weigh little each, others are few and heavy: in absolute weights a
// few of these would outweigh all evidence to come. EM weighs photons within their batch alone, so
// the evidence of an earlier stream goes on in weights whose mean is that of this one.
void TrainingCell::carry_evidence_over(double sum, size_t photons) {
  carried_over_ = false;
  if (!(training_.weight_sum > 0)) return;
  const double scale =
      sum / static_cast<double>(photons) * cell_.photon_count / training_.weight_sum;
  training_.weight_sum *= scale;
  training_.weight_sum2 *= scale * scale;
}

void TrainingCell::weigh_evidence() {
  const double sum = training_.weight_sum, sum2 = training_.weight_sum2;
  cell_.effective_samples = sum2 > 0 ? static_cast<float>(sum * sum / sum2) : 0.0f;
}

// Carrying the components over and starting the statistics anew from them is exact up to the
// first-order map of the covariance: the next M-step gives the same components again but for the
// prior.
void TrainingCell::turn_to_photons() {
  const Vec3 normal = mean_normal(training_, cell_.normal);
  if (training_.step > 0) {
    if (training_.normal_mean.norm() < kTurnAgreement || normal.dot(cell_.normal) > kTurnCosine)
      return;
    const Frame from(cell_.normal), to(normal);
    Mat3 rotation;
    for (int i = 0; i < 3; ++i) rotation.col(i) = to.to_local(from.to_world(Vec3::Unit(i)));
    for (uint32_t k = 0; k < cell_.component_count; ++k) {
      components_[k] = carry(components_[k], rotation);
      statistics_[k] = statistics_of(components_[k]);
    }
  }
  cell_.normal = normal;
}

std::span<WeightedPoint> TrainingCell::batch_on_disk(Batch& batch) const {
  const Frame frame(cell_.normal);
  for (int i = 0; i < pending_count_; ++i)
    batch[i] = {direction_to_disk(frame.to_local(pending_[i].direction)), pending_[i].weight};
  return std::span(batch).first(pending_count_);
}

void TrainingCell::begin(std::span<const WeightedPoint> batch, float effective_samples,
                         const CellTrainingOptions& options) {
  if (effective_samples < kMinEffectiveSamples) return;
  EmOptions em;
  em.components = components_for(effective_samples, options);
  em.max_iterations = 16;
  em.prior = options.prior;
  const EmResult fit = fit_mixture(batch, em);
  if (fit.components.empty()) return;
  std::vector<ComponentStatistics> statistics;
  for (const GaussianComponent& c : fit.components) statistics.push_back(statistics_of(c));
  set_mixture(fit.components, statistics);
  training_.samples = effective_samples;
  training_.step = 1;
}

// A weighted mean of two estimates by n and b samples stands for 1 / ((1-eta)^2 / n + eta^2 / b).
void TrainingCell::step(std::span<const WeightedPoint> batch, float effective_samples,
                        const CellTrainingOptions& options) {
  const float eta = step_size(training_.step);
  training_.samples = 1 / (sqr(1 - eta) / training_.samples + sqr(eta) / effective_samples);
  const size_t count = cell_.component_count;
  const StepwiseResult result =
      stepwise_update(std::span(components_).first(count), std::span(statistics_).first(count),
                      training_.step, batch, training_.samples, options.prior);
  cell_.component_count = static_cast<uint32_t>(result.count);
}

void TrainingCell::set_mixture(std::span<const GaussianComponent> components,
                               std::span<const ComponentStatistics> statistics) {
  cell_.component_count = static_cast<uint32_t>(components.size());
  std::copy(components.begin(), components.end(), components_.begin());
  std::copy(statistics.begin(), statistics.end(), statistics_.begin());
}

TrainingCell TrainingCell::child(const CellSplit& split, double now, double min_area,
                                 const CellTrainingOptions& options) const {
  TrainingCell child;
  child.cell_.normal = cell_.normal;
  child.training_.born = now;
  child.training_.inherited_area = static_cast<float>(std::max(photon_area(training_), min_area));
  if (split.by_normal()) return child;
  inherit_irradiance(child.training_, now, min_area);
  child.inherit_mixture(*this, 0.5f);
  child.cell_.component_count = static_cast<uint32_t>(
      grow_mixture(child.components_, child.statistics_, cell_.component_count,
                   components_for(training_.samples, options)));
  child.carried_over_ = carried_over_;
  child.pending_ = pending_;
  child.pending_count_ = pending_count_;
  return child;
}

void TrainingCell::inherit_mixture(const TrainingCell& from, float share) {
  cell_.normal = from.cell_.normal;
  cell_.photon_count = share * from.cell_.photon_count;
  training_.weight_sum = share * from.training_.weight_sum;
  training_.weight_sum2 = share * from.training_.weight_sum2;
  weigh_evidence();
  training_.samples = from.training_.samples;
  training_.step = std::min(from.training_.step, kInheritedStep);
  set_mixture(from.components(), from.statistics());
}

// As if the child had seen kInheritedPhotons of its half of the parent's photons: where it is dark
// and the rest of the parent is not, the time without photons soon outweighs them.
void TrainingCell::inherit_irradiance(CellTraining& child, double now, double min_area) const {
  child.inherited_area *= 0.5f;
  const double photons_of_all = (now - training_.born) / training_.count;  // per photon of the cell
  const double exposure = 2 * kInheritedPhotons * photons_of_all;
  child.flux = irradiance(now, min_area) * child.inherited_area * exposure;
  child.born = now - exposure;
}

float TrainingCell::irradiance(double now, double min_area) const {
  const bool own = training_.count >= kOwnAreaPhotons || training_.inherited_area <= 0;
  const double area = own ? photon_area(training_) : training_.inherited_area;
  const double spread = std::max(area, min_area) * (now - training_.born);
  const double limit = std::numeric_limits<float>::max();
  return spread > 0 ? static_cast<float>(std::min(training_.flux / spread, limit)) : 0.0f;
}

}  // namespace waylight
