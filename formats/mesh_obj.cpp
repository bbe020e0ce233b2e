#include <tiny_obj_loader.h>

#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <unordered_map>

#include "formats/file_bytes.h"
#include "formats/mesh_repair.h"

namespace waylight {
namespace {

// Collects the statements of an OBJ file into one mesh.
class ObjBuilder {
 public:
  explicit ObjBuilder(std::string path) : path_(std::move(path)) {}

  void add_position(const Vec3& p) { positions_.push_back(p); }
  void add_normal(const Vec3& n) { normals_.push_back(n); }
  void add_uv(const Vec2& uv) { uvs_.push_back(uv); }

  void add_face(const tinyobj::index_t* corners, int count) {
    ++faces_;
    if (count < 3)
      fail("\"{}\": face {} has {} corners, at least 3 are needed", path_, faces_, count);
    polygon_.clear();
    for (int i = 0; i < count; ++i) polygon_.push_back(vertex(corners[i]));
    triangulate_polygon(polygon_, mesh_.positions, path_, mesh_.triangles);
  }

  TriangleMesh finish(MeshRepairs* repairs) {
    if (!has_normals_) mesh_.normals.clear();
    if (!has_uvs_) mesh_.uvs.clear();
    finish_mesh(mesh_, path_, repairs);
    return std::move(mesh_);
  }

 private:
  static constexpr uint32_t kAbsent = ~0u;

  // What a vertex of the mesh is made of: indices of its position, texture coordinate and normal.
  using Corner = std::array<uint32_t, 3>;
  struct CornerHash {
    size_t operator()(const Corner& corner) const {
      uint64_t hash = 0;  // odd multiplier of the golden ratio [Knuth, TAOCP 3, 6.4]
      for (const uint32_t index : corner)
        hash = (hash ^ index) * 0x9e3779b97f4a7c15, hash ^= hash >> 32;
      return hash;
    }
  };

  // 1-based, or negative: counted back from the latest; 0 stands for absent.
  uint32_t resolve(int index, size_t count, const char* what) const {
    const int64_t resolved = index > 0 ? int64_t{index} - 1 : static_cast<int64_t>(count) + index;
    if (index == 0 || resolved < 0 || resolved >= static_cast<int64_t>(count))
      fail("\"{}\": face {} uses {} {}, but {} are defined before it", path_, faces_, what, index,
           count);
    return static_cast<uint32_t>(resolved);
  }

  uint32_t vertex(const tinyobj::index_t& corner) {
    const uint32_t p = resolve(corner.vertex_index, positions_.size(), "position");
    const uint32_t uv = corner.texcoord_index
                            ? resolve(corner.texcoord_index, uvs_.size(), "texture coordinate")
                            : kAbsent;
    const uint32_t n =
        corner.normal_index ? resolve(corner.normal_index, normals_.size(), "normal") : kAbsent;
    const auto index = static_cast<uint32_t>(mesh_.positions.size());
    const auto [known, is_new] = vertices_.try_emplace({p, uv, n}, index);
    if (is_new) add_vertex(p, uv, n);
    return known->second;
  }

  void add_vertex(uint32_t p, uint32_t uv, uint32_t n) {
    mesh_.positions.push_back(positions_[p]);
    mesh_.uvs.push_back(uv == kAbsent ? Vec2(0, 0) : uvs_[uv]);
    mesh_.normals.push_back(n == kAbsent ? Vec3(0, 0, 0) : normals_[n]);
    has_uvs_ |= uv != kAbsent;
    has_normals_ |= n != kAbsent;
  }

  std::string path_;
  std::vector<Vec3> positions_, normals_;
  std::vector<Vec2> uvs_;
  std::unordered_map<Corner, uint32_t, CornerHash> vertices_;  // of the mesh
  std::vector<uint32_t> polygon_;
  TriangleMesh mesh_;
  size_t faces_ = 0;
  bool has_normals_ = false, has_uvs_ = false;
};

// The next word of a line, which is taken off it; empty at its end.
std::string_view next_word(std::string_view& line) {
  constexpr std::string_view kBlank = " \t\r";
  line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlank));
  line.remove_prefix(word.size());
  return word;
}

