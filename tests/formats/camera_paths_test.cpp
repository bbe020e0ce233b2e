// What camera paths found, in streams and caches: the same again, in its place, or refused.

#include <cstring>

#include "formats/cache_generated.h"
#include "formats/file_bytes.h"
#include "formats/photons_generated.h"
#include "formats/small_caches.h"
#include "formats/temporary_files.h"
#include "libguide/base/error.h"

namespace waylight {
namespace {

using namespace testing;

class CameraPathFiles : public TemporaryFiles {
 protected:
  // Photons and samples, written in turns.
  static std::vector<Photon> mixed(size_t count) {
    std::vector<Photon> photons = random_photons(count);
    for (size_t i = 0; i < count; i += 2) photons[i].from = TracedFrom::camera;
    photons[0].power = Color::Zero();  // a sample of the dark counts too
    return photons;
  }

  void write(const std::string& file, const std::vector<Photon>& photons, uint64_t samples,
             uint64_t paths = 1000) {
    PhotonHeader header = small_header();
    header.stream.paths = paths;
    header.stream.expected = 12'345;
    PhotonWriter writer(file, header);
    writer.write(photons);
    PhotonCounts counts;
    counts.paths = paths, counts.samples = samples;
    counts.stored = photons.size() - samples;
    writer.finish(counts);
  }

  static CacheFile cache_with_sources() {
    CacheFile file = small_cache();
    file.cache.paths = 77;
    file.cache.sources.resize(file.cache.cells.size());
    file.cache.sources[0] = {1, 0.5, 1e300, 2, 1.0 / 3, 0.125, 40, 60};
    return file;
  }
};

TEST_F(CameraPathFiles, StreamsGiveBackBothKindsInTheOrderOfEach) {
  const std::vector<Photon> in = mixed(40'000);
  write(path("a.photons"), in, 20'000);
  PhotonReader reader(path("a.photons"));
  EXPECT_EQ(reader.header().stream.paths, 1000u);
  EXPECT_EQ(reader.header().stream.expected, 12'345u);
  std::array<size_t, 2> next = {1, 0};  // of photons, of samples
  for (std::vector<Photon> chunk; reader.read(&chunk);)
    for (const Photon& p : chunk) {
      size_t& i = next[p.from == TracedFrom::camera];
      ASSERT_LT(i, in.size());
      EXPECT_EQ(p.position, in[i].position);
      EXPECT_TRUE((p.power == in[i].power).all());
      EXPECT_EQ(p.path_depth, in[i].path_depth);
      i += 2;
    }
  EXPECT_EQ(next[0], in.size() + 1);
  EXPECT_EQ(next[1], in.size());
  EXPECT_EQ(reader.counts().samples, 20'000u);
  EXPECT_EQ(reader.counts().paths, 1000u);
}

TEST_F(CameraPathFiles, StreamsOfThemHaveAVersionOfTheirOwn) {
  const auto version = [&](uint64_t paths) {
    write(path("a.photons"), random_photons(3), 0, paths);
    const std::string bytes = read_whole_file(path("a.photons"));
    return fbs::GetSizePrefixedPhotonChunk(bytes.data())
        ->content_as_PhotonHeader()
        ->format_version();
  };
  EXPECT_EQ(version(1), 4u);
  EXPECT_EQ(version(0), 1u);
}

TEST_F(CameraPathFiles, StreamsThatSayNothingOfThemTakeNone) {
  EXPECT_THROW(write(path("a.photons"), mixed(4), 2, 0), Error);
  EXPECT_THROW(write(path("a.photons"), mixed(4), 1), Error) << "the counts are wrong";
}

TEST_F(CameraPathFiles, CachesKeepWhatEachKindSaid) {
  const CacheFile in = cache_with_sources();
  write_cache(path("a.cache"), in);
  const GuideCache out = read_cache(path("a.cache")).cache;
  EXPECT_EQ(out.paths, 77u);
  ASSERT_EQ(out.sources.size(), in.cache.sources.size());
  EXPECT_EQ(std::memcmp(out.sources.data(), in.cache.sources.data(),
                        out.sources.size() * sizeof(CellSources)),
            0);
  const std::string bytes = read_whole_file(path("a.cache"));
  EXPECT_EQ(fbs::GetGuideCache(bytes.data())->format_version(), 4u);
}

TEST_F(CameraPathFiles, CachesWithoutItGoOnOnlyWithoutCameraPaths) {
  CacheFile file = cache_with_sources();
  file.cache.sources.clear();
  EXPECT_THROW(write_cache(path("a.cache"), file), Error);
  file = cache_with_sources();
  file.cache.sources[0].camera_all = -1;
  EXPECT_THROW(write_cache(path("a.cache"), file), Error);
}

TEST_F(CameraPathFiles, ReducedCachesAreReadByOlderReaders) {
  CacheFile file = cache_with_sources();
  file.cache.sources.clear(), file.cache.training.clear(), file.cache.statistics.clear();
  write_cache(path("a.cache"), file);
  const std::string bytes = read_whole_file(path("a.cache"));
  EXPECT_EQ(fbs::GetGuideCache(bytes.data())->format_version(), 1u);
  EXPECT_EQ(read_cache(path("a.cache")).cache.paths, 77u);
}

}  // namespace
}  // namespace waylight
