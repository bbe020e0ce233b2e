#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <cstdint>
#include <cstdio>
#include <cstring>

#include "formats/file_bytes.h"
#include "formats/image_codecs.h"
#include "libguide/base/error.h"

namespace waylight {
namespace {

std::vector<std::string> channel_names(const Imf::Header& header, const std::string& path) {
  std::vector<std::string> names;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
      fail("\"{}\": channel \"{}\" is subsampled; convert it to R, G, B", path, c.name());
    names.emplace_back(c.name());
  }
  return names;
}

void copy_attributes(const Imf::Header& header, std::map<std::string, std::string>& attributes) {
  for (auto a = header.begin(); a != header.end(); ++a)
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute()))
      attributes[a.name()] = text->value();
}

// Slices of an interleaved image whose first pixel is at (x0, y0) of the file's data window.
Imf::FrameBuffer float_slices(Image& image, int x0, int y0) {
  Imf::FrameBuffer buffer;
  const int64_t x_stride = static_cast<int64_t>(sizeof(float) * image.channels.size());
  const int64_t y_stride = x_stride * image.width;
  // OpenEXR wants the address of pixel (0, 0), which may lie outside the array.
  const auto origin =
      reinterpret_cast<intptr_t>(image.pixels.data()) - x0 * x_stride - y0 * y_stride;
  for (size_t i = 0; i < image.channels.size(); ++i)
    buffer.insert(
        image.channels[i],
        Imf::Slice(Imf::FLOAT,
                   reinterpret_cast<char*>(origin + static_cast<intptr_t>(i * sizeof(float))),
                   x_stride, y_stride));
  return buffer;
}

Image read_first_part(const std::string& path, std::map<std::string, std::string>* attributes) {
  Imf::InputFile file(path.c_str());
  const Imf::Header& header = file.header();
  const Imath::Box2i window = header.dataWindow();
  const std::vector<std::string> names = channel_names(header, path);
  const int64_t width = int64_t{window.max.x} - window.min.x + 1;
  const int64_t height = int64_t{window.max.y} - window.min.y + 1;
  check_image_size(path, width, height, names.size());
  Image image(static_cast<int>(width), static_cast<int>(height), names);
  file.setFrameBuffer(float_slices(image, window.min.x, window.min.y));
  file.readPixels(window.min.y, window.max.y);
  if (attributes) copy_attributes(header, *attributes);
  return image;
}

Imf::Header make_header(const Image& image, const std::map<std::string, std::string>& attributes,
                        Imf::PixelType type) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const std::string& name : image.channels) header.channels().insert(name, Imf::Channel(type));
  for (const auto& [name, value] : attributes) header.insert(name, Imf::StringAttribute(value));
  return header;
}

// Halves are rounded by OpenEXR's own type; values beyond its range would become infinite.
std::vector<Imath::half> to_halves(const Image& image) {
  constexpr float kLargest = 65504;
  std::vector<Imath::half> halves;
  halves.reserve(image.pixels.size());
  for (float v : image.pixels)
    halves.emplace_back(std::isfinite(v) ? std::clamp(v, -kLargest, kLargest) : v);
  return halves;
}

// OpenEXR writes the end of a file in a destructor, where what goes wrong is lost: it writes into
// memory, and the file is written at once.
class MemoryStream : public Imf::OStream {
 public:
  explicit MemoryStream(const std::string& path) : OStream(path.c_str()) {}

  void write(const char* data, int count) override {
    const auto size = static_cast<size_t>(count);
    if (bytes_.size() < position_ + size) bytes_.resize(position_ + size);
    std::memcpy(bytes_.data() + position_, data, size);
    position_ += size;
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override { position_ = position; }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  size_t position_ = 0;
};

template <typename T>
void write_pixels(MemoryStream& stream, const Image& image, const Imf::Header& header,
                  Imf::PixelType type, const T* pixels) {
  Imf::FrameBuffer buffer;
  const size_t stride = sizeof(T) * image.channels.size();
  for (size_t i = 0; i < image.channels.size(); ++i)
    buffer.insert(image.channels[i],
                  Imf::Slice(type, reinterpret_cast<char*>(const_cast<T*>(pixels + i)), stride,
                             stride * image.width));
  Imf::OutputFile file(stream, header);
  file.setFrameBuffer(buffer);
  file.writePixels(image.height);
}

}  // namespace

bool is_exr(const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) return false;  // the reader that is chosen then says why
  unsigned char magic[4] = {};
  const size_t count = std::fread(magic, 1, 4, file);
  std::fclose(file);
  return count == 4 && magic[0] == 0x76 && magic[1] == 0x2f && magic[2] == 0x31 && magic[3] == 0x01;
}

Image read_exr(const std::string& path, std::map<std::string, std::string>* attributes) {
  try {
    return read_first_part(path, attributes);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    fail("\"{}\": cannot be read as OpenEXR: {}", path, e.what());
  }
}

void write_exr(const std::string& path, const Image& image,
               const std::map<std::string, std::string>& attributes, bool half) {
  MemoryStream stream(path);
  try {
    const Imf::PixelType type = half ? Imf::HALF : Imf::FLOAT;
    const Imf::Header header = make_header(image, attributes, type);
    if (half)
      write_pixels(stream, image, header, type, to_halves(image).data());
    else
      write_pixels(stream, image, header, type, image.pixels.data());
  } catch (const std::exception& e) {
    fail("\"{}\": cannot be written as OpenEXR: {}", path, e.what());
  }
  write_whole_file(path, stream.bytes());
}

}  // namespace waylight
