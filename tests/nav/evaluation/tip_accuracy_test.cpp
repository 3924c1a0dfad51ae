#include "nav/evaluation/tip_accuracy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/nav/evaluation/tested_tip.h"
#include "tests/support/accuracy_track.h"

namespace orthonav::nav::tip_accuracy_test {
namespace {

using test::accuracy_board;
using test::accuracy_pointer;
using test::accuracy_track;
using test::AccuracyTrackOptions;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(AccuracyTest, PassesAGoodTracker) {
  const auto report = tested({});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->verdict(), Verdict::kPass);
  ASSERT_TRUE(report->distances);
  EXPECT_EQ(report->single_point.verdict(), Verdict::kPass);
  EXPECT_EQ(report->turning.verdict(), Verdict::kPass);
  EXPECT_EQ(report->distances->verdict(), Verdict::kPass);
  EXPECT_EQ(report->distances->distances, 36u);
  EXPECT_EQ(report->distances->stray_rests, 0u);
  EXPECT_THAT(report->distances->points, SizeIs(9));
}

TEST(AccuracyTest, FindsThePartsWhereTheyAre) {
  const auto report = tested({});
  ASSERT_TRUE(report) << report.error().message;
  // 0.6 s of arriving, 3 s still, 8 s of turning; the slow ends of a motion belong to either.
  constexpr double kEndsS = 0.5;
  EXPECT_NEAR(report->single_point.start_s, 0.6, kEndsS);
  EXPECT_NEAR(report->single_point.end_s, 3.6, kEndsS);
  EXPECT_NEAR(report->turning.end_s, 11.6, kEndsS);
  EXPECT_NEAR(report->turning.largest_tilt_rad, 0.45, 0.1);
  ASSERT_TRUE(report->distances);
  // The first touch follows 0.6 s of moving and lasts 0.8 s.
  EXPECT_NEAR(report->distances->points[0].time_s, 12.6, 0.2);
  EXPECT_NEAR(report->distances->points[8].time_s, 12.6 + 8 * 1.4, 0.2);
}

// 3-D RMS of the tip from noise of position and rotation 150 mm away about the two axes across.
double expected_rms_m(const AccuracyTrackOptions& track) {
  const double lever_m = accuracy_pointer().tip_in_marker.v.norm() * track.rotation_noise_rad;
  return std::sqrt(3 * track.position_noise_m * track.position_noise_m + 2 * lever_m * lever_m);
}

TEST(AccuracyTest, MeasuresTheRepeatabilityThatIsThere) {
  // About 80 samples of three numbers: 5 % SD of an RMS, so four of them.
  constexpr double kTolerance = 0.2;
  for (const double times : {1.0, 10.0}) {
    AccuracyTrackOptions track;
    track.position_noise_m *= times;
    track.rotation_noise_rad *= times;
    const double expected_m = expected_rms_m(track);
    const auto report = tested(track);
    ASSERT_TRUE(report) << report.error().message;
    const TipSpread& spread = report->single_point.spread;
    EXPECT_NEAR(spread.rms_m / expected_m, 1.0, kTolerance);
    EXPECT_GT(spread.p95_m, spread.rms_m);
    EXPECT_GE(spread.max_m, spread.p95_m);
    // The covariance says the same without looking at the scatter.
    ASSERT_TRUE(report->single_point.predicted_rms_m);
    EXPECT_NEAR(*report->single_point.predicted_rms_m / expected_m, 1.0, 0.01);
  }
}

TEST(AccuracyTest, GivesNoPredictionWithoutACovariance) {
  auto poses = accuracy_track({}, {});
  for (TrackedPose& pose : poses) {
    pose.covariance = {};
  }
  const auto report = test_tip_accuracy(poses, accuracy_pointer(), {});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_FALSE(report->single_point.predicted_rms_m);
  EXPECT_FALSE(report->distances);
}

TEST(AccuracyTest, FailsATrackerThatScatters) {
  AccuracyTrackOptions track;
  track.position_noise_m = 0.0008;
  track.rotation_noise_rad = 0.004;
  const auto report = tested(track);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_GT(report->single_point.spread.p95_m, 0.001);
  EXPECT_NE(report->single_point.verdict(), Verdict::kPass);
  AccuracyOptions strict;
  strict.single_point_p95 = {0.0001, 0.0005};
  const auto strictly = tested(track, strict);
  ASSERT_TRUE(strictly);
  EXPECT_EQ(strictly->single_point.verdict(), Verdict::kFail);
  EXPECT_EQ(strictly->verdict(), Verdict::kFail);
}

TEST(AccuracyTest, FailsATipThatIsElsewhereAndSaysWhere) {
  for (const Vec3 error :
       {Vec3{0.003, 0, 0}, Vec3{0, -0.003, 0}, Vec3{0, 0, 0.003}, Vec3{0.010, 0.008, -0.012}}) {
    AccuracyTrackOptions track;
    track.tip_error_m = error;
    const auto report = tested(track);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->turning.verdict(), Verdict::kFail);
    EXPECT_EQ(report->verdict(), Verdict::kFail);
    EXPECT_LT((report->turning.tip_bias_m - error).norm(), 0.0001);
    EXPECT_LT(report->turning.tip_bias_sigma_m, 0.0001);
    // Held still and held alike from touch to touch, a wrong tip goes unnoticed.
    EXPECT_EQ(report->single_point.verdict(), Verdict::kPass);
    ASSERT_TRUE(report->distances);
    EXPECT_EQ(report->distances->verdict(), Verdict::kPass);
    // The bias explains the spread.
    EXPECT_GT(report->turning.spread.rms_m, 5 * report->turning.residual_rms_m);
  }
}

