#pragma once
// The hash of values that are made of numbers, vectors of them, variants and shared pictures. What
// is a struct is taken apart by who hashes it: padding must not enter.

#include <array>
#include <concepts>
#include <map>
#include <memory>
#include <variant>
#include <vector>

#include "formats/content_hash.h"
#include "libguide/image/texture.h"
#include "libguide/medium/medium.h"

namespace waylight {

// Hashes of pictures and grids that were hashed before: many materials may share one.
using SharedHashes = std::map<const void*, uint64_t>;

class ValueHash {
 public:
  explicit ValueHash(SharedHashes& shared) : shared_(shared) {}

  template <typename... T>
  ValueHash& add_all(const T&... values) {
    (add(values), ...);
    return *this;
  }
  uint64_t value() const { return hash_.value(); }

  template <typename T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void add(const T& value) { hash_.add(&value, sizeof(value)); }
  template <typename T>
  void add(const Eigen::PlainObjectBase<T>& value) {
    hash_.add(value.data(), value.size() * sizeof(typename T::Scalar));
  }
  template <typename T, size_t n>
  requires std::is_arithmetic_v<T>
  void add(const std::array<T, n>& values) { hash_.add(values.data(), sizeof(values)); }
  // Of numbers, or of arrays and Eigen vectors of them: types without padding.
  template <typename T>
  void add(const std::vector<T>& values) {
    add(values.size());
    hash_.add(values.data(), values.size() * sizeof(T));
  }

  void add(const Texture& texture);
  void add(const VolumeTexture& texture);
  void add(const std::shared_ptr<const Bitmap>& bitmap);

 private:
  template <typename T, typename AddFields>
  void add_shared(const std::shared_ptr<const T>& object, const AddFields& add_fields);
  void add(const BitmapTexture& texture);
  void add(const CheckerboardTexture& texture);
  void add(const std::shared_ptr<const VolumeGrid>& grid);

  ContentHash hash_;
  SharedHashes& shared_;
};

}  // namespace waylight
