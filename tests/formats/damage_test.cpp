// Whatever happens to a file, its reader says so or finds valid content.

#include <functional>

#include "formats/file_kind.h"
#include "formats/flat_file.h"
#include "formats/image_io.h"
#include "formats/small_caches.h"
#include "formats/temporary_files.h"

namespace waylight {
namespace {

using namespace testing;

struct Reader {
  const char* name;
  std::function<void(const std::string& path)> read;
};

class Damage : public TemporaryFiles {
 protected:
  void SetUp() override {
    TemporaryFiles::SetUp();
    write_cache(path("good.cache"), small_cache());
    write_brdf(path("good.brdf"), small_brdf());
    write_photons(path("good.photons"), random_photons(50));
    write_cache(path("good.media"), medium_cache());
    write_medium_photons(path("good.medium-photons"), random_photons(5), random_medium_photons(40));
    write_exr(path("good.exr"), Image(2, 2, {"R", "G", "B"}));
  }
  std::string good(const Reader& reader) const {
    return read_whole_file(path(std::string("good.") + reader.name));
  }
};

const std::vector<Reader> kReaders = {
    {"cache", [](const std::string& path) { read_cache(path); }},
    {"cache", [](const std::string& path) { MappedCache{path}; }},
    {"brdf", [](const std::string& path) { read_brdf(path); }},
    {"photons", [](const std::string& path) { read_photons(path); }},
    {"media", [](const std::string& path) { read_cache(path); }},
    {"media", [](const std::string& path) { MappedCache{path}; }},
    {"medium-photons", [](const std::string& path) { read_photons(path); }},
};

// True when the file was refused; any other exception fails the test.
bool refused(const Reader& reader, const std::string& path) {
  try {
    reader.read(path);
    return false;
  } catch (const Error& error) {
    EXPECT_TRUE(mentions(error.what(), path)) << error.what();
    return true;
  }
}

// As whoever means harm would leave it: with the checksum of the changed bytes.
std::string resealed(std::string bytes) {
  const size_t mark = bytes.rfind(kSealMark);
  if (mark == bytes.npos) return bytes;
  bytes.resize(mark);
  return bytes + seal_of(bytes);
}

// All bytes of a stream but those of its last chunk, which says how many there were.
size_t checked_bytes(const std::string& bytes) {
  size_t at = 0;
  for (uint32_t chunk = 0; at < bytes.size(); at += chunk) {
    std::memcpy(&chunk, bytes.data() + at, sizeof(chunk));
    chunk += sizeof(chunk);
    if (at + chunk == bytes.size()) break;
  }
  return at;
}

TEST_F(Damage, AnyChangedByteIsRefused) {
  for (const Reader& reader : kReaders) {
    const std::string bytes = good(reader);
    const bool stream = std::string(reader.name).ends_with("photons");
    for (size_t at = 0; at < (stream ? checked_bytes(bytes) : bytes.size()); ++at) {
      std::string changed = bytes;
      changed[at] ^= 16;
      EXPECT_TRUE(refused(reader, put("changed", changed))) << reader.name << " at " << at;
    }
    EXPECT_TRUE(refused(reader, put("longer", bytes + "x"))) << reader.name;
    EXPECT_TRUE(refused(reader, put("twice", bytes + bytes))) << reader.name;
  }
}

TEST_F(Damage, TruncationAtAnyLengthIsRefused) {
  for (const Reader& reader : kReaders) {
    const std::string bytes = good(reader);
    for (size_t length = 0; length < bytes.size(); ++length)
      ASSERT_TRUE(refused(reader, put("cut", bytes.substr(0, length))))
          << reader.name << " of " << length << " bytes";
  }
}

TEST_F(Damage, ChangedBitsNeverCrash) {
  std::mt19937 random(7);
  for (const Reader& reader : kReaders) {
    const std::string bytes = good(reader);
    int refusals = 0;
    for (int i = 0; i < 2000; ++i) {
      std::string changed = bytes;
      for (int flips = 1 + i % 3; flips > 0; --flips)
        changed[random() % changed.size()] ^= static_cast<char>(1 << random() % 8);
      refusals += refused(reader, put("changed", resealed(changed)));
    }
    EXPECT_GT(refusals, 200) << reader.name;
  }
}

TEST_F(Damage, ChangedWordsNeverCrash) {
  for (const Reader& reader : kReaders) {
    const std::string bytes = good(reader);
    for (const uint32_t word : {0u, 1u, 0x7fffffffu, 0x80000000u, 0xffffffffu, 0x7fc00000u})
      for (size_t at = 0; at + 4 <= std::min<size_t>(bytes.size(), 1500); at += 4) {
        std::string changed = bytes;
        std::memcpy(changed.data() + at, &word, 4);
        refused(reader, put("changed", resealed(changed)));
      }
  }
}

TEST_F(Damage, NoiseAndEmptyFilesAreRefused) {
  std::string noise(5000, 0);
  std::mt19937 random(3);
  for (char& c : noise) c = static_cast<char>(random());
  for (const Reader& reader : kReaders) {
    EXPECT_TRUE(
        mentions(error_of([&] { reader.read(put("noise", noise)); }), "no file of Waylight"));
    EXPECT_TRUE(mentions(error_of([&] { reader.read(put("empty", "")); }), "is empty"));
    EXPECT_TRUE(mentions(error_of([&] { reader.read(path("missing")); }), "No such file"));
    EXPECT_TRUE(mentions(error_of([&] { reader.read(path("")); }), "is a folder"));
  }
}

TEST_F(Damage, FileOfAnotherKindIsNamed) {
  const auto message = [this](size_t reader, const char* name) {
    return error_of([&] { kReaders[reader].read(path(name)); });
  };
  EXPECT_TRUE(mentions(message(0, "good.brdf"), "is a BRDF cache (*.brdf), not an illumination"));
  EXPECT_TRUE(mentions(message(1, "good.photons"), "is a photon stream (*.photons), not an illum"));
  EXPECT_TRUE(mentions(message(2, "good.cache"), "is an illumination cache (*.cache), not a BRDF"));
  EXPECT_TRUE(mentions(message(3, "good.exr"), "is an OpenEXR image (*.exr), not a photon stream"));
}

TEST_F(Damage, EveryKindIsIdentifiedByItsContent) {
  EXPECT_EQ(identify_file(path("good.cache")), FileKind::cache);
  EXPECT_EQ(identify_file(path("good.brdf")), FileKind::brdf);
  EXPECT_EQ(identify_file(path("good.photons")), FileKind::photons);
  EXPECT_EQ(identify_file(path("good.exr")), FileKind::exr);
  EXPECT_EQ(identify_file(put("text", "<scene/>")), FileKind::unknown);
  EXPECT_EQ(identify_file(put("empty", "")), FileKind::unknown);
  EXPECT_TRUE(mentions(error_of([&] { identify_file(path("missing")); }), "No such file"));
}

// Sets the first field of the root table, or of the union's table in a chunk.
std::string with_version(std::string bytes, uint32_t version, bool chunk) {
  auto* data = reinterpret_cast<uint8_t*>(bytes.data());
  const auto* root = flatbuffers::GetMutableRoot<flatbuffers::Table>(chunk ? data + 4 : data);
  if (chunk) root = root->GetPointer<const flatbuffers::Table*>(6);
  const uint8_t* field = root->GetAddressOf(4);
  std::memcpy(bytes.data() + (field - data), &version, sizeof(version));
  return bytes;
}

TEST_F(Damage, NewerFormatVersionAsksForANewerRelease) {
  for (const Reader& reader : kReaders) {
    const bool chunk = std::string(reader.name).ends_with("photons");
    const std::string newer = put("newer", resealed(with_version(good(reader), 9, chunk)));
    const std::string message = error_of([&] { reader.read(newer); });
    EXPECT_TRUE(mentions(message, "format version 9")) << message;
    EXPECT_TRUE(mentions(message, "newer release")) << message;
    if (chunk) continue;  // the checksum tells
    EXPECT_FALSE(refused(reader, put("same", resealed(with_version(good(reader), 1, chunk)))));
  }
}

TEST_F(Damage, WritersRefuseWhatReadersWould) {
  CacheFile cache = small_cache();
  cache.cache.cells[0].irradiance = -1;
  EXPECT_TRUE(mentions(error_of([&] { write_cache(path("x"), cache); }), "cell 0"));
  cache = small_cache();
  cache.cache.training.pop_back();
  EXPECT_TRUE(mentions(error_of([&] { write_cache(path("x"), cache); }), "training"));
  BrdfFile brdf = small_brdf();
  brdf.cache.entries[1].component_count = 2;
  EXPECT_TRUE(mentions(error_of([&] { write_brdf(path("x"), brdf); }), "entry 1"));
  brdf = small_brdf();
  brdf.cache.materials[1].entry_count = 4;
  EXPECT_TRUE(mentions(error_of([&] { write_brdf(path("x"), brdf); }), "material \"metal\""));
  brdf = brdf_of_version2();
  brdf.cache.materials[1].widths[1].width = 0.125f;
  EXPECT_TRUE(mentions(error_of([&] { write_brdf(path("x"), brdf); }), "do not ascend"));
  brdf = brdf_of_version2();
  brdf.cache.materials[1].widths[1].entry_count = 3;
  EXPECT_TRUE(mentions(error_of([&] { write_brdf(path("x"), brdf); }), "entries end past"));
  brdf = brdf_of_version2();
  brdf.cache.materials[1].layout = static_cast<EntryLayout>(2);
  EXPECT_TRUE(mentions(error_of([&] { write_brdf(path("x"), brdf); }), "layout 2"));
  for (const auto& spoil : std::vector<std::function<void(Photon&)>>{
           [](Photon& p) { p.position.x() = kInfinity; },
           [](Photon& p) { p.power.y() = std::nanf(""); }, [](Photon& p) { p.power.y() = -1; },
           [](Photon& p) { p.direction *= 2; }, [](Photon& p) { p.normal = Vec3::Zero(); }}) {
    std::vector<Photon> photons = random_photons(3);
    spoil(photons[1]);
    EXPECT_TRUE(mentions(error_of([&] { write_photons(path("x"), photons); }), "photon"));
  }
  for (const auto& spoil : std::vector<std::function<void(MediumPhoton&)>>{
           [](MediumPhoton& p) { p.position.x() = kInfinity; },
           [](MediumPhoton& p) { p.weight.y() = std::nanf(""); },
           [](MediumPhoton& p) { p.weight.z() = -1; }, [](MediumPhoton& p) { p.direction *= 2; }}) {
    std::vector<MediumPhoton> photons = random_medium_photons(3);
    spoil(photons[1]);
    EXPECT_TRUE(mentions(error_of([&] { write_medium_photons(path("x"), {}, photons); }),
                         "a photon in a medium"));
  }
  EXPECT_EQ(file_count(), 6u);  // nothing half-written
}

TEST_F(Damage, CachesOfMediaThatMakeNoSenseAreNotWritten) {
  const auto refused_with = [&](const std::function<void(MediumCache&)>& damage) {
    CacheFile file = medium_cache();
    damage(file.cache.medium);
    return error_of([&] { write_cache(path("x"), file); });
  };
  const auto nan = std::nanf("");
  EXPECT_NO_THROW(write_cache(path("y"), medium_cache()));
  EXPECT_TRUE(mentions(refused_with([](auto& m) { m.nodes[0].axis = 3; }), "media: node 0"));
  EXPECT_TRUE(mentions(refused_with([](auto& m) { m.nodes[0].child = 0; }), "media: node 0"));
  EXPECT_TRUE(mentions(refused_with([](auto& m) { m.cells.pop_back(); }), "media: 3 nodes"));
  EXPECT_TRUE(mentions(refused_with([](auto& m) { m.cells[0].direct.component_count = 3; }),
                       "direct light: components end past"));
  EXPECT_TRUE(mentions(refused_with([](auto& m) { m.cells[0].indirect.component_count = 2; }),
                       "indirect light: weights sum to"));
  EXPECT_TRUE(mentions(refused_with([&](auto& m) { m.cells[0].indirect.fluence = nan; }),
                       "a statistic is negative or not finite"));
  for (const auto& damage : std::vector<std::function<void(VmfComponent&)>>{
           [](VmfComponent& c) { c.weight = -1; }, [](VmfComponent& c) { c.kappa = -1; },
           [](VmfComponent& c) { c.kappa = kInfinity; }, [](VmfComponent& c) { c.mean *= 0.9f; },
           [&](VmfComponent& c) { c.mean.x() = nan; }, [&](VmfComponent& c) { c.kappa = nan; }})
    EXPECT_TRUE(
        mentions(refused_with([&](auto& m) { damage(m.components[0]); }), "valid von Mises"));
  const std::vector<std::pair<std::function<void(MediumCache&)>, std::string>> unfocused = {
      {[](auto& m) { m.focused_cells[0].cell = 2; }, "no cell 2"},
      {[](auto& m) {
         m.focused_cells.push_back({0, 0, 1});
       },
       "out of order"},
      {[](auto& m) {
         m.focused_cells.push_back({1, 0, 1});
       },
       "out of order"},
      {[](auto& m) { m.focused_cells[0].lobe_count = 0; }, "0 focused lobes"},
      {[](auto& m) { m.focused_cells[0].lobe_count = 9; }, "9 focused lobes"},
      {[](auto& m) { m.focused_cells[0].first_lobe = 1; }, "end past the last"},
      {[](auto& m) { m.focused_cells[0].first_lobe = ~0u; }, "end past the last"},
      {[&](auto& m) { m.focused_lobes[1].focus.y() = nan; }, "focused lobe 1"},
      {[](auto& m) { m.focused_lobes[0].size = 0; }, "focused lobe 0"}};
  for (const auto& [damage, fault] : unfocused)
    EXPECT_TRUE(mentions(refused_with(damage), fault)) << fault;
  for (const auto& damage : std::vector<std::function<void(MediumCache&)>>{
           [](MediumCache& m) { m.training.pop_back(); },
           [](MediumCache& m) { m.statistics.pop_back(); },
           [&](MediumCache& m) { m.statistics[1].s1.y() = nan; },
           [](MediumCache& m) { m.training[0].position_m2.x() = -1; },
           [](MediumCache& m) { m.training[0].born = 78; },
           [](MediumCache& m) { m.training[0].indirect.step = 0; },
           [](MediumCache& m) { m.training[0].direct.samples = 0; },
           [&](MediumCache& m) { m.training[0].direct.flux = nan; },
           [](MediumCache& m) { m.training[1].inherited_volume = -1; }})
    EXPECT_TRUE(mentions(refused_with(damage), "media: "));
}

TEST_F(Damage, PhotonsOfMediaInAStreamWithoutThemAreOutOfPlace) {
  const std::string with = read_whole_file(path("good.medium-photons"));
  const std::string without = read_whole_file(path("good.photons"));
  const auto end_of_header = [](const std::string& bytes) {
    uint32_t size;
    std::memcpy(&size, bytes.data(), 4);
    return size + 4;
  };
  const std::string spliced =
      without.substr(0, end_of_header(without)) + with.substr(end_of_header(with));
  EXPECT_TRUE(mentions(error_of([&] { read_photons(put("x", spliced)); }), "out of place"));
}

TEST_F(Damage, StreamsWithoutEndOrWithMoreAfterItAreRefused) {
  const std::string bytes = read_whole_file(path("good.photons"));
  uint32_t size[2];
  std::memcpy(&size[0], bytes.data(), 4);
  std::memcpy(&size[1], bytes.data() + size[0] + 4, 4);
  const size_t block = size[0] + 4, end = block + size[1] + 4;
  const auto message = [&](const std::string& content) {
    return error_of([&] { read_photons(put("x", content)); });
  };
  EXPECT_TRUE(mentions(message(bytes.substr(0, end)), "truncated after 50 photons"));
  EXPECT_TRUE(mentions(message(bytes.substr(0, block)), "truncated after 0 photons"));
  EXPECT_TRUE(mentions(message(bytes + "x"), "data after its end"));
  EXPECT_TRUE(mentions(message(bytes.substr(block)), "does not begin with a header"));
  EXPECT_TRUE(mentions(message(bytes.substr(0, block) + bytes), "out of place"));
  EXPECT_TRUE(mentions(message(bytes.substr(0, block) + bytes.substr(end)), "its end says 50"));
  const std::string huge = bytes.substr(0, block) + std::string("\xff\xff\xff\x7f") + bytes;
  EXPECT_TRUE(mentions(message(huge), "a chunk of 2147483647 bytes"));
}

TEST_F(Damage, FilesBeyondTwoGiBAreRefusedOnBothSides) {
  for (const Reader& reader : {kReaders[0], kReaders[1], kReaders[2]}) {
    std::filesystem::resize_file(put("huge", good(reader)), uintmax_t{1} << 31);  // sparse
    EXPECT_TRUE(mentions(error_of([&] { reader.read(path("huge")); }), "larger than 2 GiB"));
  }
  check_flat_size("x", 2'000'000'000, "make less");
  const std::string message = error_of([] { check_flat_size("x", 3'000'000'000, "make less"); });
  EXPECT_TRUE(mentions(message, "\"x\": 2.8 GiB do not fit")) << message;
  EXPECT_TRUE(mentions(message, "make less")) << message;
}

TEST(FlatStrings, StopsWhenTextIsLongerThanItsBuffer) {
  flatbuffers::FlatBufferBuilder builder;
  builder.Finish(builder.CreateString("ten bytes!"));
  const auto* text = flatbuffers::GetRoot<flatbuffers::String>(builder.GetBufferPointer());
  const std::string path = "x";
  FlatStrings strings(25, path);
  EXPECT_EQ(strings(nullptr), "");
  EXPECT_EQ(strings(text) + strings(text), "ten bytes!ten bytes!");
  EXPECT_TRUE(mentions(error_of([&] { strings(text); }), "more text than bytes"));
}

TEST(RequireSameScene, NamesWhatDiffersAndTheRemedy) {
  const Provenance made_for = small_provenance();
  SceneHash other = made_for.scene;
  require_same_scene("a.cache", made_for, "room.xml", other, SceneParts::all);
  other.geometry = 9, other.media = 9;
  require_same_scene("a.cache", made_for, "hall.xml", other, SceneParts::materials);
  const std::string message = error_of(
      [&] { require_same_scene("a.cache", made_for, "hall.xml", other, SceneParts::all); });
  for (const char* part : {"a.cache", "room.xml", "hall.xml", "geometry and media", "photon-trace"})
    EXPECT_TRUE(mentions(message, part)) << message;
  other = made_for.scene, other.materials = 9, other.emitters = 9;
  EXPECT_TRUE(
      mentions(error_of([&] { require_same_scene("a", made_for, "", other, SceneParts::all); }),
               "materials and emitters"));
  EXPECT_TRUE(mentions(
      error_of([&] { require_same_scene("a", made_for, "", other, SceneParts::materials); }),
      "other materials:"));
}

}  // namespace
}  // namespace waylight