template <typename Number>
bool parses(std::string_view word, Number& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

// Exporters write normals of faces without area as NaN, which are repaired as those of length 0.
bool is_number(std::string_view word, bool of_normal) {
  double value = 0;
  return parses(word, value) && (std::isfinite(value) || (of_normal && std::isnan(value)));
}

// "7", "7/2", "7//3", "7/2/3" or with negative numbers.
bool is_corner(std::string_view word) {
  for (int part = 0; part < 3; ++part) {
    const std::string_view number = word.substr(0, word.find('/'));
    int value = 0;
    if (!parses(number, value) && !(part == 1 && number.empty())) return false;
    if (number.size() == word.size()) return true;
    word.remove_prefix(number.size() + 1);
  }
  return false;
}

// The numbers that tinyobjloader reads of a line; it takes what is none for 0.
int numbers_of(std::string_view statement) {
  if (statement == "v" || statement == "vn") return 3;
  return statement == "vt" ? 1 : 0;
}

void check_line(const std::string& path, size_t number, std::string_view line) {
  const std::string_view statement = next_word(line);
  for (int i = numbers_of(statement); i > 0; --i)
    if (const std::string_view word = next_word(line); !is_number(word, statement == "vn"))
      fail("\"{}\":{}: {} has \"{}\" where a finite number is needed", path, number, statement,
           word);
  if (statement != "f") return;
  for (std::string_view word; !(word = next_word(line)).empty();)
    if (!is_corner(word))
      fail("\"{}\":{}: f has \"{}\" where the numbers of a corner are needed", path, number, word);
}

// Without a byte order mark and comments, which tinyobjloader takes for corners of faces.
void blank_comments(std::string& text) {
  if (text.starts_with("\xef\xbb\xbf")) text.replace(0, 3, "   ");
  for (size_t at = 0; (at = text.find('#', at)) != text.npos;)
    for (; at < text.size() && text[at] != '\n'; ++at) text[at] = ' ';
}

// The next line of a text, which is taken off it.
std::string_view next_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  return line;
}

void check_lines(const std::string& path, std::string_view text) {
  for (size_t number = 1; !text.empty(); ++number) check_line(path, number, next_line(text));
}

ObjBuilder& builder(void* user_data) { return *static_cast<ObjBuilder*>(user_data); }

}  // namespace

TriangleMesh read_obj(const std::string& path, MeshRepairs* repairs) {
  std::string bytes = read_whole_file(path);
  blank_comments(bytes);
  check_lines(path, bytes);
  std::istringstream text(std::move(bytes));
  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = [](void* data, float x, float y, float z, float) {
    builder(data).add_position({x, y, z});
  };
  callbacks.normal_cb = [](void* data, float x, float y, float z) {
    builder(data).add_normal({x, y, z});
  };
  callbacks.texcoord_cb = [](void* data, float u, float v, float) { builder(data).add_uv({u, v}); };
  callbacks.index_cb = [](void* data, tinyobj::index_t* corners, int count) {
    builder(data).add_face(corners, count);
  };
  ObjBuilder mesh(path);
  std::string warning, error;
  if (!tinyobj::LoadObjWithCallback(text, callbacks, &mesh, nullptr, &warning, &error))
    fail("\"{}\": {}", path, error);
  return mesh.finish(repairs);
}

bool has_obj_materials(const std::string& path) {
  const std::string bytes = read_whole_file(path);
  bool has_library = false;
  for (std::string_view text = bytes; !text.empty();) {
    std::string_view line = next_line(text);
    const std::string_view statement = next_word(line);
    has_library |= statement == "mtllib";
    if (has_library && statement == "usemtl") return true;
  }
  return false;
}

}  // namespace waylight