TEST(AccuracyTest, NotesATipThatIsALittleElsewhere) {
  AccuracyTrackOptions track;
  track.tip_error_m = {0.0015, 0, 0};
  const auto report = tested(track);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->turning.verdict(), Verdict::kNote);
  EXPECT_EQ(report->verdict(), Verdict::kNote);
  track.tip_error_m = {0.0005, 0, 0};
  const auto less = tested(track);
  ASSERT_TRUE(less);
  EXPECT_EQ(less->verdict(), Verdict::kPass);
}

TEST(AccuracyTest, ShowsTheSpreadGrowWithTheTilt) {
  AccuracyTrackOptions track;
  track.tip_error_m = {0.006, 0, 0.006};
  const auto report = tested(track);
  ASSERT_TRUE(report) << report.error().message;
  const auto& bins = report->turning.bins;
  ASSERT_GE(bins.size(), 3u);
  EXPECT_GT(bins.back().rms_m, bins.front().rms_m);
  std::size_t samples = 0;
  for (const TiltBin& bin : bins) {
    samples += bin.samples;
  }
  EXPECT_EQ(samples, report->turning.spread.samples);
}

TEST(AccuracyTest, DetectsATipThatSlips) {
  for (const double slip_m : {0.003, 0.004, 0.009, 0.015}) {
    AccuracyTrackOptions track;
    track.slip_while_turning_m = {slip_m, 0, 0};
    const auto report = tested(track);
    ASSERT_TRUE(report) << slip_m << report.error().message;
    EXPECT_THAT(report->turning.failure, HasSubstr("the tip slipped by")) << slip_m;
    EXPECT_EQ(report->verdict(), Verdict::kFail);
  }
  AccuracyTrackOptions track;
  track.still_s = 5.0;
  track.slip_while_still_m = {0, 0, 0.003};
  const auto report = tested(track);
  ASSERT_TRUE(report) << report.error().message;
  // The few samples between the slip and the moment that is found for it take a little off.
  EXPECT_THAT(report->single_point.failure, ContainsRegex("the tip slipped by (2.[89]|3.0) mm"));
  EXPECT_EQ(report->verdict(), Verdict::kFail);
}

