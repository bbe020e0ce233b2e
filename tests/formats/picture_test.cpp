// Pictures whose formats do not say where they end.

#include <gtest/gtest.h>

#include "formats/image_io.h"
#include "formats/temporary_files.h"
#include "libguide/base/error.h"

namespace waylight {
namespace {

constexpr int kSize = 8;

// Uncompressed, 24 bits; runs: run-length coded, one run to a row.
std::string tga(bool runs) {
  std::string bytes(18, '\0');
  bytes[2] = runs ? 10 : 2;
  bytes[12] = bytes[14] = kSize;
  bytes[16] = 24;
  for (int i = 0; i < (runs ? kSize : kSize * kSize); ++i) {
    if (runs) bytes += static_cast<char>(128 + kSize - 1);
    bytes += {'\x40', '\x60', '\x7f'};
  }
  return bytes;
}

// Radiance, RGBE: each channel of a row a run of the same value, or flat pixels.
std::string hdr(bool runs) {
  std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 8\n";
  for (int y = 0; y < kSize; ++y) {
    if (!runs) {
      for (int x = 0; x < kSize; ++x) bytes += {'\x40', '\x60', '\x7f', '\x7e'};
      continue;
    }
    bytes += {'\x02', '\x02', '\0', kSize};
    for (const char value : {'\x40', '\x60', '\x7f', '\x7e'})
      bytes += {static_cast<char>(128 + kSize), value};
  }
  return bytes;
}

class PictureTest : public testing::TemporaryFiles {
 protected:
  // Where the pixels begin, all that is cut from there on is an error that names the file.
  void expect_refused_where_cut(const std::string& ending, const std::string& bytes,
                                size_t header) {
    const std::string path = put("picture" + ending, bytes);
    const Image whole = read_image(path);
    EXPECT_EQ(whole.width, kSize);
    EXPECT_EQ(whole.height, kSize);
    for (size_t length = header; length < bytes.size(); ++length) {
      put("picture" + ending, bytes.substr(0, length));
      EXPECT_THROW(read_image(path), Error) << length << " bytes";
    }
  }
};

TEST_F(PictureTest, TgaCutShortIsRefused) { expect_refused_where_cut(".tga", tga(false), 18); }

TEST_F(PictureTest, RunLengthCodedTgaCutShortIsRefused) {
  expect_refused_where_cut(".tga", tga(true), 18);
}

TEST_F(PictureTest, HdrCutShortIsRefused) {
  expect_refused_where_cut(".hdr", hdr(false), hdr(false).size() - 4 * kSize * kSize);
}

TEST_F(PictureTest, RunLengthCodedHdrCutShortIsRefused) {
  expect_refused_where_cut(".hdr", hdr(true), hdr(true).size() - 12 * kSize);
}

// Softimage PIC with a packet of no known kind, after which stb_image 2.27 reads a picture from
// address 0.
TEST_F(PictureTest, FormatsThatAreNotPromisedAreRefused) {
  std::string pic = "\x53\x80\xf6\x34" + std::string(84, '\0') + "PICT";
  pic += {'\0', kSize, '\0', kSize};
  pic += std::string(8, '\0') + std::string{'\0', '\x08', '\x03', '\xe0', '\0'};
  const std::string bmp = "BM" + std::string(64, '\0'), gif = "GIF89a" + std::string(64, '\0');
  for (const std::string& bytes : {pic, bmp, gif}) {
    const std::string error = testing::error_of([&] { read_image(put("picture", bytes)); });
    EXPECT_TRUE(testing::mentions(error, "is not a picture that can be read")) << error;
  }
}

// Small enough that all of it is still in a buffer when the file is closed.
TEST_F(PictureTest, ExrOnAFullDiskIsAnError) {
  const Image image(2, 2, {"R", "G", "B"});
  const std::string error = testing::error_of([&] { write_exr("/dev/full", image); });
  EXPECT_TRUE(testing::mentions(error, "cannot write: No space left")) << error;
}

}  // namespace
}  // namespace waylight
