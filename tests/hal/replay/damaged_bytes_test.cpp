#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "hal/replay/recorder.h"
#include "hal/replay/replay_headset.h"
#include "tests/support/session_log.h"
#include "tests/support/stream_recorder_folder.h"

namespace orthonav::replay::damaged_bytes_test {
namespace {

using orthonav::test::content_of;
using orthonav::test::scripted_session;
using orthonav::test::TemporaryFolder;
using orthonav::test::write_text;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string refusal(const std::filesystem::path& path) {
  const auto headset = ReplayHeadset::open(path);
  return headset.ok() ? "accepted" : headset.error().message;
}

/// A recording of our own with all kinds of files, to be damaged byte by byte.
class DamagedBytes : public ::testing::Test {
 protected:
  void SetUp() override {
    auto recorder =
        RecordingHeadset::create(std::make_unique<fake::FakeHeadset>(scripted_session(3)),
                                 folder_ / "session", {"{\"tools\": []}"});
    ASSERT_TRUE(recorder.ok());
    orthonav::test::play(**recorder);
    ASSERT_TRUE((*recorder)->close().ok());
    ASSERT_EQ(refusal(folder_ / "session"), "accepted");
  }
  /// Either refused in one line that names a file of the recording, or played to its end with every
  /// promise of the public calls kept.
  void expect_no_harm(const std::string& what) {
    SCOPED_TRACE(what);
    const auto headset = ReplayHeadset::open(folder_ / "session");
    if (!headset) {
      ++refused_;
      EXPECT_THAT(headset.error().message, AllOf(HasSubstr("session"), Not(HasSubstr("\n"))));
      return;
    }
    const auto log = orthonav::test::play(**headset);
    EXPECT_TRUE(log.ended);
    for (const auto& moment : log.depth) {
      EXPECT_LE(moment.frame.time, moment.clock);
    }
    for (const DepthSummary& depth : (*headset)->summary().depth) {
      EXPECT_THAT(depth.trouble, Not(HasSubstr("\n")));
      if (!depth.trouble.empty()) {
        ++left_out_;
      }
    }
  }
  void damage(const std::string& name, int rounds) {
    const auto path = folder_ / "session" / name;
    const std::string whole = content_of(path);
    Random random = Random(20191).fork(name);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random.next() % n); };
    for (int round = 0; round < rounds; ++round) {
      std::string bytes = whole;
      // Headers and text lie at the front: half of the damage goes there.
      const std::size_t front = std::min<std::size_t>(whole.size(), 600);
      const std::size_t at = round % 2 == 0 ? below(front) : below(whole.size());
      if (round % 4 < 2) {
        bytes.resize(at);
      } else if (round % 4 == 2) {
        bytes[at] = static_cast<char>(random.next() & 255U);
      } else {
        bytes.replace(at, std::min<std::size_t>(bytes.size() - at, 1 + below(8)), "-1e999,nan");
      }
      write_text(path, bytes);
      expect_no_harm(name + " round " + std::to_string(round));
    }
    write_text(path, whole);
  }

  TemporaryFolder folder_;
  int refused_ = 0;
  int left_out_ = 0;  ///< depth streams
};

TEST_F(DamagedBytes, OfArchivesDoNoHarm) {
  damage("VLC LF.tar", 60);
  damage("VLC RF.tar", 60);
  EXPECT_GT(refused_, 60);
}

TEST_F(DamagedBytes, OfTablesDoNoHarm) {
  for (const char* name :
       {"VLC LF_lut.bin", "VLC RF_lut.bin", "VLC LF_lut64.bin", "VLC RF_lut64.bin"}) {
    damage(name, 8);
  }
  EXPECT_GE(refused_, 16);
}

TEST_F(DamagedBytes, OfTextFilesDoNoHarm) {
  for (const char* name : {"VLC LF_extrinsics.txt", "VLC LF_rig2world.txt", "VLC RF_rig2world.txt",
                           "frames.csv", "events.csv", "head.csv", "device.csv", "tools.json"}) {
    damage(name, 24);
  }
  EXPECT_GT(refused_, 80);
}

TEST_F(DamagedBytes, OfDepthLeavesThePairsUnharmed) {
  for (const char* name : {"Depth AHaT.tar", "Depth AHaT_lut.bin", "Depth AHaT_extrinsics.txt",
                           "Depth AHaT_rig2world.txt", "Depth AHaT_frames.csv"}) {
    damage(name, 20);
  }
  EXPECT_GT(left_out_, 50);
  EXPECT_EQ(refused_, 0);
}

}  // namespace
}  // namespace orthonav::replay::damaged_bytes_test
