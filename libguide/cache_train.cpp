#include "libguide/cache_train.h"

#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "libguide/base/error.h"
#include "libguide/base/parallel.h"
#include "libguide/cache/escape_histogram.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/cache/training_check.h"
#include "libguide/cache/training_tree.h"
#include "libguide/spatial/leaf_order.h"

namespace waylight {
namespace {

// Photons are worked off in blocks whose ends depend on their number alone. Cells are split between
// blocks only, so the first blocks are short: a quarter of what came before.
constexpr size_t kMinBlock = 1 << 12, kMaxBlock = 1 << 18;
constexpr size_t kPhotonsPerTask = 1 << 12;

// Positions closer together than this share of the scene's diameter are one place: about the
// resolution of a float coordinate at its far end.
constexpr float kMinExtent = 1e-6f;

// Rounding may leave photons this share of the scene's diameter outside its bounds.
constexpr float kBoundsTolerance = 1e-3f;

size_t block_size(uint64_t photons) {
  return std::clamp<uint64_t>(photons / 4, kMinBlock, kMaxBlock);
}

bool is_unit(const Vec3& v) { return std::abs(v.squaredNorm() - 1) < 1e-2f; }  // false for NaN

Bounds grown(Bounds bounds) {
  const float margin = kBoundsTolerance * 2 * bounds.radius();
  bounds.min.array() -= margin;
  bounds.max.array() += margin;
  return bounds;
}

bool contains(const Bounds& bounds, const Vec3& p) {
  return (p.array() >= bounds.min.array()).all() && (p.array() <= bounds.max.array()).all();
}

// 1e30 leaves room for the sums of a batch.
bool is_valid(const Photon& photon, const Bounds& bounds, float emitted) {
  const float weight = luminance(photon.power) * emitted;
  return weight > 0 && weight < 1e36f && (photon.power >= 0).all() && is_unit(photon.normal) &&
         is_unit(photon.direction) && contains(bounds, photon.position);
}

bool is_valid(const Escape& escape, const Bounds& bounds, float emitted) {
  const float weight = luminance(escape.power) * emitted;
  return weight > 0 && weight < 1e30f && (escape.power >= 0).all() && is_unit(escape.direction) &&
         contains(bounds, escape.origin);
}

void check_previous(const GuideCache& cache, Quantity stream) {
  if (cache.quantity != stream)
    fail("the previous cache holds {} and the stream {}: train each in a cache of its own",
         quantity_name(cache.quantity), quantity_name(stream));
  if (cache.training.size() != cache.cells.size() ||
      cache.statistics.size() != cache.components.size())
    fail(
        "the previous cache has no training statistics: a reduced cache cannot be trained, keep "
        "the unreduced file");
  std::string fault = check(GuideCacheView(cache));
  if (fault.empty()) fault = check_training(cache);
  if (!fault.empty())
    fail("the previous cache is damaged ({}): train from the photons again", fault);
}

}  // namespace

void CacheTrainOptions::validate() const {
  require(components >= 1 && components <= 8, "components is {}: must be 1..8", components);
  require(photons_per_cell >= 64 && photons_per_cell <= 10'000'000,
          "photons_per_cell is {}: must be 64..10000000", photons_per_cell);
  require(max_cells >= 1 && max_cells <= 10'000'000, "max_cells is {}: must be 1..10000000",
          max_cells);
  require(normal_spread > 0 && normal_spread <= 1, "normal_spread is {}: must be in (0, 1]",
          normal_spread);
  require(prior.v >= 1 && std::isfinite(prior.v), "prior.v is {}: must be at least 1", prior.v);
  require(prior.a > 2 && std::isfinite(prior.a), "prior.a is {}: must be above 2", prior.a);
  require(prior.b > 0 && std::isfinite(prior.b), "prior.b is {}: must be positive", prior.b);
}

struct CacheTrainer::Impl {
  Impl(const CacheTrainOptions& options, const PhotonStreamInfo& stream, GuideCache previous);

