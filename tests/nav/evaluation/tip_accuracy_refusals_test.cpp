#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/nav/evaluation/tested_tip.h"
#include "tests/support/accuracy_track.h"

namespace orthonav::nav::tip_accuracy_test {
namespace {

using test::accuracy_board;
using test::accuracy_pointer;
using test::accuracy_track;
using test::AccuracyTrackOptions;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::string refusal(const Result<AccuracyReport>& report) {
  return report ? "nothing was refused" : report.error().message;
}

TEST(AccuracyTest, RefusesABoardTouchedInPart) {
  auto board = accuracy_board();
  board.pop_back();
  EXPECT_THAT(
      refusal(test_tip_accuracy(accuracy_track({}, board), accuracy_pointer(), accuracy_board())),
      HasSubstr("the tip rested at 8 places away from the dimple, must be 9 to 13"));
}

TEST(AccuracyTest, RefusesTooFewData) {
  EXPECT_THAT(refusal(test_tip_accuracy({}, accuracy_pointer(), {})),
              HasSubstr("0 measured poses"));
  AccuracyTrackOptions track;
  track.tilt_rad = 0.1;
  EXPECT_THAT(refusal(tested(track)), HasSubstr("never turned about its resting tip"));
  track = {};
  track.turning_s = 1.5;
  track.still_s = 1.0;
  EXPECT_THAT(refusal(tested(track)), HasSubstr("at least 3.0 s"));
  track = {};
  track.still_s = 0.5;
  EXPECT_THAT(refusal(tested(track)), HasSubstr("held still in the dimple for"));
  // A tip farther off than any pointer's file is another tool.
  track = {};
  track.tip_error_m = {0.05, 0, 0};
  EXPECT_THAT(refusal(tested(track)), HasSubstr("never turned"));
}

TEST(AccuracyTest, RefusesBadInput) {
  auto poses = accuracy_track({}, accuracy_board());
  std::swap(poses[4].time, poses[5].time);
  EXPECT_THAT(refusal(test_tip_accuracy(poses, accuracy_pointer(), {})),
              HasSubstr("do not increase"));
  poses = accuracy_track({}, accuracy_board());
  poses[7].value = {poses[7].value.rotation(), {std::numeric_limits<double>::quiet_NaN(), 0, 0}};
  EXPECT_THAT(refusal(test_tip_accuracy(poses, accuracy_pointer(), {})), HasSubstr("not finite"));
  poses = accuracy_track({}, accuracy_board());
  const std::vector<Vec3> two = {{0, 0, 0}, {0.1, 0, 0}};
  EXPECT_THAT(refusal(test_tip_accuracy(poses, accuracy_pointer(), two)), HasSubstr("2 points"));
  const std::vector<Vec3> close = {{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.01, 0}};
  EXPECT_THAT(refusal(test_tip_accuracy(poses, accuracy_pointer(), close)),
              HasSubstr("10.0 mm apart, at least 15.0 mm"));
  AccuracyOptions options;
  options.tip_bias = {0.002, 0.001};
  EXPECT_THAT(refusal(tested({}, options)), HasSubstr("limits of tip_bias 2 and 1 mm"));
  options = {};
  options.turning_p95.pass_m = std::nan("");
  options.distance_max.note_m = 1.0;
  EXPECT_THAT(options.check(), SizeIs(2));
  EXPECT_THAT(AccuracyOptions().check(), IsEmpty());
}

}  // namespace
}  // namespace orthonav::nav::tip_accuracy_test
