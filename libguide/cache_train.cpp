#include "libguide/cache_train.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libguide/base/error.h"
#include "libguide/base/stopwatch.h"
#include "libguide/cache/escape_histogram.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/cache/medium_trainer.h"
#include "libguide/cache/refit_tree.h"
#include "libguide/cache/training_check.h"

namespace waylight {
namespace {

// Positions closer together than this share of the scene's diameter are one place: about the
// resolution of a float coordinate at its far end.
constexpr float kMinExtent = 1e-6f;

// The distance of light from one direction, in radii of the scene.
constexpr float kFar = 1e4f;

constexpr int kMaxDirectLobes = 4;  // direct light comes from few places

void check_previous(const GuideCache& cache, Quantity stream) {
  if (cache.quantity != stream)
    fail("the previous cache holds {} and the stream {}: train each in a cache of its own",
         quantity_name(cache.quantity), quantity_name(stream));
  if (cache.training.size() != cache.cells.size() ||
      cache.statistics.size() != cache.components.size() ||
      cache.medium.training.size() != cache.medium.cells.size())
    fail(
        "the previous cache has no training statistics: a reduced cache cannot be trained, keep "
        "the unreduced file");
  std::string fault = check(GuideCacheView(cache));
  if (fault.empty()) fault = check_training(cache);
  if (!fault.empty())
    fail("the previous cache is damaged ({}): train from the photons again", fault);
}

template <typename Impl>
Impl& running(const std::unique_ptr<Impl>& impl) {
  require(impl != nullptr, "the cache trainer has finished: make another to go on");
  return *impl;
}

// A stream that does not say how many are to come is taken to be like those before.
double expected_photons(const PhotonStreamInfo& stream, const GuideCache& previous) {
  const double before = static_cast<double>(previous.photons);
  if (stream.expected > 0) return before + static_cast<double>(stream.expected);
  if (previous.emitted == 0) return 0;
  return before / static_cast<double>(previous.emitted) *
         static_cast<double>(previous.emitted + stream.emitted);
}

}  // namespace

void CacheTrainOptions::validate() const {
  require(components >= 1 && components <= 8, "components is {}: must be 1..8", components);
  require(photons_per_cell >= 64 && photons_per_cell <= 10'000'000,
          "photons_per_cell is {}: must be 64..10000000", photons_per_cell);
  require(medium_photons_per_cell >= 64 && medium_photons_per_cell <= 10'000'000,
          "medium_photons_per_cell is {}: must be 64..10000000", medium_photons_per_cell);
  require(max_cells >= 1 && max_cells <= 10'000'000, "max_cells is {}: must be 1..10000000",
          max_cells);
  require(normal_spread >= 0 && normal_spread <= 1, "normal_spread is {}: must be in [0, 1]",
          normal_spread);
  require(prior.v >= 1 && std::isfinite(prior.v), "prior.v is {}: must be at least 1", prior.v);
  require(prior.a > 2 && std::isfinite(prior.a), "prior.a is {}: must be above 2", prior.a);
  require(prior.b > 0 && std::isfinite(prior.b), "prior.b is {}: must be positive", prior.b);
  const VmfPrior& medium = medium_prior;
  require(medium.v >= 1 && std::isfinite(medium.v), "medium_prior.v is {}: must be at least 1",
          medium.v);
  require(medium.strength > 0 && std::isfinite(medium.strength),
          "medium_prior.strength is {}: must be positive", medium.strength);
  require(medium.length >= 0 && medium.length < 1, "medium_prior.length is {}: must be in [0, 1)",
          medium.length);
}

struct CacheTrainer::Impl {
  Impl(const CacheTrainOptions& options, const PhotonStreamInfo& stream, GuideCache previous);

  void consume(std::span<const Photon> photons) {
    require(!refits_, "photons come before the same photons again");
    surfaces_.consume(photons);
  }
  void consume(std::span<const MediumPhoton> photons) { media_.consume(photons); }
  void consume(std::span<const Escape> escapes);
  void refit(std::span<const Photon> photons);
  void refit(std::span<const MediumPhoton> photons) { media_.find_foci(photons); }
  GuideCache finish(CacheTrainSummary* summary, const RunControl& control);

