#include "hal/sim/sim_headset.h"

#include <gmock/gmock.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include "hal/sim/hololens2.h"
#include "tests/hal/sim/test_rooms.h"

namespace orthonav::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

SimOptions hovering(std::uint64_t seed = 1) {
  SimOptions options;
  options.seed = seed;
  options.surgeon = false;
  options.render = false;
  return options;
}

std::unique_ptr<SimHeadset> opened(const SimOptions& options, RoomDescription room = {}) {
  if (room.tools.empty()) {
    room.tools = test_tools();
  }
  auto headset = SimHeadset::open(std::move(room), options);
  EXPECT_TRUE(headset.ok()) << headset.error().message;
  return std::move(headset).value();
}

StereoFrame next_frame(SimHeadset& headset) {
  StereoFrame frame;
  const auto next = headset.cameras().next(frame);
  EXPECT_TRUE(next.ok()) << next.error().message;
  EXPECT_EQ(*next, Next::kFrame);
  return frame;
}

std::string refusal(RoomDescription room, SimOptions options = hovering()) {
  const auto headset = SimHeadset::open(std::move(room), options);
  return headset.ok() ? "accepted" : headset.error().message;
}

TEST(SimHeadset, FastPaceAdvancesAFrameAtEachCall) {
  const auto headset = opened(hovering());
  const StereoFrame first = next_frame(*headset);
  const StereoFrame second = next_frame(*headset);
  EXPECT_NEAR(seconds(second.time - first.time), 1.0 / 30.0, 1e-7);
  EXPECT_EQ(second.sequence, first.sequence + 1);
  EXPECT_EQ(second.time.time_since_epoch().count() % 100, 0) << "files hold ticks of 100 ns";
  EXPECT_GT(headset->clock().now(), second.time) << "an image exists after its exposure";
  EXPECT_LT(headset->clock().now() - second.time, std::chrono::milliseconds(15));
}

TEST(SimHeadset, EndsAtItsLimitForGood) {
  SimOptions options = hovering();
  options.limit_s = 1.0;
  const auto headset = opened(options);
  StereoFrame frame;
  int frames = 0;
  for (;; ++frames) {
    const auto next = headset->cameras().next(frame);
    ASSERT_TRUE(next.ok());
    if (*next == Next::kEnd) {
      break;
    }
    ASSERT_LT(frames, 100);
  }
  EXPECT_EQ(frames, 30);
  EXPECT_EQ(*headset->cameras().next(frame), Next::kEnd);
}

TEST(SimHeadset, RealtimePaceHasNothingBeforeTheFirstFrameIsDue) {
  SimOptions options = hovering();
  options.pace = Pace::kRealtime;
  options.frame_rate_hz = 1.0;
  const auto headset = opened(options);
  StereoFrame frame;
  const auto next = headset->cameras().next(frame);
  ASSERT_TRUE(next.ok());
  EXPECT_EQ(*next, Next::kNone);
}

TEST(SimHeadset, PerfectHeadPoseIsTheTruth) {
  SimOptions options = hovering();
  options.error_model = ErrorModel::perfect();
  const auto headset = opened(options);
  for (int i = 0; i < 5; ++i) {
    const StereoFrame frame = next_frame(*headset);
    ASSERT_TRUE(frame.world_from_rig.has_value());
    const auto truth = headset->world_from_room() * headset->state().room_from_rig;
    EXPECT_LT((frame.world_from_rig->translation() - truth.translation()).norm(), 1e-9);
    EXPECT_LT(rotation_angle_rad(frame.world_from_rig->rotation(), truth.rotation()), 1e-9);
  }
}

TEST(SimHeadset, ReportedHeadPoseHasTheNoiseOfItsMagnitudes) {
  SimOptions options = hovering();
  options.error_model.head_pose_noise_m = 0.001;
  options.error_model.head_pose_noise_rad = 0.002;
  const auto headset = opened(options);
  double translation = 0.0;
  double rotation = 0.0;
  constexpr int kFrames = 3000;
  for (int i = 0; i < kFrames; ++i) {
    const StereoFrame frame = next_frame(*headset);
    const auto truth = headset->world_from_room() * headset->state().room_from_rig;
    translation += (frame.world_from_rig->translation() - truth.translation()).squared_norm();
    rotation += std::pow(rotation_angle_rad(frame.world_from_rig->rotation(), truth.rotation()), 2);
  }
  // Five standard errors of a variance from 9,000 draws: 5·sqrt(2/9000) = 7.5 %, half of it here.
  EXPECT_NEAR(std::sqrt(translation / kFrames / 3), 0.001, 0.00004);
  EXPECT_NEAR(std::sqrt(rotation / kFrames / 3), 0.002, 0.00008);
}

