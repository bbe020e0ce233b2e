// The caches of a render: what they hold, and how long.

#include "libguide/guiding/guiding_caches.h"

#include <gtest/gtest.h>

namespace waylight {
namespace {

TEST(GuidingCaches, FitsAreReadWhenAskedForAndFreedWhenDropped) {
  std::weak_ptr<const BrdfCache> held;
  const std::vector<Material> materials(1);
  GuidingCaches caches(
      [&held] {
        auto fits = std::make_shared<BrdfCache>();
        fits->entries = {{0, 1, 0}};
        fits->components = {{1, 0, 0, 0.1f, 0, 0.1f}};
        fits->materials.resize(1);
        fits->materials[0].entry_count = 1;
        held = fits;
        return fits;
      },
      {}, materials);
  const auto has_lobe = [&] {
    return caches.brdf_lobe(0, false, Vec3::UnitZ(), Vec2::Zero()).lobe != nullptr;
  };
  EXPECT_FALSE(caches.has_fits() || has_lobe());
  caches.load_fits();
  EXPECT_TRUE(caches.has_fits() && has_lobe() && !held.expired());
  caches.drop_fits();
  EXPECT_TRUE(held.expired());
  caches.load_fits();
  EXPECT_FALSE(caches.has_fits() || has_lobe());
}

}  // namespace
}  // namespace waylight
