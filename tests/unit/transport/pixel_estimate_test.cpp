#include "libguide/transport/pixel_estimate.h"

#include <gtest/gtest.h>

namespace waylight {
namespace {

Preview flat_preview(int columns, int rows, float luminance) {
  Preview preview;
  preview.columns = columns;
  preview.rows = rows;
  PreviewBlock block;
  block.luminance = luminance;
  block.normal = Vec3::UnitZ();
  block.depth = 1;
  preview.blocks.assign(static_cast<size_t>(columns) * rows, block);
  return preview;
}

TEST(PixelEstimates, AreTheSameEverywhereUnderAnEvenPreview) {
  for (const auto& [columns, rows] : {std::pair(1, 1), std::pair(5, 1), std::pair(6, 4)}) {
    const PixelEstimates estimates(flat_preview(columns, rows, 3));
    for (int y = 0; y < rows * Preview::kBlock; ++y)
      for (int x = 0; x < columns * Preview::kBlock; ++x) ASSERT_NEAR(estimates.at(x, y), 3, 1e-5);
  }
}

TEST(PixelEstimates, OneFireflyAtMostDoublesWhatIsAround) {
  Preview preview = flat_preview(9, 9, 1);
  preview.blocks[preview.index(4, 4)].luminance = 1e6f;
  for (const float value : filter_preview(preview)) EXPECT_LE(value, 2);
}

TEST(PixelEstimates, LightDoesNotLeakAcrossAnEdge) {
  Preview preview = flat_preview(8, 8, 1);
  for (int y = 0; y < 8; ++y)
    for (int x = 4; x < 8; ++x) {
      preview.blocks[preview.index(x, y)].normal = Vec3::UnitX();
      preview.blocks[preview.index(x, y)].luminance = 100;
    }
  const std::vector<float> values = filter_preview(preview);
  EXPECT_NEAR(values[preview.index(3, 4)], 1, 0.1);
  EXPECT_NEAR(values[preview.index(4, 4)], 100, 0.1);
}

TEST(PixelEstimates, AreZeroWithoutAPreviewAndWhereItIsBlack) {
  EXPECT_EQ(PixelEstimates().at(3, 5), 0);
  EXPECT_EQ(PixelEstimates(flat_preview(4, 4, 0)).at(7, 7), 0);
}

TEST(PixelEstimates, AWindowOfThePreviewGivesTheValuesOfTheWhole) {
  Preview whole = flat_preview(20, 1, 1);
  for (int x = 0; x < 20; ++x) whole.blocks[x].luminance = static_cast<float>(x * x);
  Preview window = whole;
  window.first_column = 4;
  window.columns = 16;
  window.blocks.erase(window.blocks.begin(), window.blocks.begin() + 4);
  const int first_pixel = (4 + Preview::kMargin) * Preview::kBlock;
  for (int x = first_pixel; x < 80; ++x)
    EXPECT_EQ(PixelEstimates(window).at(x, 0), PixelEstimates(whole).at(x, 0));
}

}  // namespace
}  // namespace waylight
