#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>

#include "base/random.h"
#include "hal/replay/pairing.h"
#include "hal/replay/replay_headset.h"
#include "tests/support/session_log.h"
#include "tests/support/stream_recorder_folder.h"

namespace orthonav::replay::stream_recorder_test {
namespace {

using orthonav::test::content_of;
using orthonav::test::play;
using orthonav::test::SessionLog;
using orthonav::test::StreamRecorderFolder;
using ::testing::ElementsAre;

constexpr std::int64_t kFrame = 333'333;  // ticks of 100 ns at 30 Hz
constexpr std::int64_t kMillisecond = 10'000;

/// With the times and poses as in the files; that they are late is tested separately.
std::unique_ptr<ReplayHeadset> opened(const std::filesystem::path& path,
                                      RecordedStamps stamps = RecordedStamps::kExact) {
  ReplayOptions options;
  options.stamps = stamps;
  auto headset = ReplayHeadset::open(path, options);
  EXPECT_TRUE(headset.ok()) << headset.error().message;
  return headset ? *std::move(headset) : nullptr;
}

/// The numbers of the images in each delivered pair, as the folder's pixels tell them.
std::vector<std::pair<int, int>> delivered(const SessionLog& log) {
  std::vector<std::pair<int, int>> pairs;
  for (const auto& moment : log.moments) {
    const int left = moment.frame.left.at(320, 240);
    const int right = moment.frame.right.at(320, 240);
    EXPECT_EQ(left % 2, 0);
    EXPECT_EQ(right % 2, 1);
    pairs.emplace_back(left / 2, right / 2);
  }
  return pairs;
}

std::vector<std::pair<int, int>> delivered(const std::vector<std::int64_t>& left,
                                           const std::vector<std::int64_t>& right) {
  const StreamRecorderFolder folder(left, right);
  const auto headset = opened(folder.path());
  return headset ? delivered(play(*headset)) : std::vector<std::pair<int, int>>{};
}

TEST(StreamRecorder, PairsImagesOfTheSameTime) {
  EXPECT_THAT(delivered({0, kFrame, 2 * kFrame}, {0, kFrame, 2 * kFrame}),
              ElementsAre(std::pair(0, 0), std::pair(1, 1), std::pair(2, 2)));
}

TEST(StreamRecorder, PairsWithinAThirdOfAFrameAndNotPastIt) {
  constexpr std::int64_t kThird = 111'111;
  EXPECT_THAT(
      delivered({0, kFrame, 2 * kFrame}, {kThird, kFrame - kThird, 2 * kFrame + kThird + 1}),
      ElementsAre(std::pair(0, 0), std::pair(1, 1)));
}

/// Stamps of real recordings jitter by milliseconds: all 90 pairs remain.
TEST(StreamRecorder, PairsThroughJitter) {
  Random random(3);
  std::vector<ImageMember> left;
  std::vector<ImageMember> right;
  for (int i = 0; i < 90; ++i) {
    const auto stamped = [&] {
      return ImageMember{
          i * kFrame + static_cast<std::int64_t>(2 * kMillisecond * random.normal(0, 1)),
          static_cast<std::uint64_t>(i)};
    };
    left.push_back(stamped());
    right.push_back(stamped());
  }
  const auto pairs = paired(left, right, kPairWithin / Duration(100));
  ASSERT_EQ(pairs.size(), 90u);
  for (const MemberPair& pair : pairs) {
    EXPECT_EQ(pair.left.offset, pair.right.offset);
  }
  EXPECT_LT(paired(left, right, kMillisecond).size(), 60u) << "the twin: within 1 ms";
}

TEST(StreamRecorder, UsesNoImageTwice) {
  EXPECT_THAT(delivered({0, 60'000, kFrame}, {30'000, kFrame}),
              ElementsAre(std::pair(0, 0), std::pair(2, 1)))
      << "of two as near the earlier";
}

TEST(StreamRecorder, NeverPairsTheNextTwoWhenOneIsMissing) {
  EXPECT_THAT(delivered({0, 2 * kFrame, 3 * kFrame}, {0, kFrame, 3 * kFrame}),
              ElementsAre(std::pair(0, 0), std::pair(2, 2)));
}

TEST(StreamRecorder, TakesTheNearerOfTwoCandidates) {
  EXPECT_THAT(delivered({5'000, kFrame}, {0, 6'000, kFrame}),
              ElementsAre(std::pair(0, 1), std::pair(1, 2)));
  EXPECT_THAT(delivered({0, 6'000, kFrame}, {5'000, kFrame}),
              ElementsAre(std::pair(1, 0), std::pair(2, 1)));
}

TEST(StreamRecorder, PutsImagesThatWereWrittenLateInOrder) {
  EXPECT_THAT(delivered({kFrame, 0, 3 * kFrame, 2 * kFrame}, {0, 2 * kFrame, kFrame, 3 * kFrame}),
              ElementsAre(std::pair(1, 0), std::pair(0, 2), std::pair(3, 1), std::pair(2, 3)));
}

TEST(StreamRecorder, SurvivesLongGaps) {
  EXPECT_THAT(delivered({0, kFrame, 30 * kFrame}, {0, kFrame, 30 * kFrame}),
              ElementsAre(std::pair(0, 0), std::pair(1, 1), std::pair(2, 2)));
}

TEST(StreamRecorder, CountsWhatItCannotDeliver) {
  const StreamRecorderFolder folder({0, 0, kFrame, 3 * kFrame}, {0, 2 * kFrame, 3 * kFrame});
  const std::string pose = StreamRecorderFolder::pose_line(0);
  folder.write("VLC LF_rig2world.txt", pose + pose);
  const auto headset = opened(folder.path());
  ASSERT_TRUE(headset);
  EXPECT_EQ(headset->summary().pairs, 2);
  EXPECT_EQ(headset->summary().repeated, 1);
  EXPECT_EQ(headset->summary().left_unpaired, 1);
  EXPECT_EQ(headset->summary().right_unpaired, 1);
  EXPECT_EQ(headset->summary().pairs_without_pose, 1);
}

TEST(StreamRecorder, DeliversAPairWithoutAPoseWithoutOne) {
  const StreamRecorderFolder folder({0, kFrame, 2 * kFrame}, {0, kFrame, 2 * kFrame});
  folder.write("VLC LF_rig2world.txt",
               StreamRecorderFolder::pose_line(2 * kFrame) + StreamRecorderFolder::pose_line(0));
  const auto headset = opened(folder.path());
  ASSERT_TRUE(headset);
  const SessionLog log = play(*headset);
  ASSERT_EQ(log.moments.size(), 3u);
  EXPECT_TRUE(log.moments[0].frame.world_from_rig.has_value());
  EXPECT_FALSE(log.moments[1].frame.world_from_rig.has_value());
  ASSERT_TRUE(log.moments[2].frame.world_from_rig.has_value());
  constexpr double kNineDigits = 1e-9;
  EXPECT_NEAR(log.moments[2].frame.world_from_rig->translation().x, 0.1 * 2e-7 * kFrame,
              kNineDigits);
}

TEST(StreamRecorder, SurvivesAHeadThatWasNeverLocated) {
  const StreamRecorderFolder folder({0, kFrame}, {0, kFrame});
  folder.write("VLC LF_rig2world.txt", "");
  const auto headset = opened(folder.path());
  ASSERT_TRUE(headset);
  const SessionLog log = play(*headset);
  ASSERT_EQ(log.moments.size(), 2u);
  for (const auto& moment : log.moments) {
    EXPECT_FALSE(moment.frame.world_from_rig.has_value());
    EXPECT_EQ(moment.head_now.status, PoseStatus::kLost);
  }
}

TEST(StreamRecorder, CountsFiletimeFrom1970AndGivesTheFilesTicksBack) {
  const StreamRecorderFolder folder({0, 7}, {0, 7});
  const auto headset = opened(folder.path());
  ASSERT_TRUE(headset);
  const SessionLog log = play(*headset);
  ASSERT_EQ(log.moments.size(), 2u);
  EXPECT_EQ(headset->file_ticks_100ns(log.moments[0].frame.time), StreamRecorderFolder::kStart);
  EXPECT_EQ(log.moments[1].frame.time - log.moments[0].frame.time, Duration(700));
  EXPECT_GT(log.moments[0].frame.time, Timestamp{});
}

TEST(StreamRecorder, ReadsRaysAtPixelCentres) {
  StreamRecorderFolder folder({0}, {0});
  folder.write("VLC LF_lut.bin", StreamRecorderFolder::rays_with(0, 0, 2, 0.0F));
  const auto headset = opened(folder.path());
  ASSERT_TRUE(headset);
  const CameraModel& left = headset->cameras()->calibration().left;
  const auto centre = left.unproject({320.0, 240.0});
  ASSERT_TRUE(centre.has_value());
  constexpr double kSinglePrecision = 1e-6;
  EXPECT_NEAR(centre->x, 0.0, kSinglePrecision);
  EXPECT_NEAR(centre->y, 0.0, kSinglePrecision);
  EXPECT_NEAR(left.lookup()[639].x, (639.5 - 320) / 360.0, kSinglePrecision);
  // z = 0 means that the device has no direction there.
  EXPECT_TRUE(std::isnan(left.lookup()[0].x));
  EXPECT_FALSE(std::isnan(headset->cameras()->calibration().right.lookup()[0].x));
}

class ReplayedHead : public ::testing::Test {
 protected:
  [[nodiscard]] Timestamp at(std::int64_t ticks) const {
    return from_ticks_100ns(StreamRecorderFolder::kStart - headset_->epoch_ticks_100ns() + ticks);
  }
  void play_frames(int count) {
    StereoFrame frame;
    for (int i = 0; i < count; ++i) {
      ASSERT_TRUE(headset_->cameras()->next(frame).ok());
    }
  }
  [[nodiscard]] Tracked<Transform<World, Rig>> head(std::int64_t ticks) const {
    return headset_->head().world_from_rig(at(ticks));
  }