 private:
  void start_cache(const PhotonStreamInfo& stream, const GuideCache& previous);
  double photons_per_particle() const {  // as far as is known; 0 also without particles
    return cache_.emitted > 0 ? expected_photons_ / static_cast<double>(cache_.emitted) : 0;
  }
  SurfaceRules surface_rules(const CacheTrainOptions& options) const;
  MediumRules medium_rules(const CacheTrainOptions& options) const;
  void finish_surfaces();
  void summarise(CacheTrainSummary& summary) const;

  GuideCache cache_;             // without its cells while they are in training
  uint64_t emitted_;             // particles of the stream
  double expected_photons_ = 0;  // of the whole training when it is done; 0: not known
  BlockTrainer<Photon, TrainingTree, SurfaceRules> surfaces_;
  std::optional<BlockTrainer<Photon, RefitTree, SurfaceRules>> refits_;  // once that has begun
  MediumTrainer media_;
  EscapeMap escape_map_;
  EscapeHistogram escapes_;
  BlockTally escape_tally_;
  size_t cells_before_, cells_before_merging_ = 0, bytes_saved_ = 0;
  bool merges_alike_;
  TrainingClock clock_;
  Stopwatch stopwatch_;
};

CacheTrainer::Impl::Impl(const CacheTrainOptions& options, const PhotonStreamInfo& stream,
                         GuideCache previous)
    : emitted_(stream.emitted), merges_alike_(options.merge_alike) {
  if (stream.emitted == 0 && stream.paths == 0)
    fail("the photon stream does not say how many particles were emitted");
  const bool goes_on = !previous.nodes.empty() || !previous.medium.nodes.empty();
  if (goes_on) check_previous(previous, stream.quantity);
  start_cache(stream, previous);
  const Bounds& scene = cache_.scene_bounds;
  surfaces_ = {previous.nodes.empty() ? TrainingTree() : TrainingTree(previous),
               surface_rules(options), previous.photons};
  media_ = {previous.medium,
            {scene, stream.emitted, stream.media},
            medium_rules(options),
            options.merge_alike};
  if (goes_on) escapes_ = EscapeHistogram(previous);
  escape_map_ = EscapeMap(scene);
  cells_before_ = surfaces_.tree().size();
}

void CacheTrainer::Impl::start_cache(const PhotonStreamInfo& stream, const GuideCache& previous) {
  cache_.scene_bounds = previous.scene_bounds;
  cache_.scene_bounds.extend(stream.scene_bounds);
  if (cache_.scene_bounds.empty() || !std::isfinite(cache_.scene_bounds.radius()))
    fail("the bounds of the scene in the photon stream are empty or not finite");
  cache_.quantity = stream.quantity;
  cache_.emitted = previous.emitted + stream.emitted;
  cache_.paths = previous.paths + stream.paths;
  cache_.passes = previous.passes + 1;
  expected_photons_ = expected_photons(stream, previous);
  clock_.photons_before = static_cast<double>(previous.photons);
  clock_.particles_before = static_cast<double>(previous.emitted);
}

SurfaceRules CacheTrainer::Impl::surface_rules(const CacheTrainOptions& options) const {
  const Bounds& scene = cache_.scene_bounds;
  return {accepted_bounds(scene),
          static_cast<float>(emitted_),
          cache_.quantity,
          {static_cast<size_t>(options.photons_per_cell), static_cast<size_t>(options.max_cells),
           options.normal_spread, kMinExtent * 2 * scene.radius()},
          {options.components, options.direct == DirectLight::drop, options.prior, cache_.paths > 0,
           photons_per_particle()}};
}

MediumRules CacheTrainer::Impl::medium_rules(const CacheTrainOptions& options) const {
  const Bounds& scene = cache_.scene_bounds;
  return {accepted_bounds(scene),
          static_cast<float>(emitted_),
          {static_cast<size_t>(options.medium_photons_per_cell),
           static_cast<size_t>(options.max_cells)},
          {{options.components, options.medium_prior},
           {std::min(options.components, kMaxDirectLobes), options.medium_prior},
           kMinExtent * 2 * scene.radius(),
           kFar * scene.radius()}};
}

void CacheTrainer::Impl::consume(std::span<const Escape> escapes) {
  escape_tally_.photons += escapes.size();
  for (const Escape& escape : escapes) {
    const PhotonVerdict verdict = surfaces_.rules().judge(escape);
    escape_tally_.rejected += !verdict.valid;
    escape_tally_.dropped_direct += verdict.dropped;
    if (verdict.counts) escapes_.add(escape_map_, escape, static_cast<float>(emitted_));
  }
}

void CacheTrainer::Impl::refit(std::span<const Photon> photons) {
  if (!refits_) {
    surfaces_.finish();
    SurfaceRules rules = surfaces_.rules();
    const double all = static_cast<double>(surfaces_.photons());
    rules.cell.old_share = all > 0 ? clock_.photons_before / all : 0;
    refits_.emplace(RefitTree(surfaces_.tree()), rules, 0);
  }
  refits_->consume(photons);
}

GuideCache CacheTrainer::Impl::finish(CacheTrainSummary* summary, const RunControl& control) {
  if (refits_)
    refits_->finish(control);
  else
    surfaces_.finish();
  if (control.stopped()) return {};
  finish_surfaces();
  cache_.medium = media_.finish(control);
  if (control.stopped()) return {};
  escapes_.store(cache_);
  if (summary) summarise(*summary);
  return std::move(cache_);
}

void CacheTrainer::Impl::finish_surfaces() {
  cache_.photons = surfaces_.photons();
  clock_.photons = static_cast<double>(cache_.photons);
  clock_.particles = static_cast<double>(cache_.emitted);
  TrainingTree& tree = surfaces_.tree();
  tree.restate_exposure(clock_);
  cells_before_merging_ = tree.size();
  const double per_particle = clock_.particles > 0 ? clock_.photons / clock_.particles : 0;
  const TreeOptions& rules = surfaces_.rules().tree;
  if (merges_alike_)
    bytes_saved_ = tree.merge_alike({surfaces_.rules().cell.components, rules.normal_spread,
                                     clock_.photons, sqr(rules.min_extent), per_particle});
  tree.lend_mixtures();
  tree.sort_by_place();
  tree.store(cache_, rules, per_particle);
}

void CacheTrainer::Impl::summarise(CacheTrainSummary& summary) const {
  const BlockTally& tally = surfaces_.tally();
  summary = {};
  summary.photons = tally.photons;
  summary.escapes = escape_tally_.photons;
  summary.rejected = tally.rejected + escape_tally_.rejected;
  summary.dropped_direct = tally.dropped_direct + escape_tally_.dropped_direct;
  summary.weights_capped = tally.weights_capped;
  summary.count_cells(cache_);
  if (refits_)
    summary.mixtures_refitted =
        std::ranges::count_if(refits_->tree().cells(), &RefitCell::refitted);
  summary.cells_before_merging = cells_before_merging_;
  summary.bytes_saved = bytes_saved_;
  summary.cells_made = cells_before_merging_ - cells_before_;
  summary.media.photons = media_.tally().photons;
  summary.media.rejected = media_.tally().rejected;
  summary.media.weights_capped = media_.tally().weights_capped;
  summary.bytes = surfaces_.tree().bytes() + (refits_ ? refits_->tree().bytes() : 0);
  summary.media.cells_before_merging = media_.cells_before_merging();
  if (!cache_.medium.cells.empty()) summary.media.bytes = media_.bytes();
  summary.seconds = stopwatch_.seconds();
}

CacheTrainer::CacheTrainer(const CacheTrainOptions& options, const PhotonStreamInfo& stream,
                           GuideCache previous) {
  options.validate();
  impl_ = std::make_unique<Impl>(options, stream, std::move(previous));
}

CacheTrainer::~CacheTrainer() = default;

void CacheTrainer::consume(std::span<const Photon> batch) { running(impl_).consume(batch); }
void CacheTrainer::consume(std::span<const MediumPhoton> batch) { running(impl_).consume(batch); }
void CacheTrainer::consume(std::span<const Escape> batch) { running(impl_).consume(batch); }
void CacheTrainer::refit(std::span<const Photon> batch) { running(impl_).refit(batch); }
void CacheTrainer::refit(std::span<const MediumPhoton> batch) { running(impl_).refit(batch); }

GuideCache CacheTrainer::finish(CacheTrainSummary* summary, const RunControl& control) {
  const std::unique_ptr<Impl> impl = std::move(impl_);
  return running(impl).finish(summary, control);
}

}  // namespace waylight
