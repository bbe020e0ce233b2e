#pragma once
// Colours that vary over a surface. A closed set of models; plain data, no virtual calls.

#include <array>
#include <memory>
#include <variant>

#include "libguide/image/image.h"

namespace waylight {

// Affine map of texture coordinates: u' = m[0] u + m[1] v + m[2], v' = m[3] u + m[4] v + m[5].
struct UvTransform {
  std::array<float, 6> m{1, 0, 0, 0, 1, 0};

  Vec2 operator()(const Vec2& uv) const {
    return {m[0] * uv.x() + m[1] * uv.y() + m[2], m[3] * uv.x() + m[4] * uv.y() + m[5]};
  }
};

enum class WrapMode { repeat, mirror, clamp, zero, one };
enum class TextureFilter { bilinear, nearest };

// v = 0 is the bottom row of the picture.
struct BitmapTexture {
  std::shared_ptr<const Bitmap> bitmap;
  TextureFilter filter = TextureFilter::bilinear;
  WrapMode wrap_u = WrapMode::repeat, wrap_v = WrapMode::repeat;
};

struct CheckerboardTexture {
  Color color0, color1;  // color0 where floor(2u) + floor(2v) is even (Mitsuba's convention)
};

struct Texture {
  std::variant<Color, CheckerboardTexture, BitmapTexture> source;
  UvTransform to_uv;
  float scale = 1;

  Texture() : source(Color(Color::Zero())) {}
  Texture(const Color& color) : source(color) {}  // implicit: a colour is a constant texture
  explicit Texture(float value) : source(Color(Color::Constant(value))) {}

  Color eval(const Vec2& uv) const;
  float eval_scalar(const Vec2& uv) const;  // mean of the channels
  // d(mean of channels)/du and /dv by central differences of about one texel: for bump maps.
  Vec2 gradient(const Vec2& uv) const;
  Color mean() const;  // over the unit square of the source
  bool constant() const { return std::holds_alternative<Color>(source); }
};

}  // namespace waylight
