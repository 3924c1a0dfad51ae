#include "render/compare.h"

#include <gtest/gtest.h>

namespace orthonav::render {
namespace {

RgbaImage grey(int width_px, int height_px, std::uint8_t value) {
  return {width_px, height_px,
          std::vector<std::uint8_t>(4 * static_cast<std::size_t>(width_px) * height_px, value)};
}

LabelImage blank(int width_px, int height_px) {
  return {width_px, height_px, std::vector<Label>(static_cast<std::size_t>(width_px) * height_px)};
}

TEST(Compare, FindsEqualImagesAlike) {
  EXPECT_TRUE(compare_colour(grey(9, 7, 80), grey(9, 7, 80)).alike());
  EXPECT_TRUE(compare_labels(blank(9, 7), blank(9, 7)).alike());
}

TEST(Compare, AllowsTwoStepsAChannelAndNotThree) {
  const RgbaImage expected = grey(9, 7, 80);
  RgbaImage actual = expected;
  actual.pixels[4 * (3 * 9 + 5) + 1] = 82;
  EXPECT_EQ(compare_colour(expected, actual).outside, 0u);
  actual.pixels[4 * (3 * 9 + 5) + 1] = 83;
  const ColourDifference difference = compare_colour(expected, actual);
  EXPECT_EQ(difference.outside, 1u);
  EXPECT_EQ(difference.worst, 3);
  EXPECT_EQ(difference.worst_x_px, 5);
  EXPECT_EQ(difference.worst_y_px, 3);
}

TEST(Compare, SeesDarkerAsWellAsBrighter) {
  const RgbaImage expected = grey(4, 4, 80);
  RgbaImage actual = expected;
  actual.pixels[0] = 77;
  EXPECT_EQ(compare_colour(expected, actual).outside, 1u);
}

TEST(Compare, AllowsAsManyPixelsAsProcessorsDifferInAndNoMore) {
  const RgbaImage expected = grey(4, 4, 80);
  RgbaImage actual = expected;
  for (std::size_t pixel = 0; pixel < kEdgePixels; ++pixel) {
    actual.pixels[4 * pixel] = 255;
    EXPECT_TRUE(compare_colour(expected, actual).alike());
  }
  actual.pixels[4 * kEdgePixels] = 254;
  EXPECT_FALSE(compare_colour(expected, actual).alike());
  EXPECT_EQ(compare_colour(expected, actual).text(), "4 pixels differ, the worst by 175 at (0, 0)");
}

TEST(Compare, RefusesOtherSizesAndTornImages) {
  EXPECT_FALSE(compare_colour(grey(9, 7, 80), grey(7, 9, 80)).alike());
  RgbaImage torn = grey(9, 7, 80);
  torn.pixels.pop_back();
  EXPECT_FALSE(compare_colour(torn, torn).alike());
  EXPECT_FALSE(compare_labels(blank(9, 7), blank(7, 9)).alike());
  EXPECT_EQ(compare_labels(blank(9, 7), blank(7, 9)).text(), "sizes differ");
}

TEST(Compare, AllowsNoLabelToDiffer) {
  LabelImage actual = blank(9, 7);
  actual.labels[2 * 9 + 4] = 501;
  const LabelDifference difference = compare_labels(blank(9, 7), actual);
  EXPECT_FALSE(difference.alike());
  EXPECT_EQ(difference.text(), "1 pixels differ, the first at (4, 2): label 0 became 501");
}

TEST(Compare, MagnifiesDifferencesWithoutOverflow) {
  RgbaImage actual = grey(2, 1, 80);
  actual.pixels[0] = 83;
  actual.pixels[5] = 200;
  const RgbaImage difference = difference_image(grey(2, 1, 80), actual);
  EXPECT_EQ(difference.pixels, (std::vector<std::uint8_t>{48, 0, 0, 255, 0, 255, 0, 255}));
}

TEST(LabelExtent, IsTheMeanOfPixelCentresAndTheBox) {
  LabelImage image = blank(8, 6);
  image.labels[2 * 8 + 3] = image.labels[2 * 8 + 4] = image.labels[3 * 8 + 3] =
      image.labels[3 * 8 + 4] = 7;
  const auto extent = extent_of(image, 7);
  ASSERT_TRUE(extent);
  EXPECT_DOUBLE_EQ(extent->centre_x_px, 4.0);
  EXPECT_DOUBLE_EQ(extent->centre_y_px, 3.0);
  EXPECT_EQ(extent->left_px, 3);
  EXPECT_EQ(extent->right_px, 5);
  EXPECT_EQ(extent->pixels, 4u);
  EXPECT_FALSE(extent_of(image, 8));
}

}  // namespace
}  // namespace orthonav::render
