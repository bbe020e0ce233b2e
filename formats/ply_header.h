#pragma once
// The header of a PLY file: what its body holds, in which order and types.

#include <string>
#include <string_view>
#include <vector>

namespace waylight {

enum class PlyEncoding { ascii, little_endian, big_endian };
enum class PlyType { none, int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::none;
  PlyType count_type = PlyType::none;  // not none: a list, preceded by its length
};

struct PlyElement {
  std::string name;
  size_t count = 0;
  std::vector<PlyProperty> properties;

  // Index of the first property that has one of the names, or -1.
  int find(std::initializer_list<std::string_view> names) const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  size_t body_offset = 0;
};

size_t ply_size(PlyType type);  // bytes

// Throws Error naming path and line of the header.
PlyHeader parse_ply_header(std::string_view file, const std::string& path);

}  // namespace waylight
