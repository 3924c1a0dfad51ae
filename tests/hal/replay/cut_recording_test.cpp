// Recordings that were cut off: read to their last whole pair, and closed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/replay/image_tar.h"
#include "hal/replay/recorder.h"
#include "hal/replay/repair.h"
#include "hal/replay/replay_headset.h"
#include "tests/support/full_disk.h"
#include "tests/support/scripted_session.h"
#include "tests/support/session_log.h"
#include "tests/support/stream_recorder_folder.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::replay::cut_recording_test {
namespace {

using orthonav::test::content_of;
using orthonav::test::expect_same;
using orthonav::test::play;
using orthonav::test::scripted_session;
using orthonav::test::SessionLog;
using orthonav::test::StreamRecorderFolder;
using orthonav::test::TemporaryFolder;
using orthonav::test::write_text;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A member of an archive of PGMs of 640 x 480 pixels.
constexpr std::uint64_t kMemberBytes = 512 + 307'712;
constexpr int kPairs = 4;

/// Up to the end of an image of our recorder, which are PNGs.
std::uint64_t end_of_image(const std::filesystem::path& tar, std::size_t image) {
  const auto images = ImageTar::open(tar);
  EXPECT_TRUE(images.ok()) << images.error().message;
  return images->end_of(images->members().at(image));
}

/// A recording of ours under its temporary name, as it is when its program was killed.
class Unfinished {
 public:
  Unfinished() {
    auto recorder = RecordingHeadset::create(
        std::make_unique<fake::FakeHeadset>(scripted_session(kPairs)), folder_ / "walk");
    EXPECT_TRUE(recorder.ok());
    log_ = play(**recorder);
    // The files as a killed program leaves them, before they are closed.
    std::filesystem::copy(folder_ / "walk.part", folder_ / "killed.part");
  }
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "killed.part"; }
  [[nodiscard]] std::filesystem::path closed() const { return folder_ / "killed"; }
  [[nodiscard]] const SessionLog& log() const { return log_; }
  [[nodiscard]] std::uint64_t end(const std::string& name, std::size_t image) const {
    return end_of_image(path() / name, image);
  }
  void cut(const std::string& name, std::uint64_t bytes) const {
    std::filesystem::resize_file(path() / name, bytes);
  }

 private:
  TemporaryFolder folder_;
  SessionLog log_;
};

/// The pairs of a recording, each compared with what was recorded.
std::size_t same_pairs(const std::filesystem::path& path, const SessionLog& recorded,
                       std::string* cut = nullptr) {
  const auto headset = ReplayHeadset::open(path);
  EXPECT_TRUE(headset.ok()) << headset.error().message;
  if (!headset) {
    return 0;
  }
  if (cut) {
    *cut = (*headset)->summary().cut;
  }
  const SessionLog log = play(**headset);
  EXPECT_TRUE(log.errors.empty());
  for (std::size_t i = 0; i < log.moments.size(); ++i) {
    const StereoFrame& frame = log.moments[i].frame;
    const StereoFrame& expected = recorded.moments[i].frame;
    EXPECT_TRUE(frame.left == expected.left && frame.right == expected.right);
    EXPECT_EQ(frame.time, expected.time);
    EXPECT_EQ(frame.sequence, expected.sequence);
    EXPECT_EQ(frame.world_from_rig, expected.world_from_rig);
  }
  return log.moments.size();
}

TEST(CutRecording, OfAKilledProgramHasAllThatWasWritten) {
  const Unfinished recording;
  std::string cut;
  EXPECT_EQ(same_pairs(recording.path(), recording.log(), &cut), std::size_t{kPairs});
  EXPECT_THAT(cut, AllOf(HasSubstr("VLC LF.tar is cut off at byte " +
                                   std::to_string(recording.end("VLC LF.tar", 3)) +
                                   ", after 4 whole images"),
                         HasSubstr("VLC RF.tar is cut off")));
}

