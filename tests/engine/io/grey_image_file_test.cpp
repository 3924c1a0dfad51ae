#include "engine/io/grey_image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"

namespace orthonav::engine {
namespace {

using orthonav::test::content_of;
using orthonav::test::test_data;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string refusal(std::string_view content) {
  const auto image = parse_grey(content, "x");
  return image ? "" : image.error().message;
}

TEST(GreyImageFile, ReadsPgmAsItIs) {
  const auto image =
      parse_grey("P5 # a note\n 3\t2\n# another\n255\n\x01\x02\x03\xfe\xff\x80", "x");
  ASSERT_TRUE(image.ok()) << image.error().message;
  EXPECT_EQ(image->width_px, 3);
  EXPECT_EQ(image->height_px, 2);
  EXPECT_THAT(image->pixels, ::testing::ElementsAre(1, 2, 3, 254, 255, 128));
}

TEST(GreyImageFile, StretchesAPgmWithFewerLevels) {
  const auto image = parse_grey("P5 3 1 15\n\x05\x0f\xff", "x");
  ASSERT_TRUE(image.ok());
  EXPECT_THAT(image->pixels, ::testing::ElementsAre(85, 255, 255));
}

TEST(GreyImageFile, RefusesDamagedPgm) {
  EXPECT_THAT(refusal("P5 3 2 255\n12345"), HasSubstr("cut short (5 of 6 bytes)"));
  EXPECT_THAT(refusal("P5 3 2 65535\n123456789012"), HasSubstr("largest value of 65535"));
  EXPECT_THAT(refusal("P5 3 2 0\n123456"), HasSubstr("must be 1-255"));
  EXPECT_THAT(refusal("P5 0 2 255\n123456"), HasSubstr("empty (0 x 2 px)"));
  EXPECT_THAT(refusal("P5 -3 2 255\n123456"), HasSubstr("empty"));
  EXPECT_THAT(refusal("P5 99999999 99999999 255\n1"), HasSubstr("limit 100 megapixels"));
  EXPECT_THAT(refusal("P5 99999999999999999999 1 255\n1"), HasSubstr("header is damaged"));
  for (const char* text : {"P5", "P5 3", "P5 3 2", "P5 3 2 255", "P5 a b 255\n",
                           "P5 3 2 255x1234567", "P5 # endless"}) {
    EXPECT_THAT(refusal(text), HasSubstr("header is damaged")) << text;
  }
}

TEST(GreyImageFile, RefusesWhatIsNoImage) {
  EXPECT_THAT(refusal(""), HasSubstr("file is empty"));
  EXPECT_THAT(refusal("GIF89a"), StartsWith("x: not a PNG, JPEG or binary PGM"));
  EXPECT_FALSE(load_grey("/nonexistent/image.png").ok());
  EXPECT_FALSE(load_grey(std::filesystem::temp_directory_path().string()).ok());
}

/// The level of a PNG of one grey pixel of this depth, read.
int level_read(int bits, const std::vector<std::uint8_t>& level, bool says_gamma) {
  std::string content;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &content,
      [](png_structp to, png_bytep bytes, std::size_t count) {
        static_cast<std::string*>(png_get_io_ptr(to))
            ->append(reinterpret_cast<const char*>(bytes), count);
      },
      nullptr);
  png_set_IHDR(png, info, 1, 1, bits, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (says_gamma) {
    png_set_gAMA(png, info, 1.0);
  }
  png_write_info(png, info);
  png_write_row(png, level.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  const auto image = parse_grey(content, "x");
  return image ? image->pixels.front() : -1;
}

TEST(GreyImageFile, TakesLevelsOfAPngAsTheyAreInEitherDepthWhateverItsGamma) {
  for (const bool says_gamma : {false, true}) {
    EXPECT_EQ(level_read(8, {0x40}, says_gamma), 0x40);
    EXPECT_EQ(level_read(16, {0x40, 0x40}, says_gamma), 0x40);
    EXPECT_EQ(level_read(16, {0x40, 0xf0}, says_gamma), 0x41) << "the nearest of 255";
    EXPECT_EQ(level_read(16, {0xff, 0xff}, says_gamma), 0xff);
  }
}

// A photograph as PNG and one as JPEG; every cut and every damaged byte must be refused or give the
// whole picture, never a part of one.
class Photograph : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    content_ = content_of(test_data(std::string("recordings/") + GetParam()));
    if (content_.empty()) {
      GTEST_SKIP() << "needs shared/recordings/" << GetParam();
    }
  }
  std::string content_;
};

TEST_P(Photograph, IsReadWhole) {
  const auto image = parse_grey(content_, "x");
  ASSERT_TRUE(image.ok()) << image.error().message;
  EXPECT_GT(image->width_px, 600);
  EXPECT_EQ(image->pixels.size(), static_cast<std::size_t>(image->width_px * image->height_px));
}

TEST_P(Photograph, IsRefusedWhenCutShort) {
  for (const double fraction : {0.001, 0.01, 0.3, 0.7, 0.99}) {
    const auto bytes = static_cast<std::size_t>(fraction * static_cast<double>(content_.size()));
    EXPECT_THAT(refusal(std::string_view(content_).substr(0, bytes)), HasSubstr("is damaged"))
        << fraction;
  }
}

TEST_P(Photograph, SurvivesDamageAnywhere) {
  for (std::size_t at = 8; at < content_.size(); at += 1 + content_.size() / 60) {
    std::string damaged = content_;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x5a);
    const auto image = parse_grey(damaged, "x");
    if (image) {
      EXPECT_EQ(image->pixels.size(), static_cast<std::size_t>(image->width_px * image->height_px));
    } else {
      EXPECT_EQ(image.error().message.find('\n'), std::string::npos);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(GreyImageFile, Photograph,
                         ::testing::Values("dt-apriltags/test_image_multiple_02.png",
                                           "apriltag-testdata/33369213973_9d9bb4cc96_c.jpg"),
                         [](const auto& each) { return each.index == 0 ? "Png" : "Jpeg"; });

}  // namespace
}  // namespace orthonav::engine
