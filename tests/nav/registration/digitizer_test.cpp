#include "nav/registration/digitizer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/allocation_count.h"

namespace orthonav::nav {
namespace {

using std::chrono::milliseconds;

Timestamp at(int ms) { return Timestamp(milliseconds(ms)); }

TrackedPose pose(int ms, PoseStatus status = PoseStatus::kMeasured) {
  TrackedPose tracked;
  tracked.value = {Mat3::identity(), {0.001 * ms, 0, 0}};
  tracked.time = at(ms);
  tracked.status = status;
  return tracked;
}

const Point<Marker> kTip{{0, -0.15, 0}};

/// Holds the button and adds `count` samples from `ms` on, 33 ms apart.
void stroke(Digitizer& digitizer, int ms, int count) {
  digitizer.press(at(ms));
  for (int i = 0; i < count; ++i) {
    EXPECT_TRUE(digitizer.add(pose(ms + 33 * i), kTip));
  }
  digitizer.release(at(ms + 33 * count));
}

TEST(Digitizer, KnowsHowExactlyEachTipWasTracked) {
  Digitizer digitizer;
  digitizer.press(at(10));
  TrackedPose sure = pose(33);
  for (const std::size_t axis : {0U, 1U, 2U}) {
    sure.covariance[7 * axis] = 1e-8;
  }
  EXPECT_TRUE(digitizer.add(sure, kTip));
  // A turn of 2 mrad about x and about z moves a tip 150 mm below by 0.3 mm each.
  TrackedPose rotating = pose(66);
  rotating.covariance[7 * 3] = rotating.covariance[7 * 5] = 4e-6;
  rotating.covariance[7 * 4] = 1.0;  // about the shaft: nothing moves
  EXPECT_TRUE(digitizer.add(rotating, kTip));
  EXPECT_TRUE(digitizer.add(pose(99), kTip));
  digitizer.save();
  const std::vector<Sample>& samples = digitizer.regions()[0].samples;
  ASSERT_EQ(samples.size(), 3U);
  EXPECT_NEAR(samples[0].tip_sd_m, 1e-4, 1e-12);
  EXPECT_NEAR(samples[1].tip_sd_m, 0.0003 * std::sqrt(2.0 / 3.0), 1e-12);
  EXPECT_EQ(samples[2].tip_sd_m, 0.0);
  const auto shafts = digitizer.saved_shafts();
  ASSERT_EQ(shafts.size(), 3U);
  EXPECT_EQ(shafts[0], (Vec3{0.0, 1.0, 0.0}));
}

TEST(Digitizer, TakesTheTipOnlyWhileTheButtonIsHeld) {
  Digitizer digitizer;
  EXPECT_FALSE(digitizer.add(pose(0), kTip));
  digitizer.press(at(10));
  EXPECT_TRUE(digitizer.recording());
  EXPECT_TRUE(digitizer.add(pose(33), kTip));
  digitizer.release(at(40));
  EXPECT_FALSE(digitizer.recording());
  EXPECT_FALSE(digitizer.add(pose(66), kTip));
  ASSERT_EQ(digitizer.regions().size(), 1U);
  ASSERT_EQ(digitizer.regions()[0].samples.size(), 1U);
  EXPECT_EQ(digitizer.regions()[0].samples[0].tip_in_world.v, (Vec3{0.033, -0.15, 0}));
  EXPECT_EQ(digitizer.regions()[0].samples[0].time, at(33));
}

TEST(Digitizer, TakesOnlyWhatWasMeasured) {
  Digitizer digitizer;
  digitizer.press(at(0));
  EXPECT_FALSE(digitizer.add(pose(33, PoseStatus::kPredicted), kTip));
  EXPECT_FALSE(digitizer.add(pose(33, PoseStatus::kLost), kTip));
  EXPECT_TRUE(digitizer.add(pose(33), kTip));
}

TEST(Digitizer, TakesAPoseOnceAndNoneFromBeforeThePress) {
  Digitizer digitizer;
  digitizer.press(at(50));
  EXPECT_FALSE(digitizer.add(pose(33), kTip));
  EXPECT_TRUE(digitizer.add(pose(66), kTip));
  EXPECT_FALSE(digitizer.add(pose(66), kTip));
  EXPECT_FALSE(digitizer.add(pose(60), kTip));
  EXPECT_TRUE(digitizer.add(pose(99), kTip));
}

TEST(Digitizer, RefusesATipThatIsNotFinite) {
  Digitizer digitizer;
  digitizer.press(at(0));
  EXPECT_FALSE(digitizer.add(pose(33), {{std::numeric_limits<double>::quiet_NaN(), 0, 0}}));
  EXPECT_TRUE(digitizer.add(pose(33), kTip));
}

TEST(Digitizer, CollectsSeveralStrokesInOneRegionUntilItIsSaved) {
  Digitizer digitizer;
  stroke(digitizer, 0, 3);
  stroke(digitizer, 1000, 2);
  EXPECT_EQ(digitizer.regions().size(), 1U);
  EXPECT_EQ(digitizer.saved_count(), 0U);
  EXPECT_TRUE(digitizer.saved_points().empty());
  digitizer.save();
  EXPECT_EQ(digitizer.saved_count(), 5U);
  stroke(digitizer, 2000, 4);
  ASSERT_EQ(digitizer.regions().size(), 2U);
  EXPECT_TRUE(digitizer.regions()[0].saved);
  EXPECT_FALSE(digitizer.regions()[1].saved);
  EXPECT_EQ(digitizer.saved_points().size(), 5U);
}

TEST(Digitizer, SavesNothingWhereThereIsNothing) {
  Digitizer digitizer;
  digitizer.save();
  EXPECT_TRUE(digitizer.regions().empty());
  digitizer.press(at(0));
  digitizer.save();
  EXPECT_EQ(digitizer.saved_count(), 0U);
  EXPECT_TRUE(digitizer.add(pose(33), kTip));
  digitizer.save();
  EXPECT_EQ(digitizer.saved_count(), 1U);
}

TEST(Digitizer, DropsOnlyWhatIsNotSaved) {
  Digitizer digitizer;
  stroke(digitizer, 0, 3);
  digitizer.save();
  stroke(digitizer, 1000, 4);
  const auto dropped = digitizer.drop();
  ASSERT_TRUE(dropped.has_value());
  EXPECT_EQ(dropped->samples.size(), 4U);
  EXPECT_FALSE(digitizer.drop().has_value());
  EXPECT_EQ(digitizer.saved_count(), 3U);
}

TEST(Digitizer, DropsNothingButAnEmptyRegionAfterAPressWithoutSamples) {
  Digitizer digitizer;
  stroke(digitizer, 0, 3);
  digitizer.save();
  digitizer.press(at(1000));
  EXPECT_FALSE(digitizer.drop().has_value());
  EXPECT_EQ(digitizer.saved_count(), 3U);
  EXPECT_TRUE(digitizer.recording());
  EXPECT_TRUE(digitizer.add(pose(1033), kTip));
}

TEST(Digitizer, DropsSavedRegionsFromTheLastToTheFirst) {
  Digitizer digitizer;
  stroke(digitizer, 0, 3);
  digitizer.save();
  stroke(digitizer, 1000, 2);
  digitizer.save();
  stroke(digitizer, 2000, 4);  // open: stays
  auto dropped = digitizer.drop_saved();
  ASSERT_TRUE(dropped.has_value());
  EXPECT_EQ(dropped->samples.size(), 2U);
  EXPECT_EQ(digitizer.saved_count(), 3U);
  dropped = digitizer.drop_saved();
  ASSERT_TRUE(dropped.has_value());
  EXPECT_EQ(dropped->samples.size(), 3U);
  EXPECT_FALSE(digitizer.drop_saved().has_value());
  ASSERT_EQ(digitizer.regions().size(), 1U);
  EXPECT_EQ(digitizer.regions()[0].samples.size(), 4U);
}

TEST(Digitizer, KeepsRecordingIntoANewRegionAfterASaveMidStroke) {
  Digitizer digitizer;
  digitizer.press(at(0));
  EXPECT_TRUE(digitizer.add(pose(33), kTip));
  digitizer.save();
  EXPECT_TRUE(digitizer.add(pose(66), kTip));
  EXPECT_EQ(digitizer.regions().size(), 2U);
  EXPECT_EQ(digitizer.saved_count(), 1U);
}

TEST(Digitizer, AllocatesNothingWhileRecording) {
  Digitizer digitizer;
  digitizer.press(at(0));
  const std::size_t before = test::allocation_count();
  for (int i = 1; i <= 1800; ++i) {
    digitizer.add(pose(33 * i), kTip);  // a minute
  }
  EXPECT_EQ(test::allocation_count(), before);
  EXPECT_EQ(digitizer.regions()[0].samples.size(), 1800U);
}

TEST(Digitizer, ForgetsEverythingOnClear) {
  Digitizer digitizer;
  stroke(digitizer, 0, 3);
  digitizer.save();
  digitizer.press(at(1000));
  digitizer.clear();
  EXPECT_FALSE(digitizer.recording());
  EXPECT_TRUE(digitizer.regions().empty());
  EXPECT_FALSE(digitizer.add(pose(1033), kTip));
}

}  // namespace
}  // namespace orthonav::nav
