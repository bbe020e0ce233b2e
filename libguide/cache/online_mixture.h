#pragma once
// A mixture that learns from weighted directions as they come, batch by batch and in bounded
// memory: what cells of surfaces and of media have in common.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "libguide/cache/guide_cache_view.h"
#include "libguide/directional/em_batch.h"
#include "libguide/directional/gaussian_reduction.h"
#include "libguide/directional/vmf_reduction.h"

namespace waylight {

// Photons that one stepwise-EM update takes. Fewer make the step noisy, more make a cell large.
inline constexpr int kBatchSize = 64;

// Most lobes of one mixture in training.
inline constexpr size_t kMaxLobes = 8;

// One component per so many effective samples of a first batch: fewer points than that under a
// lobe fit the noise. With 24 of them held-out photons were less likely, by up to 0.2 nats: lobes
// that only splits add later find the light less well.
inline constexpr float kSamplesPerComponent = 8;

// After a position split the next step has eta = 6^-0.7 = 0.29: ten batches of its own, 640
// photons, leave 15 % of what the parent knew. Of 1 .. 20 none makes held-out photons more likely
// by more than 0.013 nats, in rooms where light varies fast or slowly with the place.
inline constexpr float kInheritedStep = 5;

// What the parent knew of the irradiance or fluence counts like so many photons.
inline constexpr double kInheritedPhotons = 8;

// At most so many components, the most alike of them merged.
inline std::vector<GaussianComponent> merged_to(std::span<const GaussianComponent> components,
                                                int most) {
  return reduce_mixture(components, MergeLimit(0), most).components;
}
inline std::vector<VmfComponent> merged_to(std::span<const VmfComponent> components, int most) {
  return reduce_vmf_mixture(components, MergeLimit(0), most).components;
}

// Lobes: the kind of mixture and the records of it.
//   Record: photon_count, effective_samples, component_count. Training: step, samples, weight_sum,
//   weight_sum2. Point: what EM takes, with a weight. Options: components, prior.
//   fit(batch, count, prior), update(...) as stepwise EM, grow(components, statistics, n, wanted).
template <typename Lobes>
class OnlineMixture {
 public:
  using Component = typename Lobes::Component;
  using Statistics = typename Lobes::Statistics;
  using Point = typename Lobes::Point;
  using Options = typename Lobes::Options;
  using Record = typename Lobes::Record;
  using Training = typename Lobes::Training;

  OnlineMixture() = default;
  // Of a finished training that goes on.
  OnlineMixture(const Record& record, const Training& training,
                std::span<const Component> components, std::span<const Statistics> statistics)
      : record_(record), training_(training), carried_over_(record.photon_count > 0) {
    set_mixture(components, statistics);
  }

  const Record& record() const { return record_; }
  const Training& training() const { return training_; }
  std::span<const Component> components() const {
    return {components_.data(), record_.component_count};
  }
  std::span<const Statistics> statistics() const {
    return {statistics_.data(), record_.component_count};
  }

  // An earlier stream may have left more components than this one is to have.
  void keep_components(int most) {
    if (record_.component_count > static_cast<uint32_t>(most))
      replace_mixture(merged_to(components(), most));
  }

 protected:
  struct Pending {
    Vec3 direction;  // of the world: the frame of a cell may turn before the batch is full
    float weight = 0;
  };
  using Batch = std::array<Point, kBatchSize>;

  // True when the batch is full.
  bool wait(const Vec3& direction, float weight) {
    pending_[pending_count_++] = {direction, weight};
    return pending_count_ == kBatchSize;
  }
  std::span<const Pending> pending() const { return std::span(pending_).first(pending_count_); }

  // At the end of a stream: whether those that wait are enough to learn from.
  bool enough_wait() const {
    return training_.step > 0 ? pending_count_ >= kBatchSize / 2
                              : pending_count_ >= kMinEffectiveSamples;
  }

  // Takes in the batch made of pending(). Returns how many weighed too much.
  size_t learn(std::span<Point> batch, const Options& options);

