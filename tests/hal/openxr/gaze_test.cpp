// Where the wearer looks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/hal/openxr/runtime_test.h"
#include "tests/render/test_scenes.h"

namespace orthonav::test::gaze_test {
namespace {

class GazeTest : public RuntimeTest {
 protected:
  void begin(const std::function<void(RuntimeTraits&)>& change = {}) {
    RuntimeTraits traits;
    traits.eye_gaze = true;
    if (change) {
      change(traits);
    }
    runtime().reset(traits);
    runtime().set_head([](XrTime) { return XrPosef{{0, 0, 0, 1}, {0, 0, 0}}; });
    open();
    ASSERT_TRUE(present().ok());
    ASSERT_TRUE(
        show(render::sphere_scene(render::MeshStyle::kSolid, {1, 1, 1, 1}, {0, 0, -1}, 301)).ok());
    const std::size_t before = count_drawn();
    ASSERT_TRUE(eventually([&] { return count_drawn() >= before + 3; }));
  }
  /// Sets the eyes; returns the presenter's gaze a few frames later.
  std::optional<Gaze> gaze_of(const GazeState& state) {
    runtime().set_gaze(state);
    EXPECT_TRUE(frames_pass(5));
    return presenter_->gaze();
  }
  static GazeState looking() {
    GazeState state;
    state.active = true;
    // 0.4 rad to the left, from a little above the point between the eyes.
    state.in_viewer = {{0, std::sin(0.2f), 0, std::cos(0.2f)}, {0, 0.01f, 0}};
    return state;
  }
};

TEST_F(GazeTest, IsARayInTheWorldWhereTheEyesAreSeen) {
  begin();
  const auto gaze = gaze_of(looking());
  ASSERT_TRUE(gaze.has_value());
  EXPECT_NEAR(gaze->origin.v.y, 0.01, 1e-6);
  EXPECT_NEAR(gaze->direction.v.x, -std::sin(0.4), 1e-6);
  EXPECT_NEAR(gaze->direction.v.z, -std::cos(0.4), 1e-6);
  // The cameras' clock stands still, and the sample is 5 ms old.
  EXPECT_NEAR(seconds(gaze->time - kStart), -0.005, 1e-3);
}

TEST_F(GazeTest, IsAbsentWhereItIsGuessedOrOldOrNotThere) {
  begin();
  ASSERT_TRUE(gaze_of(looking()).has_value());
  GazeState state = looking();
  state.tracked = false;
  EXPECT_FALSE(gaze_of(state).has_value());
  state = looking();
  state.age_ns = 90'000'000;
  EXPECT_TRUE(gaze_of(state).has_value());
  state.age_ns = 101'000'000;
  EXPECT_FALSE(gaze_of(state).has_value());
  EXPECT_FALSE(gaze_of({}).has_value());
  state = looking();
  state.in_viewer.orientation = {};
  EXPECT_FALSE(gaze_of(state).has_value());
}

TEST_F(GazeTest, IsAbsentWhileTheHeadIsNotLocated) {
  begin();
  ASSERT_TRUE(gaze_of(looking()).has_value());
  runtime().set_tracked(false, false);
  EXPECT_FALSE(gaze_of(looking()).has_value());
}

TEST_F(GazeTest, IsAbsentWhereTheRuntimeOrTheHeadsetOffersNone) {
  begin([](RuntimeTraits& traits) { traits.eye_gaze = false; });
  EXPECT_FALSE(gaze_of(looking()).has_value());
  presenter_.reset();
  headset_.reset();
  begin([](RuntimeTraits& traits) { traits.sees_eyes = false; });
  EXPECT_FALSE(gaze_of(looking()).has_value());
}

TEST_F(GazeTest, ComesBackWithANewSession) {
  begin();
  ASSERT_TRUE(gaze_of(looking()).has_value());
  runtime().lose_session(true);
  ASSERT_TRUE(eventually([&] { return runtime().sessions() == 2; }));
  const std::size_t before = count_drawn();
  ASSERT_TRUE(eventually([&] { return count_drawn() >= before + 3; }));
  EXPECT_TRUE(gaze_of(looking()).has_value());
}

}  // namespace
}  // namespace orthonav::test::gaze_test
