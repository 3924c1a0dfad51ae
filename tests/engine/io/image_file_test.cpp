#include "engine/io/image_file.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

namespace orthonav::engine {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class ImageFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / (std::string("orthonav_image_file_") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Every byte value in every channel.
  static RgbaImage picture() {
    RgbaImage image{37, 29, {}};
    for (int i = 0; i < 37 * 29; ++i) {
      for (const int factor : {1, 3, 7, 11}) {
        image.pixels.push_back(static_cast<std::uint8_t>(i * factor % 256));
      }
    }
    return image;
  }
  fs::path folder_;
};

TEST_F(ImageFile, ComesBackToTheBit) {
  const fs::path path = folder_ / "a.png";
  ASSERT_TRUE(write_png(path, picture()).ok());
  const auto read = read_png(path);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(*read, picture());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "nothing else is left";
}

TEST_F(ImageFile, LabelsComeBackExactly) {
  LabelImage labels{3, 2, {0, 1, 501, 1101, 65536, 0xffffff}};
  const auto picture = picture_of_labels(labels);
  ASSERT_TRUE(picture.ok());
  const fs::path path = folder_ / "labels.png";
  ASSERT_TRUE(write_png(path, *picture).ok());
  const auto read = read_png(path);
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(labels_of_picture(*read), labels);
  labels.labels[3] = 0x1000000;
  EXPECT_FALSE(picture_of_labels(labels).ok());
}

TEST_F(ImageFile, NamesWhatCantBeRead) {
  EXPECT_THAT(read_png(folder_ / "none.png").error().message, HasSubstr("none.png: can't be read"));
  std::ofstream(folder_ / "text.png") << "no picture";
  EXPECT_THAT(read_png(folder_ / "text.png").error().message, HasSubstr("not a readable PNG"));
  EXPECT_FALSE(read_png(folder_).ok());
}

TEST_F(ImageFile, RefusesEveryTruncation) {
  const fs::path path = folder_ / "a.png";
  ASSERT_TRUE(write_png(path, picture()).ok());
  const auto whole = fs::file_size(path);
  for (const auto left :
       {whole - 13, whole / 2, std::uintmax_t{40}, std::uintmax_t{8}, std::uintmax_t{0}}) {
    fs::resize_file(path, left);
    EXPECT_FALSE(read_png(path).ok()) << left << " of " << whole << " bytes";
  }
}

TEST_F(ImageFile, LeavesNothingWhereItCantWrite) {
  EXPECT_FALSE(write_png(folder_ / "no" / "a.png", picture()).ok());
  EXPECT_FALSE(write_png(folder_ / "a.png", {}).ok());
  RgbaImage torn = picture();
  torn.pixels.pop_back();
  EXPECT_FALSE(write_png(folder_ / "a.png", torn).ok());
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace orthonav::engine
