// Pictures by stb_image, and PNG writing.

#include <array>
#include <cstring>

#include "formats/atomic_file.h"
#include "formats/file_bytes.h"
#include "formats/image_codecs.h"
#include "formats/srgb.h"

// What is promised and no more: 2.27 crashes on pictures of other formats that are damaged.
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_ONLY_HDR
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_FAILURE_USERMSG
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image.h>
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace waylight {
namespace {

template <typename T>
using Pixels = std::unique_ptr<T, decltype(&stbi_image_free)>;

struct Source {
  const std::string& path;
  const stbi_uc* data;
  int size;
  int width = 0, height = 0, channels = 0;

  int wanted() const { return channels == 2 || channels == 4 ? 4 : 3; }
  size_t values() const { return static_cast<size_t>(width) * height * wanted(); }
  // PNG and JPEG say where they end.
  bool has_end() const {
    return size > 1 && (data[0] == 0x89 || (data[0] == 0xff && data[1] == 0xd8));
  }
};

// The bytes of a picture and after them a value again and again, as much as any picture of its size
// may take: at the end of its bytes stb_image would read zeros, in a run-length code for ever.
class PaddedBytes {
 public:
  PaddedBytes(const Source& source, stbi_uc pad)
      : source_(source), pad_(pad), end_(source.size + 4 * source.values() + kMaxHeader) {}

  static const stbi_io_callbacks* callbacks() {
    static constexpr stbi_io_callbacks kCallbacks = {
        [](void* self, char* data, int size) { return of(self).read(data, size); },
        [](void* self, int n) { of(self).position_ += n; },
        [](void* self) { return int{of(self).position_ >= of(self).end_}; }};
    return &kCallbacks;
  }

 private:
  static constexpr size_t kMaxHeader = 1 << 16;

  static PaddedBytes& of(void* self) { return *static_cast<PaddedBytes*>(self); }
  int read(char* data, int size) {
    const size_t known = source_.size, left = end_ - std::min(position_, end_);
    const size_t count = std::min<size_t>(size, left);
    for (size_t i = 0; i < count; ++i, ++position_)
      data[i] = static_cast<char>(position_ < known ? source_.data[position_] : pad_);
    return static_cast<int>(count);
  }

  const Source& source_;
  stbi_uc pad_;
  size_t position_ = 0, end_;
};

template <typename T>
using Loader = T* (*)(const stbi_io_callbacks*, void*, int*, int*, int*, int);

template <typename T>
Pixels<T> load_pixels(const Source& source, Loader<T> load, stbi_uc pad) {
  int width = 0, height = 0, channels = 0;
  PaddedBytes bytes(source, pad);
  Pixels<T> pixels(
      load(PaddedBytes::callbacks(), &bytes, &width, &height, &channels, source.wanted()),
      stbi_image_free);
  if (!pixels) fail("\"{}\": cannot be decoded: {}", source.path, stbi_failure_reason());
  return pixels;
}

// A picture that depends on what comes after its bytes is cut short.
template <typename T>
Pixels<T> load_whole(const Source& source, Loader<T> load) {
  Pixels<T> pixels = load_pixels(source, load, 1);
  if (source.has_end()) return pixels;
  const Pixels<T> again = load_pixels(source, load, 2);
  if (std::memcmp(pixels.get(), again.get(), source.values() * sizeof(T)) != 0)
    fail("\"{}\": is truncated", source.path);
  return pixels;
}

// Interleaved numbers of the picture with `wanted` channels, decoded by `colour` and `alpha`.
template <typename T, typename ColourDecoder>
Image decode(const Source& source, Loader<T> load, const ColourDecoder& colour, float alpha_scale) {
  const int wanted = source.wanted();
  const Pixels<T> pixels = load_whole(source, load);
  Image image(source.width, source.height, {"R", "G", "B"});
  if (wanted == 4) image = Image(source.width, source.height, {"R", "G", "B", "A"});
  for (size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = i % wanted == 3 ? static_cast<float>(pixels.get()[i]) * alpha_scale
                                      : colour(pixels.get()[i]);
  return image;
}

template <typename T>
std::vector<float> decoding_table(bool srgb) {
  constexpr int kMax = std::numeric_limits<T>::max();
  std::vector<float> table(kMax + 1);
  for (int i = 0; i <= kMax; ++i) {
    const float value = static_cast<float>(i) / kMax;
    table[i] = srgb ? srgb_to_linear(value) : value;
  }
  return table;
}

template <typename T>
Image decode_integers(const Source& source, Loader<T> load, bool srgb) {
  const std::vector<float> table = decoding_table<T>(srgb);
  return decode<T>(
      source, load, [&](T v) { return table[v]; }, 1.0f / std::numeric_limits<T>::max());
}

Color display_color(const Image& image, const std::array<int, 3>& channels, int x, int y) {
  return {image.at(x, y, channels[0]), image.at(x, y, channels[1]), image.at(x, y, channels[2])};
}

uint8_t quantise(float linear) {
  if (!(linear > 0)) return 0;  // NaN too
  return static_cast<uint8_t>(linear_to_srgb(std::min(linear, 1.0f)) * 255 + 0.5f);
}

std::vector<uint8_t> quantise(const Bitmap& picture, float exposure) {
  const float scale = std::exp2(exposure);
  std::vector<uint8_t> bytes;
  bytes.reserve(picture.pixels.size() * 3);
  for (const Color& color : picture.pixels)
    for (float value : color) bytes.push_back(quantise(value * scale));
  return bytes;
}

void append_bytes(void* context, void* data, int size) {
  static_cast<std::string*>(context)->append(static_cast<const char*>(data), size);
}

}  // namespace

Image read_picture(const std::string& path, ColorSpace space) {
  const std::string bytes = read_whole_file(path);
  if (bytes.size() > std::numeric_limits<int>::max()) fail("\"{}\": is larger than 2 GiB", path);
  Source source{path, reinterpret_cast<const stbi_uc*>(bytes.data()),
                static_cast<int>(bytes.size())};
  if (!stbi_info_from_memory(source.data, source.size, &source.width, &source.height,
                             &source.channels))
    fail("\"{}\": is not a picture that can be read (PNG, JPEG, TGA, HDR, EXR): {}", path,
         stbi_failure_reason());
  check_image_size(path, source.width, source.height, source.wanted());
  const bool integers_srgb = space != ColorSpace::linear;
  if (stbi_is_hdr_from_memory(source.data, source.size))
    return decode<float>(
        source, stbi_loadf_from_callbacks,
        [&](float v) { return space == ColorSpace::srgb ? srgb_to_linear(v) : v; }, 1);
  if (stbi_is_16_bit_from_memory(source.data, source.size))
    return decode_integers<stbi_us>(source, stbi_load_16_from_callbacks, integers_srgb);
  return decode_integers<stbi_uc>(source, stbi_load_from_callbacks, integers_srgb);
}

std::string png_bytes(const Bitmap& picture, float exposure) {
  const std::vector<uint8_t> bytes = quantise(picture, exposure);
  std::string png;
  if (!stbi_write_png_to_func(append_bytes, &png, picture.width, picture.height, 3, bytes.data(),
                              picture.width * 3))
    fail("a picture of {} x {} pixels cannot be encoded as PNG", picture.width, picture.height);
  return png;
}

std::string jpeg_bytes(const Bitmap& picture, float exposure, int quality) {
  const std::vector<uint8_t> bytes = quantise(picture, exposure);
  std::string jpeg;
  if (!stbi_write_jpg_to_func(append_bytes, &jpeg, picture.width, picture.height, 3, bytes.data(),
                              quality))
    fail("a picture of {} x {} pixels cannot be encoded as JPEG", picture.width, picture.height);
  return jpeg;
}

void write_png(const std::string& path, const Image& image, float exposure) {
  std::array<int, 3> channels{image.find("R"), image.find("G"), image.find("B")};
  if (image.find("Y") >= 0 && channels[0] < 0) channels.fill(image.find("Y"));
  if (*std::min_element(channels.begin(), channels.end()) < 0)
    fail("\"{}\": the picture has no channels R, G, B to write", path);
  Bitmap picture{image.width, image.height, {}, {}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      picture.pixels.push_back(display_color(image, channels, x, y));
  write_whole_file(path, png_bytes(picture, exposure));
}

}  // namespace waylight
