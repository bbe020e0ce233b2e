// What is written is what is read, and equal content is equal bytes.

#include <cstring>

#include "formats/cache_generated.h"
#include "formats/small_caches.h"
#include "formats/temporary_files.h"
#include "libguide/base/error.h"
#include "libguide/spatial/escape_map.h"

namespace waylight {
namespace {

using namespace testing;

class RoundTrip : public TemporaryFiles {};

void expect_equal(const Provenance& a, const Provenance& b) {
  EXPECT_EQ(a.tool, b.tool);
  EXPECT_EQ(a.version, b.version);
  EXPECT_EQ(a.command_line, b.command_line);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.scene_name, b.scene_name);
  EXPECT_EQ(a.scene, b.scene);
  ASSERT_EQ(a.parents.size(), b.parents.size());
  for (size_t i = 0; i < a.parents.size(); ++i) {
    EXPECT_EQ(a.parents[i].name, b.parents[i].name);
    EXPECT_EQ(a.parents[i].hash, b.parents[i].hash);
  }
}

// Of records without padding.
template <typename A, typename B>
void expect_same_bytes(const A& a, const B& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_TRUE(a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(*a.data())) == 0);
}

void expect_equal(const CellTraining& a, const CellTraining& b) {
  EXPECT_EQ(a.position_mean, b.position_mean);
  EXPECT_EQ(a.position_m2, b.position_m2);
  EXPECT_EQ(a.position_cross, b.position_cross);
  EXPECT_EQ(a.normal_mean, b.normal_mean);
  EXPECT_EQ(a.normal_m2, b.normal_m2);
  EXPECT_EQ(a.count, b.count);
  EXPECT_EQ(a.flux, b.flux);
  EXPECT_EQ(a.born, b.born);
  EXPECT_EQ(a.inherited_area, b.inherited_area);
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.weight_sum, b.weight_sum);
  EXPECT_EQ(a.weight_sum2, b.weight_sum2);
}

TEST_F(RoundTrip, AFullCellTakesLessThanHalfAKilobyteOfAReducedCache) {
  constexpr uint32_t kCells = 1024;
  CacheFile file = small_cache();
  GuideCache& c = file.cache;
  c.statistics.clear(), c.training.clear(), c.components.clear(), c.cells.clear();
  c.nodes.clear();
  for (uint32_t i = 0; i + 1 < kCells; ++i) c.nodes.push_back({0, 2 * i + 1, 0});
  for (uint32_t i = 0; i < kCells; ++i) {
    c.nodes.push_back({0, i, kLeafAxis});
    c.cells.push_back({Vec3::UnitZ(), 1, 100, 100, 1, 8 * i, 8});
    c.components.insert(c.components.end(), 8, {0.125f, 0.1f, 0.2f, 0.01f, 0, 0.02f});
  }
  write_cache(path("full.cache"), file);
  EXPECT_LT(std::filesystem::file_size(path("full.cache")), kCells * 512);
  EXPECT_EQ(read_cache(path("full.cache")).cache.cells.size(), kCells);
}

TEST_F(RoundTrip, CacheWithTrainingStatistics) {
  const CacheFile out = small_cache();
  write_cache(path("a.cache"), out);
  const CacheFile in = read_cache(path("a.cache"));
  expect_equal(in.provenance, out.provenance);
  EXPECT_EQ(in.cache.scene_bounds.min, out.cache.scene_bounds.min);
  EXPECT_EQ(in.cache.scene_bounds.max, out.cache.scene_bounds.max);
  EXPECT_EQ(in.cache.emitted, out.cache.emitted);
  EXPECT_EQ(in.cache.passes, out.cache.passes);
  EXPECT_EQ(in.cache.photons, out.cache.photons);
  expect_same_bytes(in.cache.nodes, out.cache.nodes);
  expect_same_bytes(in.cache.cells, out.cache.cells);
  expect_same_bytes(in.cache.components, out.cache.components);
  expect_same_bytes(in.cache.statistics, out.cache.statistics);
  ASSERT_EQ(in.cache.training.size(), 2u);
  for (int i = 0; i < 2; ++i) expect_equal(in.cache.training[i], out.cache.training[i]);
}

