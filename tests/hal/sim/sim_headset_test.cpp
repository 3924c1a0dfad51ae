#include "hal/sim/sim_headset.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hal/sim/cameras/hololens2.h"
#include "hal/sim/surgeon/surgeon.h"
#include "tests/hal/sim/hovering_headset.h"
#include "tests/hal/sim/test_rooms.h"

namespace orthonav::sim::sim_headset_test {
namespace {

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
    const auto next = headset->cameras()->next(frame);
    ASSERT_TRUE(next.ok());
    if (*next == Next::kEnd) {
      break;
    }
    ASSERT_LT(frames, 100);
  }
  EXPECT_EQ(frames, 30);
  EXPECT_EQ(*headset->cameras()->next(frame), Next::kEnd);
}

TEST(SimHeadset, RealtimePaceHasNothingBeforeTheFirstFrameIsDue) {
  SimOptions options = hovering();
  options.pace = Pace::kRealtime;
  options.frame_rate_hz = 1.0;
  const auto headset = opened(options);
  StereoFrame frame;
  const auto next = headset->cameras()->next(frame);
  ASSERT_TRUE(next.ok());
  EXPECT_EQ(*next, Next::kNone);
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

/// Stands still and keeps what lights up.
class Onlooker : public Surgeon {
 public:
  struct Seen {
    Timestamp display_time;
    Transform<Room, World> room_from_world;
  };
  Onlooker(const Workplace& workplace, std::vector<Seen>& seen)
      : body_(workplace.random, workplace.error_model, 1.0, {}), seen_(seen) {}
  void see(const WornFrame& frame, const Transform<Room, World>& room_from_world) override {
    seen_.push_back({frame.display_time, room_from_world});
  }
  void tick(Timestamp now, const Bearings& /*bearings*/) override { body_.tick(now); }
  void see_reference(Vec3 /*faces*/) override {}
  [[nodiscard]] SurgeonBody& body() override { return body_; }
  [[nodiscard]] bool finished() const override { return false; }
  [[nodiscard]] bool gave_up() const override { return false; }

 private:
  SurgeonBody body_;
  std::vector<Seen>& seen_;
};

TEST(SimHeadset, ItsWearerSeesEachFrameOnceAndInOrderWhenItLightsUp) {
  std::vector<Onlooker::Seen> seen;
  SimOptions options = hovering();
  options.error_model = ErrorModel::perfect();
  options.surgeon = [&seen](const Workplace& workplace) {
    return std::make_unique<Onlooker>(workplace, seen);
  };
  const TestCase test_case = synthetic_case();
  const auto headset = opened(options, test_case.room);
  next_frame(*headset);
  const Timestamp lit = headset->clock().now() + headset->display_latency();
  WornFrame frame;
  for (const Timestamp display_time : {lit, lit, lit - Duration(1), lit + Duration(1)}) {
    frame.display_time = display_time;
    headset->wearer()->see(frame);
  }
  EXPECT_TRUE(seen.empty()) << "not before its time";
  next_frame(*headset);
  next_frame(*headset);
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen[0].display_time, lit);
  EXPECT_EQ(seen[1].display_time, lit + Duration(1));
  // Without errors the headset knows its pose: World is where it is.
  const auto actual = headset->world_from_room().inverse();
  EXPECT_LT((seen[0].room_from_world.translation() - actual.translation()).norm(), 0.001);
}

}  // namespace
}  // namespace orthonav::sim::sim_headset_test
