#pragma once
// How photons leave the emitters, by what an importance cache says of the emitters.

#include <optional>
#include <vector>

#include "libguide/base/sampler.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/guiding/escape_tables.h"
#include "libguide/guiding/primary_table.h"
#include "libguide/scene/scene.h"

namespace waylight {

// Density over the emitters and the random numbers u with which each emits, in which plain emission
// is uniform:
//   p(i, u) = s P(i) + (1 - s) G(i) r_i(u),
// P by power, s = kPlainShare. G(i) is in proportion to what the emitter sends to the camera. For
// area lights r is in proportion to emitted radiance times the importance of the cells, and halfway
// between plain emission and the cell's mixture in direction; for distant light it follows where
// importons left the scene. Point and spot lights, which no importon meets, keep r = 1 and
// G(i) = P(i). No photon weighs more than 1 / s times what plain emission would give it.
class EmissionGuide {
 public:
  static constexpr float kPlainShare = 0.2f, kDirectionShare = 0.5f;

  // importance: of this scene, with kind importance; must outlive this, as must the scene.
  EmissionGuide(const Scene& scene, const GuideCacheView& importance);

  // power = Le cos / density of everything chosen.
  std::optional<EmissionSample> sample(Sampler& sampler) const;

  // Luminance of the image's mean that the cache promises of light that is not seen directly; 0
  // where it knows of no emitter.
  double expected_image() const { return expected_image_; }
  double emitted_power() const { return emitted_power_; }  // luminance, of all emitters

 private:
  enum class Kind { unknown, area, distant };
  struct Source {
    Kind kind = Kind::unknown;
    PrimaryTable table;  // area: (u, position); distant: (any, direction)
  };

  // The random numbers of one emission.
  struct Primary {
    float u = 0, u_table = 0, u_lobe = 0;
    Vec2 position = Vec2::Zero(), direction = Vec2::Zero();
  };
  void add_area(int emitter);
  void add_distant(int emitter);
  double mean_power(int emitter) const;
  void choose();
  float importance_at(int emitter, const PrimaryTable::Point& at) const;
  std::optional<EmissionSample> emit(int emitter, Primary at, bool guided, float* ratio) const;
  std::optional<EmissionSample> emit_area(int emitter, Primary at, bool guided, float* ratio) const;
  std::optional<EmissionSample> emit_distant(int emitter, Primary at, bool guided,
                                             float* ratio) const;

  const Scene& scene_;
  GuideCacheView importance_;
  EscapeTables escapes_;
  std::vector<Source> sources_;        // of each emitter
  std::vector<double> contributions_;  // of each, to the image's mean
  Discrete plain_, guided_;
  double expected_image_ = 0, emitted_power_ = 0;
};

}  // namespace waylight