TEST_F(RoundTrip, MappedCacheSeesTheSameInPlace) {
  const CacheFile out = small_cache();
  write_cache(path("a.cache"), out);
  MappedCache mapped(path("a.cache"));
  const MappedCache moved(std::move(mapped));
  expect_equal(moved.provenance(), out.provenance);
  const GuideCacheView view = moved.view();
  expect_same_bytes(view.nodes, out.cache.nodes);
  expect_same_bytes(view.cells, out.cache.cells);
  expect_same_bytes(view.components, out.cache.components);
  const CacheCell* cell = view.query(Vec3(0.5f, 0, 0), -Vec3::UnitZ());
  ASSERT_EQ(cell, &view.cells[1]);
  EXPECT_EQ(view.mixture(*cell).count(), 1);
}

TEST_F(RoundTrip, ReducedAndEmptyCaches) {
  CacheFile reduced = small_cache();
  reduced.cache.statistics.clear();
  reduced.cache.training.clear();
  write_cache(path("reduced.cache"), reduced);
  EXPECT_TRUE(read_cache(path("reduced.cache")).cache.training.empty());
  write_cache(path("empty.cache"), {});
  EXPECT_TRUE(read_cache(path("empty.cache")).cache.cells.empty());
  EXPECT_EQ(MappedCache(path("empty.cache")).view().query(Vec3::Zero(), Vec3::UnitZ()), nullptr);
}

TEST_F(RoundTrip, Brdf) {
  const BrdfFile out = small_brdf();
  write_brdf(path("a.brdf"), out);
  const BrdfFile in = read_brdf(path("a.brdf"));
  expect_equal(in.provenance, out.provenance);
  expect_same_bytes(in.cache.entries, out.cache.entries);
  expect_same_bytes(in.cache.components, out.cache.components);
  ASSERT_EQ(in.cache.materials.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    const MaterialFit &a = in.cache.materials[i], &b = out.cache.materials[i];
    EXPECT_EQ(a.material, b.material);
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.textured, b.textured);
    EXPECT_EQ(a.first_entry, b.first_entry);
    EXPECT_EQ(a.entry_count, b.entry_count);
  }
}

TEST_F(RoundTrip, BrdfByDirectionAndWidth) {
  const BrdfFile out = brdf_of_version2();
  write_brdf(path("a.brdf"), out);
  const BrdfFile in = read_brdf(path("a.brdf"));
  EXPECT_EQ(in.cache.materials[0].layout, EntryLayout::elevations);
  EXPECT_TRUE(in.cache.materials[0].widths.empty());
  EXPECT_EQ(in.cache.materials[1].layout, EntryLayout::fibonacci);
  expect_same_bytes(in.cache.materials[1].widths, out.cache.materials[1].widths);
}

