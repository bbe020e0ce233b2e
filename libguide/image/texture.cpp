#include "libguide/image/texture.h"

namespace waylight {
namespace {

// Texture coordinate brought near the unit interval so that pixel indices stay small integers;
// what is not finite counts as 0. Beyond [-1, 2] all modes but repeat and mirror are constant.
float reduce(float u, WrapMode mode) {
  if (!std::isfinite(u)) return 0;
  if (mode == WrapMode::repeat) return u - std::floor(u);
  if (mode == WrapMode::mirror) return u - 2 * std::floor(0.5f * u);
  return std::clamp(u, -1.0f, 2.0f);
}

// Pixel index for i in [-size - 1, 2 size + 1], or -1 where the border colour applies.
int wrap(int i, int size, WrapMode mode) {
  if (i >= 0 && i < size) return i;
  switch (mode) {
    case WrapMode::repeat:
      return ((i % size) + size) % size;
    case WrapMode::mirror: {
      const int j = ((i % (2 * size)) + 2 * size) % (2 * size);
      return j < size ? j : 2 * size - 1 - j;
    }
    case WrapMode::clamp:
      return std::clamp(i, 0, size - 1);
    default:
      return -1;
  }
}

Color texel(const BitmapTexture& texture, int x, int y) {
  const Bitmap& bitmap = *texture.bitmap;
  const int column = wrap(x, bitmap.width, texture.wrap_u);
  const int row = wrap(y, bitmap.height, texture.wrap_v);
  if (column >= 0 && row >= 0) return bitmap.at(column, row);
  const WrapMode border = column < 0 ? texture.wrap_u : texture.wrap_v;
  return Color::Constant(border == WrapMode::one ? 1.0f : 0.0f);
}

Color eval_source(const Color& color, const Vec2& /*uv*/) { return color; }

Color eval_source(const CheckerboardTexture& texture, const Vec2& uv) {
  const bool right = reduce(uv.x(), WrapMode::repeat) >= 0.5f;
  const bool upper = reduce(uv.y(), WrapMode::repeat) >= 0.5f;
  return right == upper ? texture.color0 : texture.color1;
}

// Pixel centres lie at half integers; row 0, on top, is the largest v.
Color eval_source(const BitmapTexture& texture, const Vec2& uv) {
  const float x = reduce(uv.x(), texture.wrap_u) * texture.bitmap->width;
  const float y = (1 - reduce(uv.y(), texture.wrap_v)) * texture.bitmap->height;
  if (texture.filter == TextureFilter::nearest)
    return texel(texture, static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
  const float left = std::floor(x - 0.5f), top = std::floor(y - 0.5f);
  const float a = x - 0.5f - left, b = y - 0.5f - top;
  const int i = static_cast<int>(left), j = static_cast<int>(top);
  return (1 - b) * ((1 - a) * texel(texture, i, j) + a * texel(texture, i + 1, j)) +
         b * ((1 - a) * texel(texture, i, j + 1) + a * texel(texture, i + 1, j + 1));
}

Vec2 gradient_of_source(const Color& /*color*/, const Vec2& /*uv*/) { return Vec2::Zero(); }

// Constant but on edges of no area.
Vec2 gradient_of_source(const CheckerboardTexture& /*texture*/, const Vec2& /*uv*/) {
  return Vec2::Zero();
}

Vec2 gradient_of_source(const BitmapTexture& texture, const Vec2& uv) {
  const float width = texture.bitmap->width, height = texture.bitmap->height;
  const Vec2 du(0.5f / width, 0), dv(0, 0.5f / height);
  const float along_u = (eval_source(texture, uv + du) - eval_source(texture, uv - du)).mean();
  const float along_v = (eval_source(texture, uv + dv) - eval_source(texture, uv - dv)).mean();
  return {along_u * width, along_v * height};
}

Color mean_of_source(const Color& color) { return color; }

Color mean_of_source(const CheckerboardTexture& texture) {
  return 0.5f * (texture.color0 + texture.color1);
}

Color mean_of_source(const BitmapTexture& texture) {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (const Color& pixel : texture.bitmap->pixels) sum += pixel.cast<double>();
  return (sum / static_cast<double>(texture.bitmap->pixels.size())).cast<float>();
}

}  // namespace

Color Texture::eval(const Vec2& uv) const {
  if (const Color* color = std::get_if<Color>(&source)) return scale * *color;
  const Vec2 at = to_uv(uv);
  return scale * std::visit([&](const auto& s) { return Color(eval_source(s, at)); }, source);
}

float Texture::eval_scalar(const Vec2& uv) const { return eval(uv).mean(); }

Vec2 Texture::gradient(const Vec2& uv) const {
  const Vec2 at = to_uv(uv);
  const Vec2 g = std::visit([&](const auto& s) { return gradient_of_source(s, at); }, source);
  const std::array<float, 6>& m = to_uv.m;  // chain rule through the affine map
  return scale * Vec2(m[0] * g.x() + m[3] * g.y(), m[1] * g.x() + m[4] * g.y());
}

Color Texture::mean() const {
  return scale * std::visit([](const auto& s) { return Color(mean_of_source(s)); }, source);
}

}  // namespace waylight