TEST(CutRecording, OfAFullDiskIsReadToItsLastWholePairAndSaysSo) {
  const TemporaryFolder folder;
  auto recorder = RecordingHeadset::create(
      std::make_unique<fake::FakeHeadset>(scripted_session(kPairs)), folder / "walk");
  ASSERT_TRUE(recorder.ok());
  SessionLog log;
  {
    const Unfinished roomy;  // the same pairs
    const orthonav::test::FullDisk full((roomy.end("VLC LF.tar", 1) + roomy.end("VLC LF.tar", 2)) /
                                        2);
    log = play(**recorder);
  }
  EXPECT_EQ(log.moments.size(), std::size_t{kPairs}) << "the session is not disturbed";
  EXPECT_TRUE(log.errors.empty());
  const Status recording = (*recorder)->recording_status();
  ASSERT_FALSE(recording.ok());
  EXPECT_THAT(recording.error().message, HasSubstr(".tar: cannot be written: "));
  EXPECT_FALSE((*recorder)->close().ok());
  std::string cut;
  EXPECT_EQ(same_pairs(folder / "walk.part", log, &cut), 2u);
  EXPECT_THAT(cut, HasSubstr("VLC LF.tar is cut off at byte "));
  EXPECT_THAT(cut, HasSubstr(", after 2 whole images"));
  const auto repaired = repair_recording(folder / "walk.part");
  ASSERT_TRUE(repaired.ok()) << repaired.error().message;
  EXPECT_EQ(repaired->pairs, 2);
  EXPECT_EQ(same_pairs(folder / "walk", log), 2u);
}

TEST(CutRecording, IsReadToItsLastWholePairWhereverItWasCut) {
  const Unfinished recording;
  std::string cut;
  const std::uint64_t first = recording.end("VLC LF.tar", 0);
  const std::uint64_t third = recording.end("VLC RF.tar", 2) - 1000;  // within it
  recording.cut("VLC RF.tar", third);
  EXPECT_EQ(same_pairs(recording.path(), recording.log(), &cut), 2u);
  EXPECT_THAT(cut, HasSubstr("VLC RF.tar is cut off at byte " + std::to_string(third) +
                             ", after 2 whole images"));
  recording.cut("frames.csv", content_of(recording.path() / "frames.csv").find("\n1,") + 5);
  EXPECT_EQ(same_pairs(recording.path(), recording.log(), &cut), 1u);
  EXPECT_THAT(cut, HasSubstr("frames.csv ends within a line"));
  recording.cut("VLC LF.tar", first);
  EXPECT_EQ(same_pairs(recording.path(), recording.log()), 1u);
  recording.cut("VLC LF.tar", first - 1000);
  const auto none = ReplayHeadset::open(recording.path());
  ASSERT_FALSE(none.ok());
  EXPECT_THAT(none.error().message,
              HasSubstr("VLC LF.tar: holds no whole image: is cut off at byte " +
                        std::to_string(first - 1000)));
}

/// At every tenth kilobyte, and around each block: as many images as are whole, and no error.
TEST(CutArchive, IsReadToItsLastWholeImageAtEveryTenthKilobyte) {
  const TemporaryFolder folder;
  orthonav::test::HandmadeTar tar;
  for (int i = 0; i < kPairs; ++i) {
    tar.add_image(1000 + i, static_cast<std::uint8_t>(i));
  }
  write_text(folder / "VLC LF.tar", tar.finished());
  const auto whole = ImageTar::open(folder / "VLC LF.tar");
  ASSERT_TRUE(whole.ok());
  EXPECT_EQ(whole->cut(), "");
  // The last image is whole with its last pixel; its padding holds nothing.
  constexpr std::uint64_t kPaddingBytes = 307'712 - 307'215;
  for (std::uint64_t bytes = kPairs * kMemberBytes; bytes >= kMemberBytes; bytes -= 10'240) {
    std::filesystem::resize_file(folder / "VLC LF.tar", bytes);
    const auto cut = ImageTar::open(folder / "VLC LF.tar");
    ASSERT_TRUE(cut.ok()) << bytes << ": " << cut.error().message;
    EXPECT_EQ(cut->members().size(), (bytes + kPaddingBytes) / kMemberBytes) << bytes;
    EXPECT_THAT(cut->cut(), HasSubstr("cut off at byte " + std::to_string(bytes)));
  }
}