TEST_F(RoundTrip, PhotonsOfSeveralChunks) {
  const std::vector<Photon> out = random_photons(40'000);
  write_photons(path("a.photons"), out);
  PhotonReader reader(path("a.photons"));
  expect_equal(reader.header().provenance, small_provenance());
  EXPECT_EQ(reader.header().stream.emitted, 5'000'000'000u);
  EXPECT_EQ(reader.header().stream.pass, 3u);
  EXPECT_EQ(reader.header().stream.scene_bounds.max, Vec3(1, 2, 3));
  const std::vector<Photon> in = read_photons(path("a.photons"));
  ASSERT_EQ(in.size(), out.size());
  for (size_t i = 0; i < in.size(); ++i) {
    ASSERT_EQ(in[i].position, out[i].position);
    ASSERT_TRUE((in[i].power == out[i].power).all());
    ASSERT_EQ(in[i].path_depth, out[i].path_depth);
    ASSERT_LT((in[i].direction - out[i].direction).norm(), 6.5e-5f);
    ASSERT_LT((in[i].normal - out[i].normal).norm(), 6.5e-5f);
    ASSERT_NEAR(in[i].direction.norm(), 1, 1e-6f);
  }
}

TEST_F(RoundTrip, PhotonsKeepAxesExactly) {
  std::vector<Photon> out(6, random_photons(1)[0]);
  for (int i = 0; i < 6; ++i)
    out[i].normal = out[i].direction = Vec3::Unit(i / 2) * (i % 2 ? -1.0f : 1.0f);
  write_photons(path("a.photons"), out);
  const std::vector<Photon> in = read_photons(path("a.photons"));
  ASSERT_EQ(in.size(), 6u);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(in[i].normal, out[i].normal) << i;
}

TEST_F(RoundTrip, StreamWithoutPhotonsSaysItsCounts) {
  write_photons(path("a.photons"), {});
  PhotonReader reader(path("a.photons"));
  std::vector<Photon> photons(5);
  EXPECT_FALSE(reader.read(&photons));
  EXPECT_TRUE(photons.empty());
  EXPECT_EQ(reader.counts().emitted, 5'000'000'000u);
  EXPECT_EQ(reader.counts().stored, 0u);
  EXPECT_EQ(reader.counts().left_scene, 11u);
  EXPECT_EQ(reader.counts().absorbed, 12u);
  EXPECT_EQ(reader.counts().too_deep, 13u);
  EXPECT_EQ(reader.counts().invalid, 14u);
  EXPECT_FALSE(reader.read(&photons));
}

TEST_F(RoundTrip, EqualContentGivesEqualBytes) {
  for (const char* name : {"a", "b"}) {
    std::vector<char> noise(100'000, *name);  // so that what is left undefined would differ
    write_cache(path(name) + std::string(".cache"), small_cache());
    write_brdf(path(name) + std::string(".brdf"), small_brdf());
  }
  EXPECT_EQ(read_whole_file(path("a.cache")), read_whole_file(path("b.cache")));
  EXPECT_EQ(read_whole_file(path("a.brdf")), read_whole_file(path("b.brdf")));
}

TEST_F(RoundTrip, BytesOfPhotonsDoNotDependOnHowTheyWereHandedOver) {
  const std::vector<Photon> photons = random_photons(40'000);
  write_photons(path("a.photons"), photons);
  PhotonWriter writer(path("b.photons"), small_header());
  for (size_t i = 0; i < photons.size(); i += 777)
    writer.write(std::span(photons).subspan(i, std::min<size_t>(777, photons.size() - i)));
  writer.finish({5'000'000'000, 40'000, 11, 12, 13, 14});
  EXPECT_EQ(read_whole_file(path("a.photons")), read_whole_file(path("b.photons")));
}

TEST_F(RoundTrip, HashOfAStreamIsThatOfItsFileOnBothSides) {
  PhotonWriter writer(path("a.photons"), small_header());
  writer.write(random_photons(20'000));
  writer.finish({5'000'000'000, 20'000, 0, 0, 0, 0});
  PhotonReader reader(path("a.photons"));
  for (std::vector<Photon> photons; reader.read(&photons);) {
  }
  EXPECT_EQ(reader.content_hash(), hash_file(path("a.photons")));
  EXPECT_EQ(writer.content_hash(), hash_file(path("a.photons")));
}

TEST_F(RoundTrip, UnfinishedStreamLeavesNoFile) {
  {
    PhotonWriter writer(path("a.photons"), small_header());
    writer.write(random_photons(20'000));
  }
  EXPECT_EQ(file_count(), 0u);
}

TEST_F(RoundTrip, ImportonsAndThoseThatLeftTheScene) {
  PhotonHeader header = small_header();
  header.stream.quantity = Quantity::importance;
  const std::vector<Photon> photons = random_photons(20'000);
  std::vector<Escape> escapes;
  for (const Photon& p : random_photons(17'000, 2))
    escapes.push_back({p.position, p.direction, p.power, p.path_depth});
  PhotonWriter writer(path("a.importons"), header);
  writer.write(photons);
  writer.write(escapes);
  writer.finish({5'000'000'000, 20'000, 0, 0, 0, 0, 17'000});

  PhotonReader reader(path("a.importons"));
  EXPECT_EQ(reader.header().stream.quantity, Quantity::importance);
  std::vector<Escape> in, chunk;
  size_t photons_in = 0;
  for (std::vector<Photon> some; reader.read(&some, &chunk); photons_in += some.size())
    in.insert(in.end(), chunk.begin(), chunk.end());
  EXPECT_EQ(photons_in, photons.size());
  EXPECT_EQ(reader.counts().escapes, 17'000u);
  ASSERT_EQ(in.size(), escapes.size());
  for (size_t i = 0; i < in.size(); ++i) {
    ASSERT_EQ(in[i].origin, escapes[i].origin);
    ASSERT_TRUE((in[i].power == escapes[i].power).all());
    ASSERT_EQ(in[i].path_depth, escapes[i].path_depth);
    ASSERT_LT((in[i].direction - escapes[i].direction).norm(), 6.5e-5f);
  }
  EXPECT_EQ(read_photons(path("a.importons")).size(), photons.size()) << "who wants no escapes";
}

TEST_F(RoundTrip, StreamOfRadianceHasNoEscapes) {
  PhotonWriter writer(path("a.photons"), small_header());
  const std::vector<Escape> escapes(1, {Vec3::Zero(), Vec3::UnitX(), Color::Ones()});
  EXPECT_THROW(writer.write(escapes), Error);
}

TEST_F(RoundTrip, ReachesOfCells) {
  CacheFile out = small_cache();
  out.cache.reaches.assign(out.cache.cells.size(), {Vec3(1, 2, 3), Vec3(4, 5, 6)});
  write_cache(path("a.cache"), out);
  EXPECT_EQ(read_cache(path("a.cache")).cache.reaches[0].min, Vec3(1, 2, 3));
  EXPECT_EQ(MappedCache(path("a.cache")).view().reaches[0].max, Vec3(4, 5, 6));

  out.cache.reaches[0].max.y() = 1;
  EXPECT_THROW(write_cache(path("b.cache"), out), Error) << "an empty reach";
  out.cache.reaches.push_back({});
  EXPECT_THROW(write_cache(path("b.cache"), out), Error) << "a reach without cell";
}

TEST_F(RoundTrip, CacheOfImportance) {
  CacheFile out = small_cache();
  out.cache.quantity = Quantity::importance;
  out.cache.escape_bins = {3, 77};
  out.cache.escape_weights.assign(2 * EscapeMap::kCells, 0.25f);
  write_cache(path("a.cache"), out);
  const CacheFile in = read_cache(path("a.cache"));
  EXPECT_EQ(in.cache.quantity, Quantity::importance);
  EXPECT_EQ(in.cache.escape_bins, out.cache.escape_bins);
  EXPECT_EQ(in.cache.escape_weights, out.cache.escape_weights);
  const MappedCache mapped(path("a.cache"));
  EXPECT_EQ(mapped.view().quantity, Quantity::importance);
  EXPECT_EQ(mapped.view().escape_weights.size(), out.cache.escape_weights.size());

  out.cache.escape_bins = {77, 3};
  EXPECT_THROW(write_cache(path("b.cache"), out), Error) << "bins out of order";
  out.cache.escape_bins = {3, EscapeMap::kBins};
  EXPECT_THROW(write_cache(path("b.cache"), out), Error) << "a bin that does not exist";
  out.cache.escape_bins = {3};
  EXPECT_THROW(write_cache(path("b.cache"), out), Error) << "weights without bin";
}

void expect_equal(const MediumLightTraining& a, const MediumLightTraining& b) {
  EXPECT_EQ(a.flux, b.flux);
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.weight_sum, b.weight_sum);
  EXPECT_EQ(a.weight_sum2, b.weight_sum2);
}

void expect_equal(const MediumTraining& a, const MediumTraining& b) {
  EXPECT_EQ(a.position_mean, b.position_mean);
  EXPECT_EQ(a.position_m2, b.position_m2);
  EXPECT_EQ(a.position_cross, b.position_cross);
  EXPECT_EQ(a.count, b.count);
  EXPECT_EQ(a.born, b.born);
  EXPECT_EQ(a.occupied, b.occupied);
  EXPECT_EQ(a.inherited_volume, b.inherited_volume);
  expect_equal(a.indirect, b.indirect);
  expect_equal(a.direct, b.direct);
}

uint32_t version_of_cache(const std::string& path) {
  const std::string bytes = read_whole_file(path);
  return fbs::GetGuideCache(bytes.data())->format_version();
}

TEST_F(RoundTrip, CacheOfMedia) {
  const CacheFile out = medium_cache();
  write_cache(path("a.cache"), out);
  EXPECT_EQ(version_of_cache(path("a.cache")), 3u);
  const MediumCache in = read_cache(path("a.cache")).cache.medium;
  const MediumCache& medium = out.cache.medium;
  EXPECT_EQ(in.emitted, medium.emitted);
  EXPECT_EQ(in.photons, medium.photons);
  expect_same_bytes(in.nodes, medium.nodes);
  expect_same_bytes(in.cells, medium.cells);
  expect_same_bytes(in.components, medium.components);
  expect_same_bytes(in.statistics, medium.statistics);
  expect_same_bytes(in.focused_cells, medium.focused_cells);
  expect_same_bytes(in.focused_lobes, medium.focused_lobes);
  ASSERT_EQ(in.training.size(), 2u);
  for (int i = 0; i < 2; ++i) expect_equal(in.training[i], medium.training[i]);
}

TEST_F(RoundTrip, MappedCacheOfMedia) {
  const CacheFile out = medium_cache();
  write_cache(path("a.cache"), out);
  const MappedCache mapped(path("a.cache"));
  const MediumCacheView view = mapped.view().medium;
  const MediumCell* cell = view.query(Vec3(0, 0, 0.5f));
  ASSERT_EQ(cell, &view.cells[0]);
  EXPECT_EQ(view.query(Vec3(0, 0, 2)), &view.cells[1]);
  ASSERT_EQ(view.lobes(cell->direct).size(), 2u);
  EXPECT_EQ(view.lobes(cell->direct)[1].kappa, 1e4f);
  EXPECT_TRUE(view.lobes(view.cells[1].direct).empty());
  EXPECT_TRUE(view.focused(0).empty());
  ASSERT_EQ(view.focused(1).size(), 2u);
  EXPECT_EQ(view.focused(1)[0].focus, Vec3(4, -5, 6));
  EXPECT_EQ(MediumCacheView().query(Vec3::Zero()), nullptr);
}

TEST_F(RoundTrip, CacheOfMediaAloneAndReduced) {
  CacheFile file = medium_cache();
  GuideCache& c = file.cache;
  c.nodes.clear(), c.cells.clear(), c.components.clear(), c.statistics.clear(), c.training.clear();
  write_cache(path("alone.cache"), file);
  EXPECT_EQ(read_cache(path("alone.cache")).cache.medium.training.size(), 2u);
  c.medium.statistics.clear(), c.medium.training.clear();
  write_cache(path("reduced.cache"), file);
  const CacheFile reduced = read_cache(path("reduced.cache"));
  EXPECT_TRUE(reduced.cache.medium.training.empty());
  EXPECT_EQ(reduced.cache.medium.cells.size(), 2u);
}

TEST_F(RoundTrip, CachesWithoutMediaKeepTheirVersion) {
  write_cache(path("a.cache"), small_cache());
  EXPECT_EQ(version_of_cache(path("a.cache")), 1u);
}

TEST_F(RoundTrip, PhotonsOfMedia) {
  const std::vector<Photon> photons = random_photons(20'000);
  const std::vector<MediumPhoton> out = random_medium_photons(18'000, 2);
  write_medium_photons(path("a.photons"), photons, out);
  PhotonReader reader(path("a.photons"));
  EXPECT_TRUE(reader.header().stream.media);
  std::vector<MediumPhoton> in, chunk;
  size_t photons_in = 0;
  for (std::vector<Photon> some; reader.read(&some, nullptr, &chunk); photons_in += some.size())
    in.insert(in.end(), chunk.begin(), chunk.end());
  EXPECT_EQ(photons_in, photons.size());
  EXPECT_EQ(reader.counts().in_media, out.size());
  ASSERT_EQ(in.size(), out.size());
  for (size_t i = 0; i < in.size(); ++i) {
    ASSERT_EQ(in[i].position, out[i].position);
    ASSERT_TRUE((in[i].weight == out[i].weight).all());
    ASSERT_EQ(in[i].path_depth, out[i].path_depth);
    ASSERT_LT((in[i].direction - out[i].direction).norm(), 6.5e-5f);
  }
  EXPECT_EQ(read_photons(path("a.photons")).size(), photons.size()) << "who wants none of media";
}

TEST_F(RoundTrip, StreamThatSaysNothingOfMediaHasNone) {
  PhotonWriter writer(path("a.photons"), small_header());
  EXPECT_THROW(writer.write(random_medium_photons(1)), Error);
  writer.write(std::span<const MediumPhoton>());
  writer.finish({});
  EXPECT_FALSE(PhotonReader(path("a.photons")).header().stream.media);
}

}  // namespace
}  // namespace waylight