  // Takes over a mixture; `share` of its evidence, in (0, 1], comes with it.
  void inherit(const OnlineMixture& from, float share);
  // The same as one of the children of a cell that is split: the light is nearly the same, and new
  // photons soon outweigh the old. Of the photons that wait each child takes every other one.
  void inherit_as_child(const OnlineMixture& parent, bool upper, const Options& options);
  void forget();
  // Adds the evidence of a mixture that learned from photons of the same light. One of the two may
  // have seen none of this stream.
  void add_evidence(OnlineMixture other);
  // The evidence becomes that of `photons`, with the sum of their weights and that of the squares,
  // and of `old` of the photons before.
  void state_evidence(double photons, double sum, double sum2, double old);
  // Statistics begin anew from the components: the next M-step gives the same ones again.
  void replace_mixture(std::span<const Component> components);

  Record record_;
  Training training_;
  std::array<Component, kMaxLobes> components_;
  std::array<Statistics, kMaxLobes> statistics_;

 private:
  static int components_for(float effective_samples, const Options& options) {
    const float supported = std::max(effective_samples / kSamplesPerComponent, 1.0f);
    return supported < options.components ? static_cast<int>(supported) : options.components;
  }
  float weight_cap(std::span<const Point> batch) const;
  void begin(std::span<const Point> batch, float effective_samples, const Options& options);
  void step(std::span<const Point> batch, float effective_samples, const Options& options);
  double mean_weight() const { return training_.weight_sum / record_.photon_count; }
  void restate_evidence(double mean_weight);
  void weigh_evidence() {
    const double sum = training_.weight_sum, sum2 = training_.weight_sum2;
    record_.effective_samples = sum2 > 0 ? static_cast<float>(sum * sum / sum2) : 0.0f;
  }
  void set_mixture(std::span<const Component> components, std::span<const Statistics> statistics) {
    record_.component_count = static_cast<uint32_t>(components.size());
    std::copy(components.begin(), components.end(), components_.begin());
    std::copy(statistics.begin(), statistics.end(), statistics_.begin());
  }

