#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/projection.h"
#include "tests/hal/openxr/drawn_frames.h"
#include "tests/render/test_scenes.h"

namespace orthonav::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

render::Scene some_scene() {
  return render::sphere_scene(render::MeshStyle::kSolid, {1, 1, 1, 1}, {0, 0, -0.6f}, 301);
}

/// Presents a ball ahead until some frames were drawn.
class LossTest : public RuntimeTest {
 protected:
  void SetUp() override {
    open();
    ASSERT_TRUE(present().ok());
    ASSERT_TRUE(show(some_scene()).ok());
    ASSERT_TRUE(draws());
  }
  /// Three frames more.
  bool draws() {
    const std::size_t before = count_drawn();
    return eventually([&] { return count_drawn() >= before + 3; });
  }
  [[nodiscard]] std::int64_t epoch() {
    StereoFrame frame;
    return next_frame(frame) ? frame.map_epoch : -1;
  }
  bool next_frame(StereoFrame& frame) {
    const auto answer = headset_->cameras()->next(frame);
    return answer.ok() && *answer == Next::kFrame;
  }
};

TEST_F(LossTest, ALostSessionIsMadeAnew) {
  runtime().lose_session(true);
  ASSERT_TRUE(eventually([&] { return runtime().sessions() == 2; }));
  EXPECT_TRUE(draws());
  const auto report = presenter_->stop();
  EXPECT_EQ(report.losses, 1);
  EXPECT_THAT(report.problems, ElementsAre("openxr: the session: XR_ERROR_SESSION_LOST"));
  EXPECT_EQ(runtime().instances(), 1);
}

TEST_F(LossTest, ASessionThatFailsWithoutAWordIsMadeAnew) {
  runtime().lose_session(false);
  ASSERT_TRUE(eventually([&] { return runtime().sessions() == 2; }));
  EXPECT_TRUE(draws());
  EXPECT_THAT(presenter_->stop().problems, ::testing::Contains(HasSubstr("XR_ERROR_SESSION_LOST")));
}

TEST_F(LossTest, ALostRuntimeIsSurvivedWithOneLine) {
  runtime().stay_away(3);
  runtime().lose_instance(false);
  ASSERT_TRUE(eventually([&] { return runtime().instances() == 2; }));
  EXPECT_TRUE(draws());
  // The drawing side is told once.
  const Status told = show(some_scene());
  ASSERT_FALSE(told.ok());
  EXPECT_THAT(told.error().message, HasSubstr("XR_ERROR_INSTANCE_LOST"));
  EXPECT_TRUE(show(some_scene()).ok());
  const auto report = presenter_->stop();
  EXPECT_EQ(report.losses, 1);
  EXPECT_THAT(report.problems, ::testing::Each(HasSubstr("XR_ERROR_INSTANCE_LOST")));
}

TEST_F(LossTest, AnAnnouncedLossOfTheRuntimeIsSurvivedToo) {
  runtime().lose_instance(true);
  ASSERT_TRUE(eventually([&] { return runtime().instances() == 2; }));
  EXPECT_TRUE(draws());
  EXPECT_EQ(presenter_->stop().losses, 1);
}

TEST_F(LossTest, AStoppedSessionGoesOnWithoutANewOne) {
  runtime().tell(XR_SESSION_STATE_STOPPING);
  ASSERT_TRUE(draws());
  EXPECT_EQ(runtime().sessions(), 1);
  EXPECT_THAT(presenter_->stop().problems, IsEmpty());
}

TEST_F(LossTest, NothingIsDrawnForASessionThatIsNotVisible) {
  runtime().tell(XR_SESSION_STATE_SYNCHRONIZED);
  ASSERT_TRUE(frames_pass(3));
  const std::size_t before = count_drawn();
  ASSERT_TRUE(frames_pass(10));
  EXPECT_EQ(count_drawn(), before);
  runtime().tell(XR_SESSION_STATE_VISIBLE);
  EXPECT_TRUE(draws());
}

TEST_F(LossTest, AnEndFromOutsideIsTold) {
  runtime().tell(XR_SESSION_STATE_EXITING);
  ASSERT_TRUE(eventually([&] { return over_.load(); }));
  EXPECT_THAT(presenter_->stop().problems,
              ElementsAre("openxr: the session was ended from outside"));
}

TEST_F(LossTest, AWearersPlaceStaysWhereItIsWhenTheSpaceMoves) {
  const auto eye = [&] {
    const render::View view = drawn().back().views.front();
    return render::transformed(render::rigid_inverse(view.eye_from_world), {0, 0, 0});
  };
  const render::Float3 before = eye();
  runtime().recentre({{0, 0, 0, 1}, {0.5f, 0, -0.25f}}, true, 3);
  ASSERT_TRUE(frames_pass(10));
  const render::Float3 after = eye();
  // The head sways by a centimetre; the space moved by half a metre.
  EXPECT_NEAR(after.x, before.x, 0.03f);
  EXPECT_NEAR(after.z, before.z, 0.03f);
}

/// Cameras that deliver pairs as the test's clock goes on.
fake::Script pairs(int count) {
  fake::Script script;
  for (int i = 0; i < count; ++i) {
    StereoFrame frame = scripted_frame(i);
    frame.time = Timestamp(std::chrono::seconds(100)) + std::chrono::milliseconds(40 * (i + 1));
    script.camera.emplace_back(std::move(frame));
  }
  return script;
}