  // Poses at 0, 1, 2 and 30 frames.
  StreamRecorderFolder folder_{{0, kFrame, 2 * kFrame, 30 * kFrame},
                               {0, kFrame, 2 * kFrame, 30 * kFrame}};
  std::unique_ptr<ReplayHeadset> headset_ = opened(folder_.path());
  static constexpr double kNineDigits = 1e-8;
};

TEST_F(ReplayedHead, IsUnknownBeforeTheFirstPair) { EXPECT_EQ(head(0).status, PoseStatus::kLost); }

TEST_F(ReplayedHead, IsMeasuredAtAndBetweenPoses) {
  play_frames(3);
  EXPECT_EQ(head(kFrame).status, PoseStatus::kMeasured);
  const auto between = head(kFrame + kFrame / 4);
  EXPECT_EQ(between.status, PoseStatus::kMeasured);
  const double t = 1e-7 * (kFrame + kFrame / 4);
  EXPECT_NEAR(between.value.translation().x, 0.1 * t, kNineDigits);
  EXPECT_NEAR(between.value.rotation()[0][2], std::sin(0.1 * t), kNineDigits);
  EXPECT_EQ(head(-1).status, PoseStatus::kLost);
}

TEST_F(ReplayedHead, IsPredictedBeyondTheNewestPoseAndLostPastTheLimit) {
  play_frames(2);
  const auto soon = head(2 * kFrame);  // recorded, but not yet delivered
  EXPECT_EQ(soon.status, PoseStatus::kPredicted);
  EXPECT_NEAR(soon.value.translation().x, 0.1 * 2e-7 * kFrame, kNineDigits);
  EXPECT_EQ(head(kFrame + 1'000'000).status, PoseStatus::kPredicted);
  EXPECT_EQ(head(kFrame + 1'000'001).status, PoseStatus::kLost);
}

TEST_F(ReplayedHead, IsLostWithinALongGap) {
  play_frames(4);
  EXPECT_EQ(head(10 * kFrame).status, PoseStatus::kLost);
  EXPECT_EQ(head(30 * kFrame).status, PoseStatus::kMeasured);
}

TEST_F(ReplayedHead, AnswersEveryTimeThereIs) {
  play_frames(4);
  for (const Timestamp t : {Timestamp::min(), Timestamp::max(), Timestamp{}}) {
    EXPECT_EQ(headset_->head().world_from_rig(t).status, PoseStatus::kLost);
    EXPECT_EQ(headset_->head().world_from_rig(t).time, t);
  }
}

/// Twelve poses of a head that hardly moves, in a map that jumps along x at the sixth; images from
/// some pair on.
class JumpingFolder {
 public:
  explicit JumpingFolder(double jump_m, int first_image = 0)
      : folder_(ticks_from(first_image), ticks_from(first_image)) {
    std::string poses;
    for (int n = 0; n < kPoses; ++n) {
      poses += std::to_string(StreamRecorderFolder::kStart + n * kFrame) + ",1,0,0," +
               std::to_string(n < 6 ? 0.0 : jump_m) + ",0,1,0," + std::to_string(1.6 + 1e-5 * n) +
               ",0,0,1,0,0,0,0,1\n";
    }
    folder_.write("VLC LF_rig2world.txt", poses);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }

