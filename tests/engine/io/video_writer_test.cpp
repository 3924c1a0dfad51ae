#include "engine/io/video_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace orthonav::engine {
namespace {

namespace fs = std::filesystem;

RgbaImage picture(int width_px, int height_px, std::uint8_t value) {
  RgbaImage image;
  image.width_px = width_px;
  image.height_px = height_px;
  image.pixels.assign(static_cast<std::size_t>(4 * width_px * height_px), value);
  return image;
}

TEST(VideoWriter, PutsTheFileInPlaceOnlyWhenFinished) {
  const std::string path = ::testing::TempDir() + "video_writer_test.mp4";
  fs::remove(path);
  auto writer = VideoWriter::create(path, {.width_px = 64, .height_px = 48});
  ASSERT_TRUE(writer.ok()) << writer.error().message;
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE((*writer)->write(picture(64, 48, static_cast<std::uint8_t>(20 * i))).ok());
  }
  EXPECT_FALSE(fs::exists(path));
  ASSERT_TRUE((*writer)->finish().ok());
  EXPECT_TRUE(fs::exists(path));
  EXPECT_FALSE(fs::exists(path + ".part"));
  EXPECT_GT(fs::file_size(path), 500U);
}

TEST(VideoWriter, LeavesNothingBehindWhenDropped) {
  const std::string path = ::testing::TempDir() + "video_writer_dropped.mp4";
  {
    auto writer = VideoWriter::create(path, {.width_px = 64, .height_px = 48});
    ASSERT_TRUE(writer.ok());
    ASSERT_TRUE((*writer)->write(picture(64, 48, 100)).ok());
  }
  EXPECT_FALSE(fs::exists(path));
  EXPECT_FALSE(fs::exists(path + ".part"));
}

TEST(VideoWriter, RefusesOddSizesWrongPicturesAndBadFolders) {
  EXPECT_FALSE(VideoWriter::create("x.mp4", {.width_px = 63, .height_px = 48}).ok());
  const auto nowhere = VideoWriter::create("/no/such/folder/x.mp4", {});
  ASSERT_FALSE(nowhere.ok());
  EXPECT_THAT(nowhere.error().message, ::testing::HasSubstr("/no/such/folder/x.mp4"));
  const std::string path = ::testing::TempDir() + "video_writer_size.mp4";
  auto writer = VideoWriter::create(path, {.width_px = 64, .height_px = 48});
  ASSERT_TRUE(writer.ok());
  EXPECT_FALSE((*writer)->write(picture(32, 48, 0)).ok());
  EXPECT_FALSE((*writer)->finish().ok());
}

TEST(VideoWriter, TwoAtOnceDoNotWriteIntoOneAnother) {
  const std::string path = ::testing::TempDir() + "video_writer_two.mp4";
  fs::remove(path);
  auto one = VideoWriter::create(path, {.width_px = 64, .height_px = 48});
  auto two = VideoWriter::create(path, {.width_px = 64, .height_px = 48});
  ASSERT_TRUE(one.ok() && two.ok());
  ASSERT_TRUE((*one)->write(picture(64, 48, 10)).ok());
  ASSERT_TRUE((*one)->finish().ok());
  const auto size = fs::file_size(path);
  two->reset();
  EXPECT_EQ(fs::file_size(path), size) << "the dropped one took nothing away";
}

}  // namespace
}  // namespace orthonav::engine
