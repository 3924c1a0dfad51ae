// How a recording begins, ends and fails.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "hal/replay/replay_headset.h"
#include "tests/hal/replay/recorded.h"
#include "tests/support/recorded_session.h"
#include "tests/support/scripted_session.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::replay::recorder_test {
namespace {

using orthonav::test::play;
using orthonav::test::scripted_session;
using orthonav::test::SessionLog;
using orthonav::test::TemporaryFolder;
using ::testing::HasSubstr;

TEST(Recorder, LeavesAnUnfinishedRecordingUnderItsTemporaryName) {
  const TemporaryFolder folder;
  auto recorder = RecordingHeadset::create(headset(), folder / "session");
  ASSERT_TRUE(recorder.ok());
  StereoFrame frame;
  ASSERT_TRUE((*recorder)->cameras()->next(frame).ok());
  EXPECT_FALSE(std::filesystem::exists(folder / "session"));
  EXPECT_TRUE(std::filesystem::exists(folder / "session.part"));
  const auto cut_off = ReplayHeadset::open(folder / "session.part");
  ASSERT_TRUE(cut_off.ok()) << cut_off.error().message;
  EXPECT_EQ((*cut_off)->summary().pairs, 1);
  EXPECT_THAT((*cut_off)->summary().cut, HasSubstr(", after 1 whole images"));
  ASSERT_TRUE((*recorder)->close().ok());
  EXPECT_TRUE(std::filesystem::exists(folder / "session"));
  EXPECT_FALSE(std::filesystem::exists(folder / "session.part"));
}

TEST(Recorder, ClosesWithItsOwner) {
  const TemporaryFolder folder;
  {
    auto recorder = RecordingHeadset::create(headset(), folder / "session");
    ASSERT_TRUE(recorder.ok());
    play(**recorder);
  }
  EXPECT_TRUE(ReplayHeadset::open(folder / "session").ok());
}

TEST(Recorder, NeverOverwritesARecording) {
  const TemporaryFolder folder;
  record(headset(), folder / "session");
  const auto again = RecordingHeadset::create(headset(), folder / "session");
  ASSERT_FALSE(again.ok());
  EXPECT_THAT(again.error().message, HasSubstr("exists already"));
  std::filesystem::create_directory(folder / "other.part");
  const auto beside = RecordingHeadset::create(headset(), folder / "other");
  ASSERT_FALSE(beside.ok());
  EXPECT_THAT(beside.error().message, HasSubstr("cut off"));
  std::filesystem::create_directory(folder / "empty");
  EXPECT_TRUE(RecordingHeadset::create(headset(), folder / "empty").ok());
}

TEST(Recorder, RefusesAFolderThatCannotBeMade) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "in the way";
  EXPECT_FALSE(RecordingHeadset::create(headset(), folder / "file" / "session").ok());
  EXPECT_FALSE(RecordingHeadset::create(headset(), "").ok());
}

TEST(Recorder, RefusesCamerasThatTheLayoutCannotHold) {
  const TemporaryFolder folder;
  fake::Script script = scripted_session(1);
  script.calibration.right = *CameraModel::from_brown_conrady(
      {320, 240, 180.0, 180.0, 160.0, 120.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  const auto refused = RecordingHeadset::create(headset(script), folder / "session");
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, HasSubstr("320x240 px, must be 640x480"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Recorder, TellsThatNothingWasRecorded) {
  const TemporaryFolder folder;
  auto recorder = RecordingHeadset::create(headset(scripted_session(0)), folder / "session");
  ASSERT_TRUE(recorder.ok());
  play(**recorder);
  const Status closed = (*recorder)->close();
  ASSERT_FALSE(closed.ok());
  EXPECT_THAT(closed.error().message, HasSubstr("no pair came: nothing was recorded"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "and nothing is left of it";
}

TEST(Recorder, GoesOnWithTheSessionWhenItFails) {
  // Two pairs within one tick cannot be told apart in the layout.
  const TemporaryFolder folder;
  fake::Script script;
  script.calibration = orthonav::test::scripted_calibration();
  for (int i = 0; i < 3; ++i) {
    StereoFrame frame = orthonav::test::scripted_frame(i);
    frame.time = Timestamp(Duration(1'000'000'000 + i));
    script.camera.emplace_back(std::move(frame));
  }
  auto recorder = RecordingHeadset::create(headset(script), folder / "session");
  ASSERT_TRUE(recorder.ok());
  EXPECT_TRUE((*recorder)->recording_status().ok());
  const SessionLog log = play(**recorder);
  EXPECT_EQ(log.moments.size(), 3u);
  EXPECT_TRUE(log.errors.empty());
  ASSERT_FALSE((*recorder)->recording_status().ok());
  EXPECT_THAT((*recorder)->recording_status().error().message, HasSubstr("cannot be told from"));
  EXPECT_FALSE((*recorder)->close().ok());
  EXPECT_FALSE(std::filesystem::exists(folder / "session"));
}

}  // namespace
}  // namespace orthonav::replay::recorder_test
