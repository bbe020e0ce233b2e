// Mitsuba's .serialized files: meshes one after the other, each a 4-byte header and a zlib stream,
// then a dictionary of their offsets, then their number.

#include <zlib.h>

#include "formats/file_bytes.h"
#include "formats/mesh_repair.h"

namespace waylight {
namespace {

constexpr uint16_t kMagic = 0x041c;
enum Flags : uint32_t {
  kHasNormals = 0x0001,
  kHasUvs = 0x0002,
  kHasColors = 0x0008,
  kFaceNormals = 0x0010,
  kDoublePrecision = 0x2000,
};

// A zlib stream read in pieces. Memory grows with what the stream really holds, whatever counts
// the file claims.
class InflateReader {
 public:
  InflateReader(std::string_view compressed, std::string path) : path_(std::move(path)) {
    if (inflateInit(&stream_) != Z_OK) fail("\"{}\": zlib cannot start", path_);
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(compressed.data()));
    stream_.avail_in = static_cast<uInt>(std::min<size_t>(compressed.size(), UINT32_MAX));
  }
  ~InflateReader() { inflateEnd(&stream_); }
  InflateReader(const InflateReader&) = delete;
  InflateReader& operator=(const InflateReader&) = delete;

  template <typename T>
  T read() {
    T value;
    fill(reinterpret_cast<char*>(&value), sizeof(T));
    return value;
  }

  template <typename T>
  std::vector<T> read_array(uint64_t count) {
    constexpr uint64_t kBlock = 1 << 16;
    std::vector<T> values;
    while (values.size() < count) {
      const size_t old_size = values.size();
      values.resize(old_size + std::min<uint64_t>(kBlock, count - old_size));
      fill(reinterpret_cast<char*>(values.data() + old_size),
           (values.size() - old_size) * sizeof(T));
    }
    return values;
  }

 private:
  void fill(char* target, size_t count) {
    stream_.next_out = reinterpret_cast<Bytef*>(target);
    stream_.avail_out = static_cast<uInt>(count);
    while (stream_.avail_out > 0) {
      const int status = inflate(&stream_, Z_SYNC_FLUSH);
      if (status == Z_OK && (stream_.avail_in > 0 || stream_.avail_out == 0)) continue;
      if (status == Z_STREAM_END && stream_.avail_out == 0) continue;
      fail("\"{}\": the compressed mesh is {}", path_,
           status == Z_DATA_ERROR ? "corrupt" : "shorter than its counts say");
    }
  }

  std::string path_;
  z_stream stream_{};
};

template <typename Vector, typename Scalar>
std::vector<Vector> read_vectors(InflateReader& reader, uint64_t count) {
  constexpr int kSize = Vector::RowsAtCompileTime;
  const std::vector<Scalar> values = reader.read_array<Scalar>(count * kSize);
  std::vector<Vector> vectors(count);
  for (size_t i = 0; i < count; ++i)
    for (int j = 0; j < kSize; ++j) vectors[i][j] = static_cast<float>(values[i * kSize + j]);
  return vectors;
}

template <typename Scalar>
TriangleMesh read_arrays(InflateReader& reader, uint32_t flags, uint64_t vertices,
                         uint64_t triangles) {
  TriangleMesh mesh;
  mesh.positions = read_vectors<Vec3, Scalar>(reader, vertices);
  if (flags & kHasNormals) mesh.normals = read_vectors<Vec3, Scalar>(reader, vertices);
  if (flags & kHasUvs) mesh.uvs = read_vectors<Vec2, Scalar>(reader, vertices);
  if (flags & kHasColors) read_vectors<Vec3, Scalar>(reader, vertices);
  mesh.triangles = reader.read_array<std::array<uint32_t, 3>>(triangles);
  if (flags & kFaceNormals) mesh.normals.clear();
  return mesh;
}

// The bytes from the header of one mesh on; its zlib stream knows its own end.
std::string_view find_mesh(std::string_view file, int shape_index, int version,
                           const std::string& path) {
  const size_t offset_size = version == 4 ? 8 : 4;
  const uint32_t count = ByteReader(file.substr(file.size() - 4), path).read<uint32_t>();
  if (uint64_t{count} * offset_size > file.size() - 4)
    fail("\"{}\": the dictionary at its end claims {} meshes; the file is truncated or corrupt",
         path, count);
  if (shape_index < 0 || static_cast<uint32_t>(shape_index) >= count)
    fail("\"{}\": there is no shape {}; it holds {}", path, shape_index, count);
  const size_t dictionary = file.size() - 4 - count * offset_size;
  ByteReader entry(file.substr(dictionary + shape_index * offset_size), path);
  const uint64_t begin = version == 4 ? entry.read<uint64_t>() : entry.read<uint32_t>();
  if (begin >= dictionary)
    fail("\"{}\": the offset of shape {} is out of range; the file is truncated or corrupt", path,
         shape_index);
  return file.substr(begin, dictionary - begin);
}

int read_header(ByteReader& bytes) {
  const uint16_t magic = bytes.read<uint16_t>(), version = bytes.read<uint16_t>();
  if (magic != kMagic) fail("\"{}\": is not a serialized mesh", bytes.path());
  if (version != 3 && version != 4)
    fail("\"{}\": version {} of the serialized format is unknown (known: 3, 4)", bytes.path(),
         version);
  return version;
}

}  // namespace

TriangleMesh read_serialized(const std::string& path, int shape_index, MeshRepairs* repairs) {
  const std::string file = read_whole_file(path);
  ByteReader start(file, path);
  const int version = read_header(start);
  ByteReader bytes(find_mesh(file, shape_index, version, path), path);
  const int mesh_version = read_header(bytes);
  InflateReader reader(bytes.take(bytes.remaining()), path);
  const uint32_t flags = reader.read<uint32_t>();
  if (mesh_version == 4)
    while (reader.read<char>() != '\0') continue;  // the name of the shape
  const uint64_t vertices = reader.read<uint64_t>(), triangles = reader.read<uint64_t>();
  if (vertices > UINT32_MAX || triangles > UINT32_MAX)
    fail("\"{}\": shape {} claims {} vertices and {} triangles, more than 2^32", path, shape_index,
         vertices, triangles);
  TriangleMesh mesh = flags & kDoublePrecision
                          ? read_arrays<double>(reader, flags, vertices, triangles)
                          : read_arrays<float>(reader, flags, vertices, triangles);
  finish_mesh(mesh, fmt::format("{} (shape {})", path, shape_index), repairs);
  return mesh;
}

}  // namespace waylight
