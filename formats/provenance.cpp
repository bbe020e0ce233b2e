#include "formats/provenance.h"

#include <fmt/ranges.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "formats/content_hash.h"
#include "libguide/base/error.h"

namespace waylight {
namespace {

std::vector<const char*> differences(const SceneHash& a, const SceneHash& b, SceneParts parts) {
  std::vector<const char*> names;
  const bool all = parts == SceneParts::all;
  if (all && a.geometry != b.geometry) names.push_back("geometry");
  if (a.materials != b.materials) names.push_back("materials");
  if (all && a.emitters != b.emitters) names.push_back("emitters");
  if (all && a.media != b.media) names.push_back("media");
  return names;
}

// From the scene on: to reduce or to train again what was made for another scene would not help.
const char* stages_to_run(SceneParts parts) {
  return parts == SceneParts::all ? "photon-trace and the stages after it" : "brdf-fit";
}

const char* name_or(const std::string& name, const char* otherwise) {
  return name.empty() ? otherwise : name.c_str();
}

}  // namespace

uint64_t hash_file(const std::string& path) {
  if (std::filesystem::is_directory(path)) fail("\"{}\": is a folder, not a file", path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             std::fclose);
  if (!file) fail("\"{}\": cannot open: {}", path, std::strerror(errno));
  ContentHash hash;
  std::vector<char> block(1 << 18);
  while (const size_t count = std::fread(block.data(), 1, block.size(), file.get()))
    hash.add(block.data(), count);
  if (std::ferror(file.get())) fail("\"{}\": cannot read: {}", path, std::strerror(errno));
  return hash.value();
}

void require_same_scene(const std::string& path, const Provenance& provenance,
                        const std::string& scene_name, const SceneHash& scene, SceneParts parts) {
  const std::vector<const char*> differing = differences(provenance.scene, scene, parts);
  if (differing.empty()) return;
  fail(
      "\"{}\": was made for the scene \"{}\", and \"{}\" has other {}: run {} again for this scene",
      path, name_or(provenance.scene_name, "(none)"), name_or(scene_name, "(none)"),
      fmt::join(differing, " and "), stages_to_run(parts));
}

}  // namespace waylight
