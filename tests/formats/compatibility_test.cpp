// Files that older releases wrote stay readable. The data are what small_caches.h describes,
// written when the format was new; a change of the format adds files and never replaces these.

#include <cstring>

#include "formats/brdf_generated.h"
#include "formats/small_caches.h"
#include "formats/temporary_files.h"

namespace waylight {
namespace {

using namespace testing;

std::string data(const std::string& name) {
  return std::string(WAYLIGHT_SOURCE_DIR) + "/tests/formats/data/" + name;
}

TEST(Compatibility, CacheOfVersion1) {
  const CacheFile file = read_cache(data("version1.cache"));
  const CacheFile expected = small_cache();
  EXPECT_EQ(file.provenance.command_line, expected.provenance.command_line);
  EXPECT_EQ(file.provenance.scene, expected.provenance.scene);
  EXPECT_EQ(file.cache.photons, expected.cache.photons);
  ASSERT_EQ(file.cache.cells.size(), 2u);
  EXPECT_EQ(file.cache.cells[1].normal, expected.cache.cells[1].normal);
  EXPECT_EQ(file.cache.cells[1].irradiance, expected.cache.cells[1].irradiance);
  EXPECT_EQ(file.cache.components[2].cov_xy, expected.cache.components[2].cov_xy);
  EXPECT_EQ(file.cache.statistics[2].s2_yy, expected.cache.statistics[2].s2_yy);
  EXPECT_EQ(file.cache.training[1].weight_sum, expected.cache.training[1].weight_sum);
  EXPECT_EQ(MappedCache(data("version1.cache")).view().cells.size(), 2u);
}

TEST(Compatibility, BrdfOfVersion1) {
  const BrdfFile file = read_brdf(data("version1.brdf"));
  ASSERT_EQ(file.cache.materials.size(), 2u);
  EXPECT_EQ(file.cache.materials[1].name, "metal");
  EXPECT_EQ(file.cache.materials[1].entry_count, 3u);
  EXPECT_EQ(file.cache.entries[1].held_out_error, 0.5f);
}

TEST(Compatibility, BrdfOfVersion1IsByElevationAtOneWidth) {
  for (const MaterialFit& fit : read_brdf(data("version1.brdf")).cache.materials) {
    EXPECT_EQ(fit.layout, EntryLayout::elevations);
    EXPECT_TRUE(fit.widths.empty());
  }
}

TEST(Compatibility, BrdfOfVersion2) {
  const BrdfFile file = read_brdf(data("version2.brdf"));
  ASSERT_EQ(file.cache.materials.size(), 2u);
  EXPECT_EQ(file.cache.materials[0].layout, EntryLayout::elevations);
  EXPECT_EQ(file.cache.materials[1].layout, EntryLayout::fibonacci);
  ASSERT_EQ(file.cache.materials[1].widths.size(), 2u);
  EXPECT_EQ(file.cache.materials[1].widths[1].width, 0.5f);
  EXPECT_EQ(file.cache.materials[1].widths[1].entry_count, 2u);
}

// Releases that know elevations only read what holds nothing else.
using CompatibilityOfFiles = TemporaryFiles;
TEST_F(CompatibilityOfFiles, BrdfsByElevationAreWrittenInVersion1) {
  const auto version = [&](const BrdfFile& file) {
    write_brdf(path("a.brdf"), file);
    const std::string bytes = read_whole_file(path("a.brdf"));
    return fbs::GetBrdfCache(bytes.data())->format_version();
  };
  EXPECT_EQ(version(small_brdf()), 1u);
  EXPECT_EQ(version(brdf_of_version2()), 2u);
}

TEST(Compatibility, PhotonsOfVersion1) {
  PhotonReader reader(data("version1.photons"));
  EXPECT_EQ(reader.header().stream.pass, 3u);
  std::vector<Photon> photons;
  ASSERT_TRUE(reader.read(&photons));
  ASSERT_EQ(photons.size(), 2u);
  EXPECT_EQ(photons[0].normal, -Vec3::UnitZ());
  EXPECT_EQ(photons[1].position, Vec3(1, 2, 3));
  EXPECT_EQ(photons[1].power.y(), 0.5f);
  EXPECT_EQ(photons[1].path_depth, 4u);
  EXPECT_FALSE(reader.read(&photons));
  EXPECT_EQ(reader.counts().invalid, 14u);
}

}  // namespace
}  // namespace waylight
