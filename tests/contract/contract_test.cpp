#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/contract/device_cases.h"
#include "tests/support/session_log.h"

namespace orthonav {
namespace {

using orthonav::test::DeviceCase;
using orthonav::test::expect_same;
using orthonav::test::play;
using orthonav::test::SessionLog;

/// The promises of every device with cameras. Nothing here depends on the order in which a device's
/// parts are called.
class DeviceContract : public ::testing::TestWithParam<DeviceCase> {
 protected:
  void SetUp() override { ASSERT_NE(headset_, nullptr); }
  std::unique_ptr<Headset> headset_ = GetParam().open();
  static constexpr int kMaxCalls = 2000;
};

TEST_P(DeviceContract, HasAName) { EXPECT_FALSE(headset_->name().empty()); }

TEST_P(DeviceContract, DeliversPairsInOrderOfTheCalibrationsSize) {
  const StereoCalibration& calibration = headset_->cameras()->calibration();
  const SessionLog log = play(*headset_);
  EXPECT_TRUE(log.errors.empty());
  ASSERT_GE(log.moments.size(), 3u);
  for (std::size_t i = 0; i < log.moments.size(); ++i) {
    const StereoFrame& frame = log.moments[i].frame;
    const auto expect_size = [](const GreyImage& image, const CameraModel& camera) {
      EXPECT_EQ(image.width_px, camera.width_px());
      EXPECT_EQ(image.height_px, camera.height_px());
      EXPECT_EQ(image.pixels.size(), static_cast<std::size_t>(image.width_px) * image.height_px);
    };
    expect_size(frame.left, calibration.left);
    expect_size(frame.right, calibration.right);
    EXPECT_GE(frame.sequence, 0);
    if (i == 0) {
      continue;
    }
    EXPECT_GT(frame.time, log.moments[i - 1].frame.time);
    EXPECT_GT(frame.sequence, log.moments[i - 1].frame.sequence);
  }
}

TEST_P(DeviceContract, NeverDeliversTheSameImagesTwice) {
  if (!GetParam().has_images) {
    GTEST_SKIP() << "black by choice";
  }
  const SessionLog log = play(*headset_);
  for (std::size_t i = 1; i < log.moments.size(); ++i) {
    EXPECT_FALSE(log.moments[i].frame.left == log.moments[i - 1].frame.left) << i;
  }
}

TEST_P(DeviceContract, EndsForGood) {
  ASSERT_TRUE(play(*headset_).ended);
  StereoFrame frame;
  for (int i = 0; i < 3; ++i) {
    const auto answer = headset_->cameras()->next(frame);
    ASSERT_TRUE(answer.ok());
    EXPECT_EQ(*answer, Next::kEnd);
  }
}

TEST_P(DeviceContract, GivesTheSameBitsWhenOpenedAgain) {
  // One after the other, because a live device does not wait while another is opened.
  const SessionLog first = play(*headset_);
  const auto again = GetParam().open();
  ASSERT_NE(again, nullptr);
  expect_same(headset_->cameras()->calibration(), again->cameras()->calibration());
  expect_same(first, play(*again));
}

TEST_P(DeviceContract, ReusesTheBuffersOfAFrame) {
  StereoFrame frame;
  std::set<const std::uint8_t*> buffers;
  for (int call = 0; call < kMaxCalls; ++call) {
    const auto answer = headset_->cameras()->next(frame);
    ASSERT_TRUE(answer.ok());
    if (*answer == Next::kEnd) {
      break;
    }
    if (*answer == Next::kFrame) {
      buffers.insert(frame.left.pixels.data());
    }
  }
  // A device may exchange a frame for one of a few of its own, so that nothing is copied.
  constexpr std::size_t kMaxBuffers = 4;
  EXPECT_GE(buffers.size(), 1u);
  EXPECT_LE(buffers.size(), kMaxBuffers);
}

TEST_P(DeviceContract, HasAClockThatNeverGoesBackAndKnowsItsPairs) {
  StereoFrame frame;
  Timestamp last = headset_->clock().now();
  for (int call = 0; call < kMaxCalls; ++call) {
    const auto answer = headset_->cameras()->next(frame);
    ASSERT_TRUE(answer.ok());
    const Timestamp now = headset_->clock().now();
    EXPECT_GE(now, last);
    if (*answer == Next::kFrame) {
      EXPECT_GE(now, frame.time) << "a pair out of the future";
    }
    if (*answer == Next::kEnd) {
      break;
    }
    last = now;
  }
}

TEST_P(DeviceContract, ProjectsWhatItUnprojects) {
  constexpr double kInversePx = 1e-6;  // promised by the camera model
  const StereoCalibration& calibration = headset_->cameras()->calibration();
  for (const CameraModel* camera : {&calibration.left, &calibration.right}) {
    int seen = 0;
    for (double y = 0.5; y < camera->height_px(); y += 23.7) {
      for (double x = 0.5; x < camera->width_px(); x += 31.3) {
        const auto direction = camera->unproject({x, y});
        if (!direction) {
          continue;
        }
        const auto pixel = camera->project(*direction);
        ASSERT_TRUE(pixel.has_value()) << x << ", " << y;
        EXPECT_LT((*pixel - Vec2{x, y}).norm(), kInversePx);
        ++seen;
      }
    }
    EXPECT_GT(seen, 100);
  }
}

TEST_P(DeviceContract, HasTwoCamerasOfOneHead) {
  const StereoCalibration& calibration = headset_->cameras()->calibration();
  const auto right_from_left = calibration.right_from_left();
  EXPECT_LT(right_from_left.translation().norm(), 0.3);
  EXPECT_GT(right_from_left.translation().norm(), 0.05) << "too close for a depth at arm's length";
  EXPECT_LE(orthonormality_error(calibration.left_from_rig.rotation()), 1e-9);
  EXPECT_LE(orthonormality_error(calibration.right_from_rig.rotation()), 1e-9);
  EXPECT_GT(calibration.left_from_rig.rotation().determinant(), 0.0);
  EXPECT_GT(calibration.right_from_rig.rotation().determinant(), 0.0);
}

TEST_P(DeviceContract, KnowsTheHeadWhereAPairKnewIt) {
  // Both are measurements of one pose, so they differ by a few SDs of noise at most.
  constexpr double kNoiseM = 0.005;
  constexpr double kNoiseRad = 0.01;
  int compared = 0;
  for (const auto& moment : play(*headset_).moments) {
    EXPECT_EQ(moment.head_now.time, moment.frame.time);
    if (!moment.frame.world_from_rig) {
      continue;
    }
    const auto& in_frame = *moment.frame.world_from_rig;
    ASSERT_EQ(moment.head_now.status, PoseStatus::kMeasured);
    EXPECT_LT((moment.head_now.value.translation() - in_frame.translation()).norm(), kNoiseM);
    EXPECT_LT(rotation_angle_rad(moment.head_now.value.rotation(), in_frame.rotation()), kNoiseRad);
    ++compared;
  }
  EXPECT_GT(compared, 0);
}

TEST_P(DeviceContract, PredictsTheHeadSoonAndLosesItLater) {
  const SessionLog log = play(*headset_);
  ASSERT_FALSE(log.moments.empty());
  const Timestamp newest = log.moments.back().frame.time;
  ASSERT_TRUE(log.moments.back().frame.world_from_rig.has_value());
  const Timestamp limit = newest + GetParam().head_ahead + HeadTracker::kMaxHeadPrediction;
  const auto later = headset_->head().world_from_rig(limit + Duration(1));
  EXPECT_EQ(later.status, PoseStatus::kLost);
  EXPECT_EQ(later.time, limit + Duration(1));
  const auto soon = headset_->head().world_from_rig(newest + std::chrono::milliseconds(40));
  EXPECT_EQ(soon.status, PoseStatus::kPredicted);
  const double step_m =
      (soon.value.translation() - log.moments.back().frame.world_from_rig->translation()).norm();
  constexpr double kFastHeadM = 0.1;  // in 40 ms
  EXPECT_LT(step_m, kFastHeadM);
}

TEST_P(DeviceContract, AnswersForTheHeadWhenAskedForAnyTime) {
  play(*headset_);
  for (const Timestamp at : {Timestamp::min(), Timestamp{}, Timestamp::max()}) {
    EXPECT_EQ(headset_->head().world_from_rig(at).time, at);
  }
  EXPECT_EQ(headset_->head().world_from_rig(Timestamp::max()).status, PoseStatus::kLost);
}

TEST_P(DeviceContract, AlternatesPressesAndReleasesInOrder) {
  const SessionLog log = play(*headset_);
  EXPECT_EQ(!log.clicker.empty(), GetParam().has_events);
  bool pressed = false;
  Timestamp last = Timestamp::min();
  Timestamp released = Timestamp::min();
  for (const ClickerEvent& event : log.clicker) {
    EXPECT_GE(event.time, last);
    last = event.time;
    if (event.action == ClickerAction::kPress) {
      EXPECT_FALSE(pressed);
      pressed = true;
    } else if (event.action == ClickerAction::kRelease) {
      EXPECT_TRUE(pressed);
      pressed = false;
      released = event.time;
    } else if (event.action == ClickerAction::kHold) {
      EXPECT_TRUE(pressed);
    } else {
      EXPECT_FALSE(pressed);
      EXPECT_GE(event.time, released);
      EXPECT_GT(released, Timestamp::min());
    }
  }
}

TEST_P(DeviceContract, HearsPhrasesInOrderWithAConfidence) {
  const SessionLog log = play(*headset_);
  EXPECT_EQ(!log.voice.empty(), GetParam().has_events);
  Timestamp last = Timestamp::min();
  for (const Phrase& phrase : log.voice) {
    EXPECT_GE(phrase.time, last);
    last = phrase.time;
    EXPECT_FALSE(phrase.text.empty());
    EXPECT_GE(phrase.confidence, 0.0);
    EXPECT_LE(phrase.confidence, 1.0);
  }
}

TEST_P(DeviceContract, DeliversEachEventOnceHoweverItIsAsked) {
  const SessionLog by_frame = play(*headset_);
  const auto again = GetParam().open();
  ASSERT_NE(again, nullptr);
  StereoFrame frame;
  for (int call = 0; call < kMaxCalls; ++call) {
    const auto answer = again->cameras()->next(frame);
    ASSERT_TRUE(answer.ok());
    if (*answer == Next::kEnd) {
      break;
    }
  }
  SessionLog at_once;
  const Timestamp end = again->clock().now();
  ASSERT_TRUE(again->clicker().poll(end, at_once.clicker).ok());
  ASSERT_TRUE(again->voice().poll(end, at_once.voice).ok());
  EXPECT_TRUE(at_once.clicker == by_frame.clicker);
  EXPECT_TRUE(at_once.voice == by_frame.voice);
  const std::size_t clicks = at_once.clicker.size();
  ASSERT_TRUE(again->clicker().poll(end, at_once.clicker).ok());
  EXPECT_EQ(at_once.clicker.size(), clicks);
}

TEST_P(DeviceContract, ShowsNothingBeforeItIsSubmitted) {
  EXPECT_GE(headset_->display_latency(), Duration::zero());
}

std::vector<DeviceCase> with_cameras() {
  std::vector<DeviceCase> all = orthonav::test::device_cases();
  std::erase_if(all, [](const DeviceCase& device) { return device.measures_tools; });
  return all;
}

INSTANTIATE_TEST_SUITE_P(Every, DeviceContract, ::testing::ValuesIn(with_cameras()),
                         [](const auto& device) { return device.param.name; });

}  // namespace
}  // namespace orthonav