  std::array<Pending, kBatchSize> pending_;
  int pending_count_ = 0;
  bool carried_over_ = false;  // the evidence is in weights of an earlier stream
};

// Bounds weights; returns how many were above the bound.
template <typename Point>
size_t cap_weights(std::span<Point> batch, float cap) {
  size_t capped = 0;
  for (Point& point : batch) {
    capped += point.weight > cap;
    point.weight = std::min(point.weight, cap);
  }
  return capped;
}

template <typename Lobes>
size_t OnlineMixture<Lobes>::learn(std::span<Point> batch, const Options& options) {
  const size_t capped = cap_weights(batch, weight_cap(batch));
  double sum = 0, sum2 = 0;
  for (const Point& point : batch) {
    sum += point.weight;
    sum2 += double{point.weight} * point.weight;
  }
  pending_count_ = 0;
  if (!(sum2 > 0)) return capped;  // too dark for their weights to be told from zero
  const float effective_samples = static_cast<float>(sum * sum / sum2);
  keep_components(options.components);
  if (training_.step > 0)
    step(batch, effective_samples, options);
  else
    begin(batch, effective_samples, options);
  if (carried_over_) restate_evidence(sum / static_cast<double>(batch.size()));
  record_.photon_count += static_cast<float>(batch.size());
  training_.weight_sum += sum;
  training_.weight_sum2 += sum2;
  weigh_evidence();
  return capped;
}

// Against the mean of all that the mixture saw, which one batch cannot move far; in the first batch
// against the mean of the batch. Light that fewer than one photon in 32 carries is underestimated
// by it, never lost; without it one firefly owns a first batch.
template <typename Lobes>
float OnlineMixture<Lobes>::weight_cap(std::span<const Point> batch) const {
  if (record_.photon_count == 0 || carried_over_)
    return scan_weights(batch, kMaxTrainingWeight).cap;
  return static_cast<float>(kMaxTrainingWeight * mean_weight());
}

// Guided photons are many and weigh little each, others are few and heavy: in absolute weights a
// few of these would outweigh all evidence to come. EM weighs photons within their batch alone, so
// the evidence of an earlier stream goes on in weights whose mean is that of this one.
template <typename Lobes>
void OnlineMixture<Lobes>::restate_evidence(double mean_weight) {
  carried_over_ = false;
  if (!(training_.weight_sum > 0)) return;
  const double scale = mean_weight * record_.photon_count / training_.weight_sum;
  training_.weight_sum *= scale;
  training_.weight_sum2 *= scale * scale;
}

template <typename Lobes>
void OnlineMixture<Lobes>::begin(std::span<const Point> batch, float effective_samples,
                                 const Options& options) {
  if (effective_samples < kMinEffectiveSamples) return;
  const std::vector<Component> fit =
      Lobes::fit(batch, components_for(effective_samples, options), options.prior);
  if (fit.empty()) return;
  replace_mixture(fit);
  training_.samples = effective_samples;
  training_.step = 1;
}

// A weighted mean of two estimates by n and b samples stands for 1 / ((1-eta)^2 / n + eta^2 / b).
template <typename Lobes>
void OnlineMixture<Lobes>::step(std::span<const Point> batch, float effective_samples,
                                const Options& options) {
  const float eta = std::pow(training_.step + 1, -0.7f);
  training_.samples = 1 / (sqr(1 - eta) / training_.samples + sqr(eta) / effective_samples);
  const size_t count = record_.component_count;
  const StepwiseResult result =
      Lobes::update(std::span(components_).first(count), std::span(statistics_).first(count),
                    training_.step, batch, training_.samples, options.prior);
  record_.component_count = static_cast<uint32_t>(result.count);
}

template <typename Lobes>
void OnlineMixture<Lobes>::inherit(const OnlineMixture& from, float share) {
  record_.photon_count = share * from.record_.photon_count;
  training_.weight_sum = share * from.training_.weight_sum;
  training_.weight_sum2 = share * from.training_.weight_sum2;
  weigh_evidence();
  training_.samples = from.training_.samples;
  training_.step = std::min(from.training_.step, kInheritedStep);
  set_mixture(from.components(), from.statistics());
}

template <typename Lobes>
void OnlineMixture<Lobes>::inherit_as_child(const OnlineMixture& parent, bool upper,
                                            const Options& options) {
  inherit(parent, 0.5f);
  record_.component_count =
      static_cast<uint32_t>(Lobes::grow(components_, statistics_, parent.record_.component_count,
                                        components_for(parent.training_.samples, options)));
  carried_over_ = parent.carried_over_;
  for (int i = upper; i < parent.pending_count_; i += 2)
    pending_[pending_count_++] = parent.pending_[i];
}

template <typename Lobes>
void OnlineMixture<Lobes>::add_evidence(OnlineMixture other) {
  if (!(record_.photon_count > 0)) carried_over_ = other.carried_over_;
  if (other.record_.photon_count > 0 && carried_over_ != other.carried_over_)
    carried_over_ ? restate_evidence(other.mean_weight()) : other.restate_evidence(mean_weight());
  record_.photon_count += other.record_.photon_count;
  training_.weight_sum += other.training_.weight_sum;
  training_.weight_sum2 += other.training_.weight_sum2;
  training_.samples += other.training_.samples;
  training_.step = std::max(training_.step, other.training_.step);
  weigh_evidence();
}

template <typename Lobes>
void OnlineMixture<Lobes>::replace_mixture(std::span<const Component> components) {
  std::vector<Statistics> statistics;
  for (const Component& c : components) statistics.push_back(statistics_of(c));
  set_mixture(components, statistics);
}

template <typename Lobes>
void OnlineMixture<Lobes>::state_evidence(double photons, double sum, double sum2, double old) {
  const double kept = old > 0 ? old / record_.photon_count : 0;
  record_.photon_count = static_cast<float>(photons + old);
  training_.weight_sum = sum + kept * training_.weight_sum;
  training_.weight_sum2 = sum2 + kept * training_.weight_sum2;
  weigh_evidence();
  training_.samples = record_.effective_samples;
  training_.step = std::max(training_.step, record_.photon_count / kBatchSize);
}

template <typename Lobes>
void OnlineMixture<Lobes>::forget() {
  record_.component_count = 0;
  record_.photon_count = 0;
  training_.step = training_.samples = 0;
  training_.weight_sum = training_.weight_sum2 = 0;
  pending_count_ = 0;
  weigh_evidence();
}

}  // namespace waylight