TEST(CutArchive, WithADamagedHeaderIsRefused) {
  const TemporaryFolder folder;
  orthonav::test::HandmadeTar tar;
  tar.add_image(1000, 0).add_image(1001, 1);
  std::string bytes = tar.finished();
  bytes[kMemberBytes + 3] ^= 0x20;
  write_text(folder / "VLC LF.tar", bytes);
  const auto damaged = ImageTar::open(folder / "VLC LF.tar");
  ASSERT_FALSE(damaged.ok());
  EXPECT_THAT(damaged.error().message, HasSubstr("after 1 images"));
}

TEST(CutRecording, OfStreamRecorderIsReadToo) {
  const StreamRecorderFolder folder({0, 333'333, 666'667}, {0, 333'333, 666'667});
  std::filesystem::resize_file(folder.path() / "VLC LF.tar", 3 * kMemberBytes - 5000);
  const std::string poses = content_of(folder.path() / "VLC LF_rig2world.txt");
  std::filesystem::resize_file(folder.path() / "VLC LF_rig2world.txt", poses.size() - 9);
  auto headset = ReplayHeadset::open(folder.path());
  ASSERT_TRUE(headset.ok()) << headset.error().message;
  EXPECT_EQ((*headset)->summary().pairs, 2);
  EXPECT_THAT((*headset)->summary().cut, HasSubstr("VLC LF_rig2world.txt ends within a line"));
  const auto report = repair_recording(folder.path());
  ASSERT_TRUE(report.ok()) << report.error().message;
  EXPECT_EQ(report->pairs, 2);
  headset = ReplayHeadset::open(folder.path());
  ASSERT_TRUE(headset.ok()) << headset.error().message;
  EXPECT_EQ((*headset)->summary().cut, "");
}

TEST(Repair, ClosesARecordingAndGivesItItsName) {
  const Unfinished recording;
  recording.cut("VLC RF.tar", recording.end("VLC RF.tar", 2) - 1000);
  recording.cut("head.csv", content_of(recording.path() / "head.csv").size() - 20);
  recording.cut("Depth AHaT.tar", 4 * 2048);
  const auto report = repair_recording(recording.path());
  ASSERT_TRUE(report.ok()) << report.error().message;
  EXPECT_EQ(report->pairs, 2);
  EXPECT_EQ(report->folder, recording.closed());
  EXPECT_THAT(report->cut, AllOf(HasSubstr("VLC RF.tar is cut off"), HasSubstr("head.csv ends"),
                                 HasSubstr("Depth AHaT.tar is cut off")));
  EXPECT_FALSE(std::filesystem::exists(recording.path()));
  std::string cut = "?";
  EXPECT_EQ(same_pairs(recording.closed(), recording.log(), &cut), 2u);
  EXPECT_EQ(cut, "");
  const auto again = repair_recording(recording.closed());
  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_EQ(again->cut, "") << "nothing is left to do";
}

TEST(Repair, OfAWholeRecordingChangesNothing) {
  const TemporaryFolder folder;
  {
    auto recorder = RecordingHeadset::create(
        std::make_unique<fake::FakeHeadset>(scripted_session(2)), folder / "walk");
    ASSERT_TRUE(recorder.ok());
    play(**recorder);
    ASSERT_TRUE((*recorder)->close().ok());
  }
  const std::string before = content_of(folder / "walk" / "VLC LF.tar");
  const auto report = repair_recording(folder / "walk");
  ASSERT_TRUE(report.ok()) << report.error().message;
  EXPECT_EQ(report->cut, "");
  EXPECT_TRUE(content_of(folder / "walk" / "VLC LF.tar") == before);
}

TEST(Repair, TouchesNothingWhereItCannotEnd) {
  const Unfinished recording;
  const std::string before = content_of(recording.path() / "VLC LF.tar");
  std::filesystem::create_directory(recording.closed());
  const auto taken = repair_recording(recording.path());
  ASSERT_FALSE(taken.ok());
  EXPECT_THAT(taken.error().message, HasSubstr("killed: exists already"));
  EXPECT_TRUE(content_of(recording.path() / "VLC LF.tar") == before);
  std::filesystem::remove(recording.closed());
  recording.cut("frames.csv", 20);
  const auto none = repair_recording(recording.path());
  ASSERT_FALSE(none.ok());
  EXPECT_THAT(none.error().message, HasSubstr("holds no whole pair"));
  EXPECT_TRUE(content_of(recording.path() / "VLC LF.tar") == before);
}

}  // namespace
}  // namespace orthonav::replay::cut_recording_test
