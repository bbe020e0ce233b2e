#include <algorithm>
#include <charconv>

#include "formats/file_bytes.h"
#include "formats/mesh_repair.h"
#include "formats/ply_header.h"

namespace waylight {
namespace {

// The numbers of a PLY body one after the other.
class PlyBody {
 public:
  PlyBody(std::string_view bytes, PlyEncoding encoding, const std::string& path)
      : bytes_(bytes, path), text_(bytes), encoding_(encoding), path_(path) {}

  double next(PlyType type) {
    if (encoding_ == PlyEncoding::ascii) return next_word();
    switch (type) {
      case PlyType::int8:
        return binary<int8_t>();
      case PlyType::uint8:
        return binary<uint8_t>();
      case PlyType::int16:
        return binary<int16_t>();
      case PlyType::uint16:
        return binary<uint16_t>();
      case PlyType::int32:
        return binary<int32_t>();
      case PlyType::uint32:
        return binary<uint32_t>();
      case PlyType::float32:
        return binary<float>();
      case PlyType::float64:
        return binary<double>();
      case PlyType::none:
        break;
    }
    fail("\"{}\": a property has no type", path_);
  }

  // An integer in [0, limit].
  uint32_t next_index(PlyType type, uint32_t limit, const char* what) {
    const double value = next(type);
    if (!(value >= 0 && value <= limit) || value != std::floor(value))
      fail("\"{}\": {} {} is out of range, at most {} is possible", path_, what, value, limit);
    return static_cast<uint32_t>(value);
  }

  size_t remaining() const {
    return encoding_ == PlyEncoding::ascii ? text_.size() : bytes_.remaining();
  }

 private:
  template <typename T>
  double binary() {
    T value = bytes_.read<T>();
    if (encoding_ == PlyEncoding::big_endian) {
      char* bytes = reinterpret_cast<char*>(&value);
      std::reverse(bytes, bytes + sizeof(T));
    }
    return static_cast<double>(value);
  }

  double next_word() {
    constexpr std::string_view kSpace = " \t\r\n";
    text_.remove_prefix(std::min(text_.find_first_not_of(kSpace), text_.size()));
    const std::string_view word = text_.substr(0, text_.find_first_of(kSpace));
    if (word.empty()) fail("\"{}\": truncated: more numbers are expected", path_);
    text_.remove_prefix(word.size());
    const std::string_view digits = word.front() == '+' ? word.substr(1) : word;
    double value = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || stop != digits.data() + digits.size())
      fail("\"{}\": \"{}\" is no number of double precision", path_, word.substr(0, 40));
    return value;
  }

  ByteReader bytes_;
  std::string_view text_;
  PlyEncoding encoding_;
  const std::string& path_;
};

// A row takes at least one byte per number, so a count that the file cannot hold is found before
// memory is reserved for it.
void check_count(const PlyElement& element, const PlyBody& body, PlyEncoding encoding,
                 const std::string& path) {
  size_t row_bytes = 0;
  for (const PlyProperty& property : element.properties) {
    const PlyType first =
        property.count_type == PlyType::none ? property.type : property.count_type;
    row_bytes += encoding == PlyEncoding::ascii ? 1 : ply_size(first);
  }
  if (row_bytes && element.count > body.remaining() / row_bytes)
    fail("\"{}\": {} of element \"{}\" are announced, but {} bytes are left", path, element.count,
         element.name, body.remaining());
  if (element.count >= UINT32_MAX)
    fail("\"{}\": {} of element \"{}\" are too many", path, element.count, element.name);
}

void skip_property(const PlyProperty& property, PlyBody& body) {
  uint32_t count = 1;
  if (property.count_type != PlyType::none)
    count = body.next_index(property.count_type, UINT32_MAX, "list length");
  for (uint32_t i = 0; i < count; ++i) body.next(property.type);
}

void skip_element(const PlyElement& element, PlyBody& body) {
  if (element.properties.empty()) return;
  for (size_t row = 0; row < element.count; ++row)
    for (const PlyProperty& property : element.properties) skip_property(property, body);
}

void read_vertices(const PlyElement& element, PlyBody& body, const std::string& path,
                   TriangleMesh& mesh) {
  const int x = element.find({"x"}), y = element.find({"y"}), z = element.find({"z"});
  if (x < 0 || y < 0 || z < 0) fail("\"{}\": its vertices have no x, y and z", path);
  const int nx = element.find({"nx"}), ny = element.find({"ny"}), nz = element.find({"nz"});
  const int u = element.find({"u", "s", "texture_u", "texture_s"});
  const int v = element.find({"v", "t", "texture_v", "texture_t"});
  const bool has_normals = nx >= 0 && ny >= 0 && nz >= 0, has_uvs = u >= 0 && v >= 0;
  mesh.positions.reserve(element.count);
  std::vector<float> row(element.properties.size());
  for (size_t i = 0; i < element.count; ++i) {
    for (size_t p = 0; p < row.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (property.count_type == PlyType::none)
        row[p] = static_cast<float>(body.next(property.type));
      else
        skip_property(property, body);
    }
    mesh.positions.emplace_back(row[x], row[y], row[z]);
    if (has_normals) mesh.normals.emplace_back(row[nx], row[ny], row[nz]);
    if (has_uvs) mesh.uvs.emplace_back(row[u], row[v]);
  }
}

void read_faces(const PlyElement& element, PlyBody& body, const std::string& path,
                TriangleMesh& mesh) {
  const int indices = element.find({"vertex_indices", "vertex_index"});
  if (indices < 0 || element.properties[indices].count_type == PlyType::none)
    fail("\"{}\": its faces have no list \"vertex_indices\"", path);
  if (mesh.positions.empty()) fail("\"{}\": it has faces before or without vertices", path);
  const uint32_t last = static_cast<uint32_t>(mesh.positions.size() - 1);
  std::vector<uint32_t> polygon;
  for (size_t i = 0; i < element.count; ++i) {
    for (int p = 0; p < static_cast<int>(element.properties.size()); ++p) {
      const PlyProperty& property = element.properties[p];
      if (p != indices) {
        skip_property(property, body);
        continue;
      }
      const uint32_t corners = body.next_index(property.count_type, UINT32_MAX, "list length");
      polygon.clear();
      for (uint32_t c = 0; c < corners; ++c)
        polygon.push_back(body.next_index(property.type, last, "vertex index"));
      if (corners < 3)
        fail("\"{}\": face {} has {} corners, at least 3 are needed", path, i, corners);
      triangulate_polygon(polygon, mesh.positions, path, mesh.triangles);
    }
  }
}

}  // namespace

TriangleMesh read_ply(const std::string& path, MeshRepairs* repairs) {
  const std::string file = read_whole_file(path);
  const PlyHeader header = parse_ply_header(file, path);
  PlyBody body(std::string_view(file).substr(header.body_offset), header.encoding, path);
  TriangleMesh mesh;
  for (const PlyElement& element : header.elements) {
    check_count(element, body, header.encoding, path);
    if (element.name == "vertex")
      read_vertices(element, body, path, mesh);
    else if (element.name == "face")
      read_faces(element, body, path, mesh);
    else
      skip_element(element, body);
  }
  finish_mesh(mesh, path, repairs);
  return mesh;
}

}  // namespace waylight
