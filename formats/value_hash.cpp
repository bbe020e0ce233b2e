#include "formats/value_hash.h"

namespace waylight {

template <typename T, typename AddFields>
void ValueHash::add_shared(const std::shared_ptr<const T>& object, const AddFields& add_fields) {
  if (!object) return add(uint64_t{0});
  const auto [known, is_new] = shared_.try_emplace(object.get(), 0);
  if (is_new) {
    ValueHash own(shared_);
    add_fields(own, *object);
    known->second = own.value();
  }
  add(known->second);
}

void ValueHash::add(const std::shared_ptr<const Bitmap>& bitmap) {
  add_shared(bitmap, [](ValueHash& hash, const Bitmap& b) {
    const auto& [width, height, pixels, alpha] = b;
    hash.add_all(width, height, pixels, alpha);
  });
}

void ValueHash::add(const std::shared_ptr<const VolumeGrid>& grid) {
  add_shared(grid, [](ValueHash& hash, const VolumeGrid& g) {
    const auto& [voxels, nearest, grid_to_world, values_on_sides] = g;
    std::apply([&](const auto&... parts) { hash.add_all(parts...); }, voxels.parts());
    hash.add_all(grid_to_world);
    if (nearest) hash.add_all(nearest);
    if (values_on_sides) hash.add_all(values_on_sides);
  });
}

void ValueHash::add(const BitmapTexture& texture) {
  const auto& [bitmap, filter, wrap_u, wrap_v] = texture;
  add_all(bitmap, filter, wrap_u, wrap_v);
}

void ValueHash::add(const CheckerboardTexture& texture) {
  const auto& [color0, color1] = texture;
  add_all(color0, color1);
}

void ValueHash::add(const Texture& texture) {
  const auto& [source, to_uv, scale] = texture;
  add_all(source.index(), to_uv.m, scale);
  std::visit([this](const auto& model) { add(model); }, source);
}

void ValueHash::add(const VolumeTexture& texture) {
  add(texture.index());
  std::visit([this](const auto& model) { add(model); }, texture);
}

}  // namespace waylight
