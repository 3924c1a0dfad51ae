#include "hal/replay/png_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/random.h"

namespace orthonav::replay::png_picture_test {
namespace {

using ::testing::HasSubstr;

/// A grey ramp with the noise of a camera.
GreyImage noisy(int width_px, int height_px, double sd) {
  Random random(7);
  GreyImage image(width_px, height_px);
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      const double grey = 40.0 + 150.0 * x / width_px + sd * random.normal();
      image.at(x, y) = static_cast<std::uint8_t>(std::clamp(grey, 0.0, 255.0));
    }
  }
  return image;
}

std::string encoded(const GreyImage& image) {
  std::vector<std::uint8_t> bytes{1, 2, 3};  // of the picture before
  EXPECT_TRUE(encode_png(image, bytes).ok());
  return {bytes.begin(), bytes.end()};
}

TEST(PngPicture, LosesNothing) {
  for (const auto& [width_px, height_px] : {std::pair(640, 480), {1, 1}, {7, 3}, {3, 700}}) {
    const GreyImage image = noisy(width_px, height_px, 40.0);
    const std::string bytes = encoded(image);
    const auto header = parse_png_header(bytes);
    ASSERT_TRUE(header.ok()) << header.error().message;
    EXPECT_EQ(header->width_px, width_px);
    EXPECT_EQ(header->height_px, height_px);
    EXPECT_TRUE(header->grey8);
    GreyImage read = image;
    read.pixels.assign(image.pixels.size(), 1);
    const Status decoded = decode_png(bytes, read);
    ASSERT_TRUE(decoded.ok()) << decoded.error().message;
    EXPECT_TRUE(read == image);
  }
}

// The entropy of differences of noise of 2 grey levels is about 3.5 bits a pixel.
TEST(PngPicture, HalvesAPictureOfACamera) {
  const GreyImage image = noisy(640, 480, 2.0);
  EXPECT_LT(static_cast<double>(encoded(image).size()),
            0.55 * static_cast<double>(image.pixels.size()));
}

TEST(PngPicture, SaysWhatIsDamaged) {
  const GreyImage image = noisy(64, 48, 2.0);
  const std::string whole = encoded(image);
  GreyImage read = image;
  std::string bytes = whole;
  bytes[bytes.size() / 2] = static_cast<char>(~bytes[bytes.size() / 2]);
  const Status damaged = decode_png(bytes, read);
  ASSERT_FALSE(damaged.ok());
  EXPECT_FALSE(damaged.error().message.empty());
  const Status cut = decode_png(std::string_view(whole).substr(0, whole.size() / 2), read);
  ASSERT_FALSE(cut.ok());
  EXPECT_THAT(cut.error().message, HasSubstr("ends too early"));
  GreyImage smaller = noisy(48, 64, 2.0);
  EXPECT_FALSE(decode_png(whole, smaller).ok());
  EXPECT_FALSE(parse_png_header(std::string_view(whole).substr(0, 20)).ok());
}

}  // namespace
}  // namespace orthonav::replay::png_picture_test