 private:
  static constexpr int kPoses = 12;
  StreamRecorderFolder folder_;

  static std::vector<std::int64_t> ticks_from(int first) {
    std::vector<std::int64_t> ticks;
    for (int n = first; n < kPoses; ++n) {
      ticks.push_back(n * kFrame);
    }
    return ticks;
  }
};

TEST(ReplayedMap, BeginsAnewWhereThePosesJump) {
  for (const auto stamps : {RecordedStamps::kExact, RecordedStamps::kByRecorder}) {
    // The smallest is found live too; 4 cm may be a head's start.
    for (const double jump_m : {0.423, 0.06, 0.04}) {
      const JumpingFolder folder(jump_m);
      const auto headset = opened(folder.path(), stamps);
      ASSERT_TRUE(headset);
      const bool jumps = jump_m > 0.05;
      EXPECT_EQ(headset->summary().map_jumps, jumps ? 1 : 0) << jump_m;
      StereoFrame frame;
      Timestamp fourth{};
      for (int n = 0; n < 12; ++n) {
        ASSERT_EQ(*headset->cameras()->next(frame), Next::kFrame);
        fourth = n == 4 ? frame.time : fourth;
        EXPECT_EQ(frame.map_epoch, jumps && n >= 6 ? 1 : 0) << jump_m << ", pair " << n;
        if (jumps) {
          EXPECT_EQ(frame.world_from_rig->translation().x, n < 6 ? 0.0 : jump_m) << n;
        }
      }
      const auto before = headset->head().world_from_rig(fourth);
      EXPECT_EQ(before.status, jumps ? PoseStatus::kLost : PoseStatus::kMeasured) << jump_m;
    }
  }
}

TEST(ReplayedMap, JumpsAtAPoseWithoutAPair) {
  const JumpingFolder folder(0.423, 8);
  const auto headset = opened(folder.path());
  ASSERT_TRUE(headset);
  EXPECT_EQ(headset->summary().map_jumps, 1);
  StereoFrame frame;
  ASSERT_EQ(*headset->cameras()->next(frame), Next::kFrame);
  EXPECT_EQ(frame.map_epoch, 1);
}

TEST(Sample, GivesEveryPairAndPoseOfTheRecordingBesideTheProject) {
  const std::filesystem::path path =
      std::filesystem::path(ORTHONAV_SHARED_DIR) / "recordings" / "streamrecorder-sample";
  if (!std::filesystem::exists(path)) {
    GTEST_SKIP() << "needs shared/recordings/streamrecorder-sample";
  }
  const auto headset = opened(path);
  ASSERT_TRUE(headset);
  const SessionLog log = play(*headset);
  ASSERT_EQ(log.moments.size(), 30u);
  EXPECT_TRUE(std::holds_alternative<ToolsFile>(headset->described_tools()));
  // The first image by the archive's fixed offsets.
  const std::string tar = content_of(path / "VLC LF.tar");
  const auto& pixels = log.moments[0].frame.left.pixels;
  EXPECT_EQ(std::string(pixels.begin(), pixels.end()), tar.substr(512 + 15, 640 * 480));
  // Every time of the truth beside it is a delivered pair's.
  std::set<std::int64_t> times;
  for (const auto& moment : log.moments) {
    times.insert(headset->file_ticks_100ns(moment.frame.time));
    EXPECT_TRUE(moment.frame.world_from_rig.has_value());
  }
  std::ifstream truth(path / "truth.csv");
  std::string line;
  std::getline(truth, line);
  while (std::getline(truth, line)) {
    EXPECT_TRUE(times.contains(std::stoll(line))) << line;
  }
  EXPECT_EQ(headset->cameras()->calibration().left_from_rig.rotation()[0][1], 1.0);
  EXPECT_EQ(headset->summary().map_jumps, 0);
}

}  // namespace
}  // namespace orthonav::replay::stream_recorder_test
