#include <gtest/gtest.h>

#include <numbers>

#include "engine/session/session.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_guiding_test {
namespace {

using test::guide_at;
using test::ScriptedOperation;

constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};
// Arithmetic on values of the order of 1: far below what any device resolves.
constexpr double kExact = 1e-9;

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

TEST(Session, MeasuresTheAngleBetweenToolAndPlan) {
  ScriptedOperation s;
  s.accepts_first_level();
  s.says("next");
  s.tracker().guide = guide_at(kLeftEntry, radians(7.0));
  s.pair();
  const Guidance& g = s.pair();
  ASSERT_TRUE(g.tool.has_value());
  EXPECT_NEAR(g.tool->measured->angle_rad, radians(7.0), kExact);
  EXPECT_NEAR(g.tool->measured->tip_to_entry_m, 0.0, kExact);
}

TEST(Session, PredictsTheOverlayButNotTheNumber) {
  ScriptedOperation s;
  s.latency = std::chrono::microseconds(33333);
  s.accepts_first_level();
  s.says("next");
  s.tracker().guide = guide_at(kLeftEntry, radians(4.0));
  s.pair();
  s.tracker().guide = guide_at(kLeftEntry, radians(5.0));
  const Guidance& g = s.pair();
  ASSERT_TRUE(g.tool.has_value());
  EXPECT_NEAR(g.tool->measured->angle_rad, radians(5.0), kExact);
  EXPECT_NEAR(g.tool->shown.angle_rad, radians(6.0), 1e-6);
}

TEST(Session, HidesGuidanceOnceThePoseIsOlderThanItsLimit) {
  ScriptedOperation s;
  s.accepts_first_level();
  s.says("next");
  s.tracker().guide = guide_at(kLeftEntry, 0.0);
  s.pairs(3);
  ASSERT_TRUE(s.pair().tool.has_value());
  // The tracker keeps predicting, but its measurement still ages.
  s.tracker().guide_origin = PoseStatus::kPredicted;
  EXPECT_TRUE(s.pair().tool.has_value());
  EXPECT_TRUE(s.pair().status.tool_lost);
  EXPECT_FALSE(s.pairs(2).tool.has_value());
  s.tracker().guide_origin = PoseStatus::kMeasured;
  const Guidance& g = s.pair();
  EXPECT_TRUE(g.tool.has_value());
  EXPECT_FALSE(g.status.tool_lost);
}

/// Records what the session reports about each finished screw.
struct DoneScrews : SessionObserver {
  void screw_done(Timestamp /*time*/, const LevelState& /*level*/, std::size_t /*screw*/,
                  const ToolGuidance* at_depth) override {
    told.push_back(at_depth ? std::optional(*at_depth) : std::nullopt);
  }
  std::vector<std::optional<ToolGuidance>> told;
};

/// Into the bone along the planned axis, which is -y here.
constexpr Vec3 kDeep{0.0, -0.012, 0.0};

TEST(Session, TellsOfTheToolAtDepthAndNotOfTheOneDrawnBack) {
  ScriptedOperation s;
  DoneScrews done;
  s.session().observe(&done);
  s.accepts_first_level();
  s.says("next");
  s.tracker().guide = guide_at(kLeftEntry, 0.10);
  s.pairs(3);
  s.tracker().guide = guide_at(kLeftEntry + kDeep, 0.02);
  s.pairs(3);
  s.tracker().guide = guide_at(kLeftEntry + 0.9 * kDeep, 0.03);  // it begins to be drawn back
  s.pairs(3);
  s.tracker().guide = guide_at(kLeftEntry - 2.0 * kDeep, 0.30);
  s.pairs(3);
  s.says("next");
  ASSERT_EQ(done.told.size(), 1u);
  ASSERT_TRUE(done.told[0] && done.told[0]->measured);
  EXPECT_NEAR(done.told[0]->measured->angle_rad, 0.02, 1e-9);
  EXPECT_NEAR(done.told[0]->measured->depth_m, 0.012, 1e-6);
}

TEST(Session, TellsOfNoToolThatWasNeverAtTheScrew) {
  ScriptedOperation s;
  DoneScrews done;
  s.session().observe(&done);
  s.accepts_first_level();
  s.says("next");
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0.2, -0.1, 0.0}, 0.02);  // laid down beside
  s.pairs(3);
  s.says("next");
  ASSERT_EQ(done.told.size(), 1u);
  EXPECT_FALSE(done.told[0].has_value());
}

}  // namespace
}  // namespace orthonav::engine::session_guiding_test
