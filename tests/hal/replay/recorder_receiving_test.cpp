// Recordings of a device that receives its pairs on its own, whether or not they are taken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <optional>

#include "hal/replay/replay_headset.h"
#include "tests/hal/replay/recorded.h"
#include "tests/support/file_calls.h"
#include "tests/support/is_ok.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace orthonav::replay::recorder_test {
namespace {

using orthonav::test::FileCalls;
using orthonav::test::is_ok;
using orthonav::test::scripted_frame;
using orthonav::test::scripted_time;
using orthonav::test::TemporaryFolder;
using ::testing::HasSubstr;

/// Keeps the newest pair alone, as a camera over the network does.
class ReceivingCamera : public StereoCamera {
 public:
  void receive(const StereoFrame& pair) {
    if (tap_ != nullptr) {
      tap_->received(pair);
    }
    newest_ = pair;
  }

 private:
  PairTap* tap_ = nullptr;
  std::optional<StereoFrame> newest_;

  [[nodiscard]] const StereoCalibration& do_calibration() const override {
    return orthonav::test::scripted_calibration();
  }
  bool do_tap(PairTap* tap) override {
    tap_ = tap;
    return true;
  }
  Result<Next> do_next(StereoFrame& frame) override {
    if (!newest_) {
      return Next::kNone;
    }
    frame = *std::exchange(newest_, std::nullopt);
    return Next::kFrame;
  }
};

class ReceivingHeadset : public ForwardingHeadset {
 public:
  explicit ReceivingHeadset(Headset& others) : ForwardingHeadset(others) {}
  [[nodiscard]] ReceivingCamera* cameras() override { return &cameras_; }

 private:
  ReceivingCamera cameras_;
};

/// A session of which everything is recorded.
struct Recorded {
  TemporaryFolder folder;
  fake::FakeHeadset others{orthonav::test::scripted_session(0)};
  ReceivingHeadset headset{others};
  std::unique_ptr<RecordingHeadset> recorder =
      RecordingHeadset::around(headset, folder / "session").value();
  StereoFrame pair = scripted_frame(0);

  /// Pairs that nobody takes, with one picture.
  void receive(int first, int count) {
    for (int i = first; i < first + count; ++i) {
      pair.sequence = i;
      pair.time = scripted_time(i);
      headset.cameras()->receive(pair);
    }
  }
  [[nodiscard]] RecordingSummary summary() const {
    const auto replayed = ReplayHeadset::open(folder / "session");
    EXPECT_TRUE(replayed.ok()) << replayed.error().message;
    return replayed ? (*replayed)->summary() : RecordingSummary();
  }
};

TEST(ReceivingRecorder, RecordsThePairsThatWereAskedForTooLate) {
  Recorded session;
  StereoFrame taken;
  for (int i = 0; i < 10; ++i) {
    session.headset.cameras()->receive(scripted_frame(i));
    if (i % 4 == 3) {
      EXPECT_EQ(session.recorder->cameras()->next(taken).value(), Next::kFrame);
      EXPECT_EQ(taken.sequence, i) << "the newest alone";
    }
  }
  EXPECT_EQ(session.recorder->counts().pairs, 10);
  EXPECT_EQ(session.recorder->counts().lost_pairs, 0);
  ASSERT_TRUE(is_ok(session.recorder->close()));
  session.headset.cameras()->receive(scripted_frame(10));
  EXPECT_EQ(session.recorder->cameras()->next(taken).value(), Next::kFrame) << "it goes on";
  auto replayed = ReplayHeadset::open(session.folder / "session");
  ASSERT_TRUE(replayed.ok()) << replayed.error().message;
  EXPECT_EQ((*replayed)->summary().missing, 0);
  for (int i = 0; i < 10; ++i) {
    ASSERT_EQ((*replayed)->cameras()->next(taken).value(), Next::kFrame);
    EXPECT_EQ(taken.sequence, i);
    EXPECT_EQ(taken.time, scripted_time(i));
    EXPECT_TRUE(taken.right == scripted_frame(i).right);
  }
  EXPECT_EQ((*replayed)->cameras()->next(taken).value(), Next::kEnd);
}

TEST(ReceivingRecorder, LeavesOutPairsThatBreakTheContract) {
  Recorded session;
  session.receive(0, 3);
  session.receive(1, 1);
  StereoFrame small = scripted_frame(4);
  small.left = GreyImage(320, 240);
  session.headset.cameras()->receive(small);
  session.receive(5, 1);
  ASSERT_TRUE(is_ok(session.recorder->close()));
  EXPECT_EQ(session.summary().pairs, 4);
  EXPECT_EQ(session.recorder->counts().lost_pairs, 0);
}

TEST(ReceivingRecorder, IsHeldUpByADiskThatHangsAndHoldsUpNobody) {
  Recorded session;
  const FileCalls calls(session.folder.path().string());
  FileCalls::hold("write session.part/VLC LF.tar");
  session.receive(0, 150);
  EXPECT_EQ(session.recorder->counts().lost_pairs, 0) << "five seconds wait for it";
  session.receive(150, 50);
  const RecordedCounts counts = session.recorder->counts();
  EXPECT_EQ(counts.pairs, 200);
  EXPECT_GT(counts.lost_pairs, 10);
  FileCalls::hold({});
  ASSERT_TRUE(is_ok(session.recorder->close()));
  EXPECT_EQ(session.summary().pairs, 200 - counts.lost_pairs);
  EXPECT_FALSE(session.recorder->recording_failed());
}

TEST(ReceivingRecorder, TellsOfAGapByThePairsNumbers) {
  Recorded session;
  session.receive(0, 2);
  session.receive(7, 2);
  ASSERT_TRUE(is_ok(session.recorder->close()));
  EXPECT_EQ(session.summary().missing, 5);
}

TEST(ReceivingRecorder, SaysWhyItStoppedOnAFullDisk) {
  Recorded session;
  const FileCalls calls(session.folder.path().string());
  FileCalls::fail_next("write session.part/VLC RF.tar", ENOSPC);
  session.receive(0, 2);
  ASSERT_TRUE(orthonav::test::wait_until([&] { return session.recorder->recording_failed(); }));
  session.receive(2, 1);
  EXPECT_THAT(session.recorder->close().error().message,
              HasSubstr("VLC RF.tar: cannot be written: No space left on device"));
}

}  // namespace
}  // namespace orthonav::replay::recorder_test