TEST(SimHeadset, HeadSwaysAndMapDriftsByTheirMagnitudes) {
  SimOptions options = hovering();
  options.error_model.map_drift_m_per_sqrt_s = 0.001;
  const auto headset = opened(options);
  next_frame(*headset);
  const auto start = headset->world_from_room();
  Vec3 sum;
  double squares = 0.0;
  constexpr int kFrames = 6000;
  for (int i = 0; i < kFrames; ++i) {
    next_frame(*headset);
    const Vec3 head = headset->state().room_from_rig.translation();
    sum += head;
    squares += head.squared_norm();
  }
  const double variance = squares / kFrames - (sum / kFrames).squared_norm();
  // Sway in rotation turns about the point between the cameras and adds next to nothing.
  EXPECT_NEAR(std::sqrt(variance / 3), ErrorModel{}.head_sway_m, 0.003);
  // 200 s of a walk of 1 mm per root second and axis: 24 mm expected length.
  const double drift = (headset->world_from_room().translation() - start.translation()).norm();
  EXPECT_GT(drift, 0.004);
  EXPECT_LT(drift, 0.080);
}

TEST(SimHeadset, PredictsTheHeadFromItsVelocityAndLosesItBeyondItsReach) {
  SimOptions options = hovering();
  options.error_model.head_pose_noise_m = 0.0;
  options.error_model.head_pose_noise_rad = 0.0;
  const auto headset = opened(options);
  EXPECT_EQ(headset->head().world_from_rig(headset->clock().now()).status, PoseStatus::kLost);
  StereoFrame frame;
  for (int i = 0; i < 50; ++i) {
    frame = next_frame(*headset);
  }
  const Timestamp ahead = frame.time + (next_frame(*headset).time - frame.time);
  const auto predicted = headset->head().world_from_rig(ahead + std::chrono::milliseconds(33));
  EXPECT_EQ(predicted.status, PoseStatus::kPredicted);
  next_frame(*headset);
  const auto truth = headset->world_from_room() * headset->state().room_from_rig;
  // A swaying head is predicted over a frame within a tenth of a millimetre.
  EXPECT_LT((predicted.value.translation() - truth.translation()).norm(), 0.0005);
  EXPECT_EQ(headset->head().world_from_rig(frame.time).status, PoseStatus::kMeasured);
  EXPECT_EQ(headset->head().world_from_rig(ahead + std::chrono::milliseconds(200)).status,
            PoseStatus::kLost);
}

/// A room point as both cameras of a calibration would see it from the headset's true place.
bool both_see(const StereoCalibration& cameras, const SimHeadset& headset, Point<Room> point) {
  const Point<Rig> in_rig = headset.state().room_from_rig.inverse() * point;
  return cameras.left.project((cameras.left_from_rig * in_rig).v).has_value() &&
         cameras.right.project((cameras.right_from_rig * in_rig).v).has_value();
}

TEST(SimHeadset, HoveringToolsShowTheirTagsToBothCameras) {
  const StereoCalibration cameras = hololens2_calibration();
  const auto headset = opened(hovering());
  for (int i = 0; i < 300; ++i) {
    next_frame(*headset);
    const RoomState state = headset->state();
    for (std::size_t t = 0; t < state.room_from_marker.size(); ++t) {
      ASSERT_TRUE(state.tool_present[t]);
      const auto& tag = state.room_from_marker[t];
      const double half = 0.6 * headset->room().tools[t].size_m;
      for (const double x : {-half, half}) {
        for (const double y : {-half, half}) {
          EXPECT_TRUE(both_see(cameras, *headset, tag * Point<Marker>{{x, y, 0.0}}));
        }
      }
      const Vec3 view = (state.room_from_rig.translation() - tag.translation()).normalized();
      EXPECT_GT((tag * Direction<Marker>{{0, 0, 1}}).v.dot(view), std::cos(0.9));
    }
  }
}