  void consume(std::span<const Photon> photons);
  void consume(std::span<const Escape> escapes);
  GuideCache finish(CacheTrainSummary* summary);

 private:
  void process_block();
  void find_leaves();
  void absorb_block();
  void flush_cells();
  void summarise(const GuideCache& cache, CacheTrainSummary& summary) const;

  CellTrainingOptions cell_options_;
  TreeOptions tree_options_;
  GuideCache cache_;  // without its cells while they are in training
  TrainingTree tree_;
  Bounds accepted_;
  EscapeMap escape_map_;
  EscapeHistogram escapes_;
  float emitted_;
  size_t cells_before_;
  TrainingClock clock_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  std::vector<Photon> block_;
  std::vector<uint32_t> leaf_;  // of each photon of the block
  LeafOrder order_;
  std::vector<size_t> capped_;  // of each occupied cell
  CacheTrainSummary totals_;
};

CacheTrainer::Impl::Impl(const CacheTrainOptions& options, const PhotonStreamInfo& stream,
                         GuideCache previous)
    : cell_options_{options.components, options.direct == DirectLight::drop, options.prior},
      emitted_(static_cast<float>(stream.emitted)) {
  if (stream.emitted == 0) fail("the photon stream does not say how many particles were emitted");
  if (!previous.nodes.empty()) {
    check_previous(previous, stream.quantity);
    tree_ = TrainingTree(previous);
    escapes_ = EscapeHistogram(previous);
  }
  previous.scene_bounds.extend(stream.scene_bounds);
  if (previous.scene_bounds.empty() || !std::isfinite(previous.scene_bounds.radius()))
    fail("the bounds of the scene in the photon stream are empty or not finite");
  cache_.quantity = stream.quantity;
  cache_.scene_bounds = previous.scene_bounds;
  cache_.emitted = previous.emitted + stream.emitted;
  cache_.passes = previous.passes + 1;
  cache_.photons = previous.photons;
  clock_.photons_before = static_cast<double>(previous.photons);
  clock_.particles_before = static_cast<double>(previous.emitted);
  accepted_ = grown(cache_.scene_bounds);
  escape_map_ = EscapeMap(cache_.scene_bounds);
  tree_options_ = {static_cast<size_t>(options.photons_per_cell),
                   static_cast<size_t>(options.max_cells), options.normal_spread,
                   kMinExtent * 2 * cache_.scene_bounds.radius()};
  cells_before_ = tree_.size();
}

void CacheTrainer::Impl::consume(std::span<const Photon> photons) {
  while (!photons.empty()) {
    const size_t wanted = block_size(cache_.photons) - block_.size();
    const size_t taken = std::min(wanted, photons.size());
    block_.insert(block_.end(), photons.begin(), photons.begin() + taken);
    photons = photons.subspan(taken);
    if (taken == wanted) process_block();
  }
}

void CacheTrainer::Impl::consume(std::span<const Escape> escapes) {
  totals_.escapes += escapes.size();
  for (const Escape& escape : escapes) {
    const bool valid = is_valid(escape, accepted_, emitted_);
    const bool dropped = valid && cell_options_.drop_direct && escape.path_depth == 0;
    totals_.rejected += !valid;
    totals_.dropped_direct += dropped;
    if (valid && !dropped) escapes_.add(escape_map_, escape, emitted_);
  }
}

// Splitting comes first, not last: children made at the end of a stream would have seen nothing.
void CacheTrainer::Impl::process_block() {
  tree_.split_full_cells(tree_options_, cell_options_, static_cast<double>(cache_.photons));
  find_leaves();
  order_.sort(leaf_, tree_.size());
  absorb_block();
  cache_.photons += block_.size();
  totals_.photons += block_.size();
  block_.clear();
}

void CacheTrainer::Impl::find_leaves() {
  leaf_.resize(block_.size());
  const size_t tasks = (block_.size() + kPhotonsPerTask - 1) / kPhotonsPerTask;
  std::vector<size_t> rejected(tasks), direct(tasks);
  parallel_for(tasks, [&](size_t task) {
    const size_t end = std::min(block_.size(), (task + 1) * kPhotonsPerTask);
    for (size_t i = task * kPhotonsPerTask; i < end; ++i) {
      const bool valid = is_valid(block_[i], accepted_, emitted_);
      const bool dropped = valid && cell_options_.drop_direct && block_[i].path_depth == 0;
      const bool counts = valid && !(dropped && cache_.quantity == Quantity::importance);
      leaf_[i] = counts ? tree_.find(block_[i]) : LeafOrder::kNone;
      rejected[task] += !valid;
      direct[task] += dropped;
    }
  });
  for (size_t task = 0; task < tasks; ++task) {
    totals_.rejected += rejected[task];
    totals_.dropped_direct += direct[task];
  }
}

void CacheTrainer::Impl::absorb_block() {
  const std::span<const uint32_t> occupied = order_.occupied();
  capped_.resize(occupied.size());
  parallel_for(occupied.size(), [&](size_t i) {
    const uint32_t cell = occupied[i];
    capped_[i] = tree_[cell].absorb(block_, order_.points(cell), emitted_, cell_options_);
  });
  for (size_t capped : capped_) totals_.weights_capped += capped;
}

void CacheTrainer::Impl::flush_cells() {
  capped_.resize(tree_.size());
  parallel_for(tree_.size(), [&](size_t i) { capped_[i] = tree_[i].flush(cell_options_); });
  for (size_t capped : capped_) totals_.weights_capped += capped;
}

GuideCache CacheTrainer::Impl::finish(CacheTrainSummary* summary) {
  if (!block_.empty()) process_block();
  flush_cells();
  clock_.photons = static_cast<double>(cache_.photons);
  clock_.particles = static_cast<double>(cache_.emitted);
  tree_.restate_exposure(clock_);
  tree_.lend_mixtures();
  tree_.store(cache_, tree_options_, clock_.photons / clock_.particles);
  escapes_.store(cache_);
  if (summary) summarise(cache_, *summary);
  return std::move(cache_);
}

void CacheTrainer::Impl::summarise(const GuideCache& cache, CacheTrainSummary& summary) const {
  summary = totals_;
  summary.cells = cache.cells.size();
  summary.cells_made = cache.cells.size() - cells_before_;
  summary.bytes = tree_.bytes();
  for (const CacheCell& cell : cache.cells) {
    if (cell.component_count == 0) continue;
    ++summary.cells_with_mixture;
    summary.mean_components += cell.component_count;
    summary.mean_effective_samples += cell.effective_samples;
    summary.lost_mass += std::max(0.0f, 1 - cell.guided_mass);
  }
  const double mixtures = std::max<double>(1, static_cast<double>(summary.cells_with_mixture));
  summary.mean_components /= mixtures;
  summary.mean_effective_samples /= mixtures;
  summary.lost_mass /= mixtures;
  summary.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

CacheTrainer::CacheTrainer(const CacheTrainOptions& options, const PhotonStreamInfo& stream,
                           GuideCache previous) {
  options.validate();
  impl_ = std::make_unique<Impl>(options, stream, std::move(previous));
}

CacheTrainer::~CacheTrainer() = default;

void CacheTrainer::consume(std::span<const Photon> photons) {
  require(impl_ != nullptr, "the cache trainer has finished: make another to go on");
  impl_->consume(photons);
}

void CacheTrainer::consume(std::span<const Escape> escapes) {
  require(impl_ != nullptr, "the cache trainer has finished: make another to go on");
  impl_->consume(escapes);
}

GuideCache CacheTrainer::finish(CacheTrainSummary* summary) {
  require(impl_ != nullptr, "the cache trainer has finished: make another to go on");
  const std::unique_ptr<Impl> impl = std::move(impl_);
  return impl->finish(summary);
}

}  // namespace waylight