TEST(AccuracyTest, TakesNoNoiseForASlip) {
  // A poor tracker: 1.3 mm at the tip.
  AccuracyTrackOptions track;
  track.position_noise_m = 0.0003;
  track.rotation_noise_rad = 0.006;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    track.seed = seed;
    const auto report = tested(track);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_THAT(report->single_point.failure, IsEmpty());
    EXPECT_THAT(report->turning.failure, IsEmpty());
    EXPECT_LT(report->turning.tip_bias_m.norm(), 0.001);
    EXPECT_LT(report->distances->max_error_m, 0.002);
  }
}

TEST(AccuracyTest, FailsDistancesThatAreTooLong) {
  AccuracyTrackOptions track;
  track.board_scale = 1.02;
  const auto report = tested(track);
  ASSERT_TRUE(report) << report.error().message;
  ASSERT_TRUE(report->distances);
  // Distances of 50-156 mm: 2 % of the longest is 3.1 mm, of their mean 1.8 mm.
  EXPECT_NEAR(report->distances->max_error_m, 0.02 * std::hypot(0.12, 0.10), 0.0002);
  EXPECT_GT(report->distances->mean_error_m, 0.001);
  EXPECT_EQ(report->distances->verdict(), Verdict::kFail);
  EXPECT_EQ(report->verdict(), Verdict::kFail);
  track.board_scale = 1.0;
  EXPECT_LT(std::abs(tested(track)->distances->mean_error_m), 0.0001);
}

TEST(AccuracyTest, FailsABoardTouchedInAnotherOrder) {
  auto board = accuracy_board();
  std::swap(board[1], board[7]);
  const auto report =
      test_tip_accuracy(accuracy_track({}, board), accuracy_pointer(), accuracy_board());
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_THAT(report->distances->failure, HasSubstr("another order"));
  EXPECT_EQ(report->verdict(), Verdict::kFail);
}

TEST(AccuracyTest, LeavesOutRestsThatTouchNoPoint) {
  AccuracyTrackOptions track;
  track.lay_aside = true;
  const auto report = tested(track);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->distances->stray_rests, 1u);
  EXPECT_EQ(report->verdict(), Verdict::kPass);
  EXPECT_LT(report->distances->fit_rmse_m, 0.0002);
}

TEST(AccuracyTest, CountsMeasuredPosesOnly) {
  auto poses = accuracy_track({}, accuracy_board());
  const auto before = test_tip_accuracy(poses, accuracy_pointer(), accuracy_board());
  ASSERT_TRUE(before);
  // Wild predictions between the measurements change nothing.
  std::vector<TrackedPose> mixed;
  for (const TrackedPose& pose : poses) {
    mixed.push_back(pose);
    TrackedPose predicted = pose;
    predicted.status = PoseStatus::kPredicted;
    predicted.value = {pose.value.rotation(), pose.value.translation() + Vec3{0.1, 0, 0}};
    mixed.push_back(predicted);
  }
  const auto after = test_tip_accuracy(mixed, accuracy_pointer(), accuracy_board());
  ASSERT_TRUE(after);
  EXPECT_EQ(after->single_point.spread.rms_m, before->single_point.spread.rms_m);
  EXPECT_EQ(after->distances->rms_m, before->distances->rms_m);
}

TEST(AccuracyTest, WorksAtTenPairsASecondAndWithHiddenTags) {
  AccuracyTrackOptions track;
  track.rate_hz = 10.0;
  const auto slow = tested(track);
  ASSERT_TRUE(slow) << slow.error().message;
  EXPECT_EQ(slow->verdict(), Verdict::kPass);
  // Every third second the tag is hidden for 0.4 s.
  track = {};
  track.touch_s = 1.2;
  auto poses = accuracy_track(track, accuracy_board());
  std::erase_if(poses, [](const TrackedPose& pose) {
    return std::fmod(seconds(pose.time.time_since_epoch()), 3.0) < 0.4;
  });
  const auto hidden = test_tip_accuracy(poses, accuracy_pointer(), accuracy_board());
  ASSERT_TRUE(hidden) << hidden.error().message;
  EXPECT_EQ(hidden->verdict(), Verdict::kPass);
}

}  // namespace
}  // namespace orthonav::nav::tip_accuracy_test
