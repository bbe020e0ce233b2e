#pragma once
// Small valid caches, photons and provenance for tests of their files.

#include <random>

#include "formats/brdf_file.h"
#include "formats/cache_file.h"
#include "formats/photon_file.h"

namespace waylight::testing {

inline Provenance small_provenance() {
  Provenance p;
  p.tool = "cache-train";
  p.version = "1.2.3";
  p.command_line = "cache-train --photons 'a b.photons'";
  p.seed = 0xfedcba9876543210;
  p.scene_name = "room.xml";
  p.scene = {1, 2, 3, 0xffffffffffffffff};
  p.parents = {{"a b.photons", 77}, {"old.cache", 0x8000000000000000}};
  return p;
}

// Two cells left and right of x = 0 with two and one components, trainable.
inline CacheFile small_cache() {
  CacheFile file{small_provenance(), {}};
  GuideCache& c = file.cache;
  c.scene_bounds = {Vec3(-1, -2, -3), Vec3(1, 2, 3)};
  c.emitted = 5'000'000'000;
  c.passes = 2;
  c.photons = 123;
  c.nodes = {{0, 1, 0}, {0, 0, kLeafAxis}, {0, 1, kLeafAxis}};
  c.components = {{0.25f, 0.1f, 0.2f, 0.01f, 0, 0.02f},
                  {0.75f, -0.3f, 0, 0.04f, 0.01f, 0.01f},
                  {1, 0.5f, 0.6f, 0.02f, -0.01f, 0.03f}};
  c.cells.resize(2);
  c.cells[0] = {Vec3::UnitX(), 2.5f, 100, 50, 0.99f, 0, 2};
  c.cells[1] = {-Vec3::UnitZ(), 1.5f, 23, 20, 1, 2, 1};
  c.statistics = {
      {0.25f, 0.025f, 0.05f, 0.01f, 0, 0.02f}, {0.75f, 1, 2, 3, 4, 5}, {1, 6, 7, 8, 9, 10}};
  c.training.resize(2);
  for (int i = 0; i < 2; ++i) {
    CellTraining& t = c.training[i];
    t.position_mean = Vec3(1, 2, 3 + i), t.position_m2 = Vec3(4, 5, 6);
    t.position_cross = Vec3(-7, 8, 9), t.normal_mean = Vec3(0, 1, 0), t.normal_m2 = Vec3(1, 2, 3);
    t.count = 10, t.flux = 1e300, t.born = 5, t.inherited_area = 2;
    t.step = 3, t.samples = 50, t.weight_sum = 1.0 / 3, t.weight_sum2 = 0.125;
  }
  return file;
}

// The same with two cells of a medium, below and above z = 1: one lobe of indirect and two of
// direct light in the first, two focused lobes in the second.
inline CacheFile medium_cache() {
  CacheFile file = small_cache();
  MediumCache& m = file.cache.medium;
  m.emitted = 4'000'000'000;
  m.photons = 77;
  m.nodes = {{1, 1, 2}, {0, 0, kLeafAxis}, {0, 1, kLeafAxis}};
  m.components = {
      {1, Vec3(0.6f, 0, 0.8f), 20}, {0.25f, Vec3::UnitX(), 0}, {0.75f, -Vec3::UnitY(), 1e4f}};
  m.cells.resize(2);
  m.cells[0] = {{2.5f, 60, 40, 0, 1}, {0.5f, 40, 30, 1, 2}};
  m.cells[1] = {{0.25f, 0, 0, 3, 0}, {0, 0, 0, 3, 0}};
  m.focused_cells = {{1, 0, 2}};
  m.focused_lobes = {{0.25f, Vec3(4, -5, 6), 0.5f}, {0.75f, Vec3(1e6f, 0, 0), 1e5f}};
  m.statistics = {{1, Vec3(0.57f, 0, 0.76f)}, {0.25f, Vec3::Zero()}, {0.75f, Vec3(0, -0.75f, 0)}};
  m.training.resize(2);
  MediumTraining& t = m.training[0];
  t.position_mean = Vec3(1, 2, 3), t.position_m2 = Vec3(4, 5, 6), t.position_cross = Vec3(-7, 8, 9);
  t.count = 70, t.born = 7, t.inherited_volume = 2, t.occupied = 0x8000000000000001;
  t.indirect = {1e300, 3, 40, 1.0 / 3, 0.125};
  t.direct = {2, 1, 30, 3, 4};
  return file;
}

inline BrdfFile small_brdf() {
  BrdfFile file{small_provenance(), {}};
  BrdfCache& c = file.cache;
  c.components = {{0.25f, 0.1f, 0.2f, 0.01f, 0, 0.02f},
                  {0.75f, -0.3f, 0, 0.04f, 0.01f, 0.01f},
                  {1, 0.5f, 0.6f, 0.02f, -0.01f, 0.03f}};
  c.entries = {{0, 2, 0.125f}, {2, 1, 0.5f}, {0, 0, 2}};
  c.materials = {{4, "wall", "diffuse", true, 1, 1, EntryLayout::elevations, {}},
                 {7, "metal", "roughconductor", false, 0, 3, EntryLayout::elevations, {}}};
  return file;
}

// What came with version 2: entries by direction, and widths.
inline BrdfFile brdf_of_version2() {
  BrdfFile file = small_brdf();
  MaterialFit& metal = file.cache.materials[1];
  metal.layout = EntryLayout::fibonacci;
  metal.widths = {{0.125f, 0, 1}, {0.5f, 1, 2}};
  return file;
}

inline Vec3 random_unit(std::mt19937& random) {
  std::normal_distribution<float> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

inline std::vector<Photon> random_photons(size_t count, uint32_t seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform;
  std::vector<Photon> photons(count);
  for (Photon& p : photons) {
    p.position = Vec3(uniform(random), uniform(random), uniform(random));
    p.direction = random_unit(random);
    p.normal = random_unit(random);
    p.power = Color(uniform(random), uniform(random), 0);
    p.path_depth = random() % 64;
  }
  return photons;
}

inline std::vector<MediumPhoton> random_medium_photons(size_t count, uint32_t seed = 1) {
  std::vector<MediumPhoton> in_media;
  for (const Photon& p : random_photons(count, seed))
    in_media.push_back({p.position, p.direction, p.power, p.path_depth});
  return in_media;
}

inline PhotonHeader small_header() {
  return {small_provenance(), {{Vec3(-1, -2, -3), Vec3(1, 2, 3)}, 5'000'000'000, 3}};
}

inline void write_photons(const std::string& path, const std::vector<Photon>& photons) {
  PhotonWriter writer(path, small_header());
  writer.write(photons);
  PhotonCounts counts;
  counts.emitted = 5'000'000'000, counts.stored = photons.size(), counts.left_scene = 11;
  counts.absorbed = 12, counts.too_deep = 13, counts.invalid = 14;
  writer.finish(counts);
}

// Photons of surfaces, then those of media.
inline void write_medium_photons(const std::string& path, const std::vector<Photon>& photons,
                                 const std::vector<MediumPhoton>& in_media) {
  PhotonHeader header = small_header();
  header.stream.media = true;
  PhotonWriter writer(path, header);
  writer.write(photons);
  writer.write(in_media);
  PhotonCounts counts;
  counts.stored = photons.size(), counts.in_media = in_media.size();
  writer.finish(counts);
}

// All photons of a stream; throws the reader's Error.
inline std::vector<Photon> read_photons(const std::string& path) {
  PhotonReader reader(path);
  std::vector<Photon> all, chunk;
  while (reader.read(&chunk)) all.insert(all.end(), chunk.begin(), chunk.end());
  return all;
}

}  // namespace waylight::testing
