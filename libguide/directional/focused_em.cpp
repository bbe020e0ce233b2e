#include "libguide/directional/focused_em.h"

#include "libguide/directional/vmf.h"
#include "libguide/directional/vmf_em_step.h"

namespace waylight {
namespace {

// Nats that one inverse distance has to gain.
constexpr float kLeastGain = 3;

// The nearest focus, in radii of the cell: foci within it make no lobe.
constexpr float kNearest = 1.4f;

// Directions so far off a lobe's axis say nothing of its focus.
constexpr float kLeastCosine = 0.1f;

constexpr float kTiny = 1e-30f;

Lanes dot(const LaneVectors& a, const LaneVectors& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
LaneVectors operator-(const LaneVectors& a, const LaneVectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
LaneVectors operator+(const LaneVectors& a, const LaneVectors& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
LaneVectors operator*(Lanes s, const LaneVectors& v) { return {s * v.x, s * v.y, s * v.z}; }
LaneVectors splat(const Vec3& v) {
  return {waylight::splat(v.x()), waylight::splat(v.y()), waylight::splat(v.z())};
}

std::vector<WeightedDirection> directions_of(std::span<const PlacedDirection> photons) {
  std::vector<WeightedDirection> directions;
  for (const PlacedDirection& p : photons) directions.push_back({p.direction, p.weight});
  return directions;
}

}  // namespace

FocusedEm::FocusedEm(std::span<const PlacedDirection> photons, std::span<const VmfComponent> start,
                     const VmfPrior& prior)
    : prior_(prior), count_(static_cast<int>(start.size())) {
  take(photons);
  for (int k = 0; k < count_; ++k) {
    weight_[k] = start[k].weight;
    kappa_[k] = std::min(start[k].kappa, kMaxKappa);
    mean_.x[k] = start[k].mean.x(), mean_.y[k] = start[k].mean.y(), mean_.z[k] = start[k].mean.z();
  }
}

// Places are kept from their mean: lanes are floats.
void FocusedEm::take(std::span<const PlacedDirection> photons) {
  const std::vector<WeightedDirection> directions = directions_of(photons);
  const BatchWeights weights = scan_weights(directions, kMaxTrainingWeight);
  samples_ = weights.effective;
  for (size_t i = 0; i < photons.size(); ++i) {
    if (!valid_direction(directions[i])) continue;
    const float weight = std::min(photons[i].weight, weights.cap) * weights.scale / weights.used;
    points_.push_back({photons[i].position, photons[i].direction, weight});
    origin_ += weight * photons[i].position;
  }
  float spread2 = 0;
  for (Point& p : points_) {
    p.position -= origin_;
    spread2 += p.weight * p.position.squaredNorm();
  }
  spread_ = std::sqrt(3 * spread2);
  shares_.resize(points_.size());
}

Lanes FocusedEm::densities(const Point& point) const {
  const LaneVectors towards = mean_ - inverse_distance_ * (splat(point.position) - centre_);
  const Lanes length2 = dot(towards, towards) + kTiny;  // a lane without a lobe has none
  const Lanes kappa = lanes_min(kappa_ * length2, waylight::splat(kMaxKappa));
  const LaneVectors off = (1 / lanes_sqrt(length2)) * towards - splat(point.direction);
  return weight_ * lanes_vmf_norm(kappa) * exp2_clamped((-0.5f * kLog2E) * kappa * dot(off, off));
}

void FocusedEm::share_out() {
  support_ = Lanes{};
  for (size_t i = 0; i < points_.size(); ++i) {
    const Lanes densities = this->densities(points_[i]);
    shares_[i] = (points_[i].weight / (lanes_sum(densities) + kTiny)) * densities;
    support_ += shares_[i];
  }
}

double FocusedEm::log_likelihood() const {
  double sum = 0;
  for (const Point& p : points_) sum += p.weight * std::log(lanes_sum(densities(p)) + kTiny);
  return samples_ * sum;
}

void FocusedEm::move_centres() {
  LaneVectors sum;
  for (size_t i = 0; i < points_.size(); ++i) sum = sum + shares_[i] * splat(points_[i].position);
  const LaneVectors centre = (1 / (support_ + kTiny)) * sum;
  const LaneVectors towards = mean_ - inverse_distance_ * (centre - centre_);
  const Lanes inverse_length = 1 / lanes_sqrt(dot(towards, towards) + kTiny);
  mean_ = inverse_length * towards;
  inverse_distance_ *= inverse_length;
  centre_ = centre;
}

// In the plane across the axis, at distance one, directions move by -inverse_distance times the
// places: a regression through the centre, with what places along the axis change.
void FocusedEm::find_foci() {
  Lanes products{}, squares{};
  for (size_t i = 0; i < points_.size(); ++i) {
    const LaneVectors direction = splat(points_[i].direction);
    const LaneVectors place = splat(points_[i].position) - centre_;
    const Lanes cosine = dot(direction, mean_), along = dot(place, mean_);
    const LaneVectors across = place - along * mean_;
    const Lanes counts = cosine > kLeastCosine ? shares_[i] : Lanes{};
    const LaneVectors moved = (1 / lanes_max(cosine, waylight::splat(kLeastCosine))) * direction;
    products -= counts * (1 - inverse_distance_ * along) * dot(moved - mean_, across);
    squares += counts * dot(across, across);
  }
  squares += kTiny;
  const Lanes gain = static_cast<float>(0.5 * samples_) * kappa_ * products * products / squares;
  const Lanes inverse_distance =
      lanes_min(products / squares, waylight::splat(1 / (kNearest * spread_ + kTiny)));
  inverse_distance_ = ((gain > kLeastGain) & (products > 0)) ? inverse_distance : Lanes{};
}

// Where the light of a photon would come from at the centre: from the point of its ray that is as
// far away as the focus.
LaneVectors FocusedEm::at_centre(const Point& point) const {
  const LaneVectors offset = inverse_distance_ * (splat(point.position) - centre_);
  const LaneVectors towards = mean_ - offset;
  const LaneVectors seen = lanes_sqrt(dot(towards, towards)) * splat(point.direction) + offset;
  return (1 / lanes_sqrt(dot(seen, seen) + kTiny)) * seen;
}

void FocusedEm::fit_lobes() {
  LaneVectors sum;
  for (size_t i = 0; i < points_.size(); ++i) sum = sum + shares_[i] * at_centre(points_[i]);
  const float n = std::max(static_cast<float>(samples_), 1.0f);
  for (int k = 0; k < count_; ++k) {
    VmfStatistics statistics{support_[k], {sum.x[k], sum.y[k], sum.z[k]}};
    VmfComponent lobe;
    weight_[k] = 0;
    if (maximization({&statistics, 1}, n, prior_, {&lobe, 1}) == 0) continue;
    weight_[k] = support_[k];
    kappa_[k] = lobe.kappa;
    mean_.x[k] = lobe.mean.x(), mean_.y[k] = lobe.mean.y(), mean_.z[k] = lobe.mean.z();
  }
}

void FocusedEm::iterate(int iterations, bool with_foci) {
  for (int i = 0; i < iterations; ++i) {
    share_out();
    move_centres();
    if (with_foci) find_foci();
    fit_lobes();
  }
}

int FocusedEm::foci() const { return lanes_count((weight_ > 0) & (inverse_distance_ > 0)); }

std::vector<FocusedLobe> FocusedEm::lobes(float far) const {
  constexpr float kLeastKappa = 1e-4f;
  std::vector<FocusedLobe> result;
  for (int k = 0; k < count_; ++k) {
    if (!(weight_[k] > 0)) continue;
    const float distance = std::min(1 / inverse_distance_[k], far);
    const Vec3 centre(centre_.x[k], centre_.y[k], centre_.z[k]);
    const Vec3 mean(mean_.x[k], mean_.y[k], mean_.z[k]);
    result.push_back({weight_[k], origin_ + centre + distance * mean,
                      distance / std::sqrt(std::max(kappa_[k], kLeastKappa))});
  }
  return result;
}

}  // namespace waylight