const openxr::RigOnHead kOnTheHead = {
    true, {rotation_from_vector({0.1, 0.2, -0.05}), {0.03, 0.02, -0.04}}};

/// The viewer's pose that the double has for a pair's time.
Transform<World, Eye> expected_viewer(const XrPosef& pose) {
  const auto& q = pose.orientation;
  const Vec3 v = {static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z)};
  const double angle = 2.0 * std::atan2(v.norm(), static_cast<double>(q.w));
  const Vec3 rotation_rad = v.norm() > 0.0 ? v * (angle / v.norm()) : Vec3{};
  return {rotation_from_vector(rotation_rad),
          {static_cast<double>(pose.position.x), static_cast<double>(pose.position.y),
           static_cast<double>(pose.position.z)}};
}

class MountedTest : public LossTest {
 protected:
  void SetUp() override {
    runtime().set_head([](XrTime time) {
      const float half = 1e-10f * static_cast<float>(time % 1'000'000'000);
      return XrPosef{{0, std::sin(half), 0, std::cos(half)}, {0, 1.6f, half}};
    });
    open({}, kOnTheHead, pairs(8));
    ASSERT_TRUE(present().ok());
    ASSERT_TRUE(show(some_scene()).ok());
    ASSERT_TRUE(draws());
  }
};

TEST_F(MountedTest, PairsGetThePoseOfTheHeadset) {
  StereoFrame frame;
  runtime().set_head([](XrTime) {
    return XrPosef{{0, 0.1f, 0, std::sqrt(0.99f)}, {0.5f, 1.6f, -0.2f}};
  });
  ASSERT_TRUE(next_frame(frame));
  ASSERT_TRUE(frame.world_from_rig.has_value());
  const auto expected = expected_viewer({{0, 0.1f, 0, std::sqrt(0.99f)}, {0.5f, 1.6f, -0.2f}}) *
                        kOnTheHead.view_from_rig;
  EXPECT_LT((frame.world_from_rig->translation() - expected.translation()).norm(), 1e-6);
  EXPECT_LT(
      vector_from_rotation(frame.world_from_rig->rotation().transposed() * expected.rotation())
          .norm(),
      1e-5);
  EXPECT_EQ(headset_->head().world_from_rig(frame.time).status, PoseStatus::kMeasured);
}

TEST_F(MountedTest, PairsHaveNoPoseThatIsOnlyGuessed) {
  StereoFrame frame;
  runtime().set_tracked(true, false);
  ASSERT_TRUE(next_frame(frame));
  EXPECT_FALSE(frame.world_from_rig.has_value());
  EXPECT_EQ(headset_->head().world_from_rig(frame.time).status, PoseStatus::kPredicted);
  runtime().set_tracked(false, false);
  ASSERT_TRUE(next_frame(frame));
  EXPECT_FALSE(frame.world_from_rig.has_value());
  EXPECT_EQ(headset_->head().world_from_rig(frame.time).status, PoseStatus::kLost);
}

TEST_F(MountedTest, NothingInTheWorldIsDrawnWhereThePositionIsGuessed) {
  runtime().set_tracked(true, false);
  ASSERT_TRUE(frames_pass(5));
  const std::size_t before = count_drawn();
  ASSERT_TRUE(frames_pass(10));
  const auto frames = drawn();
  ASSERT_GT(frames.size(), before);
  for (std::size_t i = before; i < frames.size(); ++i) {
    EXPECT_TRUE(hangs_on_head(frames[i].scene)) << "frame " << i;
  }
}

TEST_F(MountedTest, TheMapsEpochRisesWithAMoveAndANewSession) {
  EXPECT_EQ(epoch(), 0);
  runtime().recentre({{0, 0, 0, 1}, {1, 0, 0}}, false, 1);
  ASSERT_TRUE(frames_pass(3));
  EXPECT_EQ(epoch(), 1);
  EXPECT_EQ(epoch(), 1);
  runtime().lose_session(true);
  ASSERT_TRUE(eventually([&] { return runtime().sessions() == 2; }));
  ASSERT_TRUE(draws());
  EXPECT_EQ(epoch(), 2);
}

TEST_F(MountedTest, TheMapsEpochRisesWithAJumpThatTheRuntimeDoesNotTellOf) {
  StereoFrame frame;
  const auto at = [](float x) {
    return [x](XrTime) { return XrPosef{{0, 0, 0, 1}, {x, 1.6f, 0}}; };
  };
  runtime().set_head(at(0));
  ASSERT_TRUE(next_frame(frame));
  ASSERT_TRUE(next_frame(frame));
  const Timestamp before = frame.time;
  EXPECT_EQ(frame.map_epoch, 0);
  runtime().set_head(at(0.02f));
  EXPECT_EQ(epoch(), 0) << "the twin: a head's move";
  runtime().set_head(at(0.423f));
  EXPECT_EQ(epoch(), 1);
  EXPECT_EQ(epoch(), 1);
  EXPECT_EQ(headset_->head().world_from_rig(before).status, PoseStatus::kLost);
}

TEST_F(MountedTest, WithoutSessionTheHeadIsLostAndPairsHaveNoPose) {
  presenter_->stop();
  StereoFrame frame;
  ASSERT_TRUE(next_frame(frame));
  EXPECT_FALSE(frame.world_from_rig.has_value());
  EXPECT_EQ(headset_->head().world_from_rig(frame.time).status, PoseStatus::kLost);
}

}  // namespace
}  // namespace orthonav::test
