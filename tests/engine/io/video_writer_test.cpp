#include "engine/io/video_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "tests/support/full_disk.h"
#include "tests/support/temporary_folder.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

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
  EXPECT_EQ(nowhere.error().code, ErrorCode::kNotFound);
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

/// How many pictures the library finds in a film; -1 where it can't be opened.
int pictures_in(const std::string& path) {
  AVFormatContext* film = nullptr;
  if (avformat_open_input(&film, path.c_str(), nullptr, nullptr) < 0) {
    return -1;
  }
  const AVCodec* decoder = avcodec_find_decoder(AV_CODEC_ID_H264);
  AVCodecContext* codec = avcodec_alloc_context3(decoder);
  avcodec_parameters_to_context(codec, film->streams[0]->codecpar);
  avcodec_open2(codec, decoder, nullptr);
  AVPacket* packet = av_packet_alloc();
  AVFrame* frame = av_frame_alloc();
  int count = 0;
  bool more = true;
  while (more) {
    more = av_read_frame(film, packet) >= 0;
    avcodec_send_packet(codec, more ? packet : nullptr);
    av_packet_unref(packet);
    while (avcodec_receive_frame(codec, frame) >= 0) {
      ++count;
    }
  }
  av_frame_free(&frame);
  av_packet_free(&packet);
  avcodec_free_context(&codec);
  avformat_close_input(&film);
  return count;
}

/// The one file of a folder that is not whole yet.
std::string part_in(const test::TemporaryFolder& folder) {
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    if (entry.path().string().find(".part-") != std::string::npos) {
      return entry.path().string();
    }
  }
  return {};
}

std::unique_ptr<VideoWriter> film_of(const std::string& path, int pictures) {
  auto writer = VideoWriter::create(path, {.width_px = 64, .height_px = 48});
  EXPECT_TRUE(writer.ok()) << writer.error().message;
  for (int i = 0; i < pictures; ++i) {
    EXPECT_TRUE((*writer)->write(picture(64, 48, static_cast<std::uint8_t>(2 * i))).ok());
  }
  return std::move(*writer);
}

TEST(VideoWriter, WholeFilmsHaveEveryPictureFromTimeZeroAndTheirIndexInFront) {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("film.mp4");
  ASSERT_TRUE(film_of(path, 90)->finish().ok());
  EXPECT_EQ(pictures_in(path), 90);
  EXPECT_EQ(folder.count(), 1u) << "and nothing is left beside it";
  const std::string bytes = test::content_of(path);
  EXPECT_LT(bytes.find("moov"), bytes.find("mdat"));
  AVFormatContext* film = nullptr;
  ASSERT_EQ(avformat_open_input(&film, path.c_str(), nullptr, nullptr), 0);
  EXPECT_EQ(film->streams[0]->nb_frames, 90);
  EXPECT_NEAR(static_cast<double>(film->duration) / AV_TIME_BASE, 3.0, 0.07);
  avformat_close_input(&film);
}

TEST(VideoWriter, FilmsPlayUpToWhereverTheyWereCut) {
  const test::TemporaryFolder folder;
  const auto writer = film_of(folder.file("film.mp4"), 200);
  // As a process that is killed now leaves it; some pictures are still in the encoder.
  const std::string cut = folder.with("cut.mp4", test::content_of(part_in(folder)));
  const int all = pictures_in(cut);
  EXPECT_GT(all, 120);
  EXPECT_LE(all, 200);
  const auto size = fs::file_size(cut);
  int last = all;
  for (const double fraction : {0.9, 0.5, 0.25}) {
    fs::resize_file(cut, static_cast<std::uintmax_t>(fraction * static_cast<double>(size)));
    const int left = pictures_in(cut);
    EXPECT_GT(left, static_cast<int>(0.5 * fraction * all)) << fraction;
    EXPECT_LT(left, last) << fraction;
    last = left;
  }
}

TEST(VideoWriter, OnAFullDiskItSaysWhereThePlayableRestLies) {
  const test::TemporaryFolder folder;
  auto writer = film_of(folder.file("film.mp4"), 60);
  const auto size = fs::file_size(part_in(folder));
  Status written;
  {
    const test::FullDisk full(size + 2000);
    for (int i = 0; i < 200 && written; ++i) {
      written = writer->write(picture(64, 48, static_cast<std::uint8_t>(91 * i)));
    }
  }
  ASSERT_FALSE(written.ok());
  EXPECT_THAT(written.error().message, ::testing::HasSubstr("film.mp4: writing failed"));
  EXPECT_THAT(written.error().message, ::testing::HasSubstr("what was written plays: "));
  EXPECT_FALSE(writer->finish().ok());
  writer.reset();
  ASSERT_NE(part_in(folder), "");
  EXPECT_THAT(written.error().message, ::testing::HasSubstr(part_in(folder)));
  EXPECT_GT(pictures_in(part_in(folder)), 20);
  EXPECT_FALSE(fs::exists(folder.file("film.mp4")));
}

}  // namespace
}  // namespace orthonav::engine