TEST(SimHeadset, RefusesWhatMakesNoSenseInOneLine) {
  RoomDescription room = synthetic_case().room;
  EXPECT_EQ(refusal(room), "accepted");
  SimOptions options = hovering();
  options.error_model.tremor_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(room, options), HasSubstr("tremor_m"));
  options = hovering();
  options.frame_rate_hz = 0.0;
  EXPECT_THAT(refusal(room, options), HasSubstr("frame rate is 0"));
  options = hovering();
  options.limit_s = -1.0;
  EXPECT_THAT(refusal(room, options), HasSubstr("time limit is -1"));
  options = hovering();
  options.frame_rate_hz = 200.0;
  options.error_model.exposure_s = 0.02;
  EXPECT_THAT(refusal(room, options), HasSubstr("longer than a frame"));
}

TEST(SimHeadset, RefusesBrokenRooms) {
  const RoomDescription good = synthetic_case().room;
  RoomDescription room = good;
  room.levels[1].label = "L4";
  EXPECT_THAT(refusal(room), HasSubstr("\"L4\": label is given twice"));
  room = good;
  room.levels[0].triangles[5][1] = 1'000'000;
  EXPECT_THAT(refusal(room), HasSubstr("vertex 1000000"));
  room = good;
  room.levels[0].vertices_m[3].y = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal(room), HasSubstr("not finite"));
  room = good;
  room.levels[0].triangles.clear();
  EXPECT_THAT(refusal(room), HasSubstr("no triangles"));
  room = good;
  room.operated = {"L9"};
  EXPECT_THAT(refusal(room), HasSubstr("\"L9\" does not exist"));
  room = good;
  room.tools[1].id = room.tools[0].id;
  EXPECT_THAT(refusal(room), HasSubstr("given twice"));
  room = good;
  room.tools[1].family = "tag99h9";
  EXPECT_THAT(refusal(room),
              AllOf(HasSubstr("\"guide\": tag family \"tag99h9\" is not known"),
                    HasSubstr("tag36h11, tag36h10, tag25h9, tag16h5, tagStandard41h12")));
  room = good;
  room.tools[1].id = 587;
  EXPECT_THAT(refusal(room), HasSubstr("tag id is 587, tag36h11 has 0 to 586"));
  room.tools[1].id = -1;
  EXPECT_THAT(refusal(room), HasSubstr("tag id is -1"));
  room.tools[1].id = 586;
  EXPECT_EQ(refusal(room), "accepted");
  room = good;
  room.tools[0].axis_in_marker = {};
  EXPECT_THAT(refusal(room), HasSubstr("axis has length 0"));
  room = good;
  room.tools.pop_back();
  EXPECT_EQ(refusal(room), "accepted");
  SimOptions surgery = hovering();
  surgery.surgeon = true;
  EXPECT_THAT(refusal(room, surgery), HasSubstr("no guide"));
}

TEST(SimHeadset, TrueCamerasDifferFromTheReportedOnesByTheSeed) {
  // Same seed, same pixels; another seed, another head and other cameras.
  SimOptions options = hovering(4);
  options.render = true;
  const StereoFrame a = next_frame(*opened(options));
  const StereoFrame b = next_frame(*opened(options));
  EXPECT_EQ(a.left, b.left);
  EXPECT_EQ(a.right, b.right);
  options.seed = 5;
  const StereoFrame c = next_frame(*opened(options));
  EXPECT_NE(a.left, c.left);
  EXPECT_NE(a.left, a.right);
}

TEST(SimHeadset, PartsMayBeUsedFromDifferentThreads) {
  // Nothing to compare: the thread sanitizer would find a race.
  SimOptions options;
  options.render = false;
  const TestCase test_case = synthetic_case();
  const auto headset = opened(options, test_case.room);
  std::atomic<bool> running{true};
  std::thread other([&headset, &running] {
    std::vector<ClickerEvent> clicks;
    std::vector<Phrase> phrases;
    while (running) {
      const Timestamp now = headset->clock().now();
      EXPECT_TRUE(headset->clicker().poll(now, clicks).ok());
      EXPECT_TRUE(headset->voice().poll(now, phrases).ok());
      static_cast<void>(headset->head().world_from_rig(now));
      ShownFrame shown;
      shown.display_time = headset->display().predicted_display_time(now);
      shown.status = ShownStatus{.at = {Step::kDigitize, "L4", {}}};
      // Refused while no new frame has moved the clock.
      static_cast<void>(headset->display().shown(shown));
      static_cast<void>(headset->state());
      static_cast<void>(headset->world_from_room());
    }
  });
  for (int i = 0; i < 600; ++i) {
    next_frame(*headset);
  }
  running = false;
  other.join();
}

}  // namespace
}  // namespace orthonav::sim
