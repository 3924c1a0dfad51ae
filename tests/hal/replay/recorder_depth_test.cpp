#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/replay/recorder.h"
#include "hal/replay/replay_headset.h"
#include "tests/support/depth_scene.h"
#include "tests/support/recorded_session.h"
#include "tests/support/scripted_session.h"

namespace orthonav::replay {
namespace {

using orthonav::test::content_of;
using orthonav::test::DepthScene;
using orthonav::test::expect_same;
using orthonav::test::Hololens1Folder;
using orthonav::test::play;
using orthonav::test::play_to_the_end;
using orthonav::test::scripted_calibration;
using orthonav::test::scripted_frame;
using orthonav::test::scripted_session;
using orthonav::test::SessionLog;
using orthonav::test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

SessionLog recorded(Headset& headset, const std::filesystem::path& folder,
                    const RecorderOptions& options = {}) {
  return play_to_the_end(RecordingHeadset::around(headset, folder, options));
}

std::unique_ptr<ReplayHeadset> opened(const std::filesystem::path& folder) {
  auto headset = ReplayHeadset::open(folder);
  EXPECT_TRUE(headset.ok()) << headset.error().message;
  return headset ? std::move(*headset) : nullptr;
}

TEST(RecorderDepth, ReplaysToTheBit) {
  const TemporaryFolder folder;
  fake::FakeHeadset headset(scripted_session());
  const SessionLog live = recorded(headset, folder / "session");
  ASSERT_GT(live.depth.size(), 15u);
  const auto replayed = opened(folder / "session");
  ASSERT_NE(replayed, nullptr);
  const auto cameras = replayed->depth_cameras();
  ASSERT_EQ(cameras.size(), 2u);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    expect_same(cameras[i]->calibration(), headset.depth_cameras()[i]->calibration());
  }
  expect_same(play(*replayed), live);
}

TEST(RecorderDepth, IsWrittenAsStreamRecorderDoes) {
  const TemporaryFolder folder;
  fake::FakeHeadset headset(scripted_session());
  const SessionLog live = recorded(headset, folder / "session");
  const std::string tar = content_of(folder / "session" / "Depth AHaT.tar");
  EXPECT_EQ(std::string(tar.c_str()), "9950000_ab.pgm");
  EXPECT_EQ(tar.substr(512, 15), "P5\n24 24\n65535\n");
  constexpr std::size_t kSecond = 512 + 1536;  // after a header and three blocks of pixels
  EXPECT_EQ(std::string(tar.c_str() + kSecond), "9950000.pgm");
  const std::uint16_t first = live.depth.front().frame.range_mm.pixels.front();
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(tar[i]); };
  EXPECT_EQ(byte(kSecond + 512 + 15), first >> 8U);
  EXPECT_EQ(byte(kSecond + 512 + 16), first & 255U);
  EXPECT_EQ(std::filesystem::file_size(folder / "session" / "Depth AHaT_lut.bin"), 12u * 24u * 24u);
}

TEST(RecorderDepth, OfAHololens1ComesBackFromOurLayout) {
  DepthScene scene;
  scene.pictures = {{10'000'000, DepthScene::pose(0)}, {10'200'000, std::nullopt}};
  const Hololens1Folder folder(scripted_calibration(), {scripted_frame(0), scripted_frame(1)});
  scene.write_hololens1(folder.path(), "short_throw_depth", 4095);
  const auto first = opened(folder.path());
  ASSERT_NE(first, nullptr);
  const TemporaryFolder again;
  const SessionLog live = recorded(*first, again / "session");
  ASSERT_EQ(live.depth.size(), 2u);
  const auto second = opened(again / "session");
  ASSERT_NE(second, nullptr);
  ASSERT_EQ(second->depth_cameras().size(), 1u);
  expect_same(second->depth_cameras()[0]->calibration(), first->depth_cameras()[0]->calibration());
  expect_same(play(*second), live);
}

TEST(RecorderDepth, MakesNoFilesForWhatNobodyReads) {
  const TemporaryFolder folder;
  fake::FakeHeadset headset(scripted_session());
  auto recorder = RecordingHeadset::around(headset, folder / "session");
  ASSERT_TRUE(recorder.ok());
  StereoFrame frame;
  ASSERT_TRUE((*recorder)->cameras()->next(frame).ok());
  ASSERT_TRUE((*recorder)->close().ok());
  EXPECT_FALSE(std::filesystem::exists(folder / "session" / "Depth AHaT.tar"));
  const auto replayed = opened(folder / "session");
  ASSERT_NE(replayed, nullptr);
  EXPECT_THAT(replayed->depth_cameras(), IsEmpty());
}

TEST(RecorderDepth, IsTakenForASessionThatHasNoUseForIt) {
  const TemporaryFolder folder;
  fake::FakeHeadset headset(scripted_session());
  const SessionLog live = recorded(headset, folder / "session", {.takes_depth = true});
  EXPECT_THAT(live.depth, IsEmpty()) << "nobody else sees it";
  fake::FakeHeadset twin(scripted_session());
  const SessionLog read_by_hand = play(twin);
  const auto replayed = opened(folder / "session");
  ASSERT_NE(replayed, nullptr);
  const SessionLog log = play(*replayed);
  ASSERT_EQ(log.depth.size(), read_by_hand.depth.size());
  EXPECT_EQ(log.depth.back().frame.time, read_by_hand.depth.back().frame.time);
}

TEST(RecorderDepth, RefusesWhatCannotBeReadAgain) {
  const TemporaryFolder folder;
  fake::Script script = scripted_session();
  script.depth.resize(1);
  script.depth[0].calibration.width_px = 2049;
  script.depth[0].calibration.height_px = 2;
  DepthFrame large;
  large.range_mm = DepthImage(2049, 2, 700);
  script.depth[0].steps = {large};
  fake::FakeHeadset headset(script);
  auto recorder = RecordingHeadset::around(headset, folder / "session");
  ASSERT_TRUE(recorder.ok());
  const SessionLog log = play(**recorder);
  EXPECT_EQ(log.depth.size(), 1u) << "it is passed on all the same";
  const Status closed = (*recorder)->close();
  ASSERT_FALSE(closed.ok());
  EXPECT_THAT(closed.error().message, HasSubstr("Depth AHaT is 2049x2 px, each side must be 2 to"));
}

}  // namespace
}  // namespace orthonav::replay
