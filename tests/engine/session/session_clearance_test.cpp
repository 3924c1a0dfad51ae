#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "engine/session/session.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_clearance_test {
namespace {

using test::guide_at;
using test::ScriptedOperation;

/// Tolerance of the search for the least depth on the faces of a box.
constexpr double kSearch_m = 5e-6;
constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};
constexpr double kSd_m = 0.0005;

/// While the left screw of the box is guided: its walls are at x = 30 mm and y = -20 mm, the screw
/// ends at y = -15 mm with a radius of 3 mm.
struct WhileGuiding : ScriptedOperation {
  explicit WhileGuiding(const SessionOptions& options = {}) : ScriptedOperation({"L4"}, options) {
    registers_within(kSd_m);
    accepts_first_level();
    says("next");
  }
  std::optional<nav::ScrewClearance> along(Vec3 entry, double angle_rad = 0.0) {
    tracker().guide = guide_at(entry, angle_rad);
    pair();
    const Guidance& shown = pair();
    return shown.tool ? shown.tool->clearance : std::nullopt;
  }
};

TEST(SessionClearance, IsThatOfTheScrewAlongTheToolAsItIsHeld) {
  WhileGuiding s;
  const auto planned = s.along(kLeftEntry);
  ASSERT_TRUE(planned.has_value());
  EXPECT_NEAR(planned->least.clearance_m, 0.005, kSearch_m);
  EXPECT_TRUE(planned->least.on_tip);
  const auto aside = s.along({0.0255, 0.020, 0.0});
  ASSERT_TRUE(aside && aside->spread);
  EXPECT_NEAR(aside->least.clearance_m, 0.0015, kSearch_m);
  EXPECT_LT(aside->spread->lower_95_m, 0.0015 - 1.645 * std::hypot(kSd_m, nav::kUsualModelError_m))
      << "guide and drill err as well";
  EXPECT_GT(aside->spread->probability(nav::PedicleGrade::kA), 0.7);
  const auto out = s.along({0.0285, 0.020, 0.0});
  EXPECT_NEAR(out->least.clearance_m, -0.0015, kSearch_m);
  EXPECT_GT(out->spread->probability(nav::PedicleGrade::kB), 0.4);
}

/// SD of the clearance beside a wall that runs along the screw, from its bound.
double sd_beside_wall_m(const DrillSkiving& astray) {
  SessionOptions options;
  options.astray = astray;
  const auto aside = WhileGuiding(options).along({0.0255, 0.020, 0.0});
  return (aside->least.clearance_m - aside->spread->lower_95_m) / 1.645;
}

TEST(SessionClearance, CountsHowFarADrillGoesAstray) {
  const double straight_m = sd_beside_wall_m({0.0, 0.0});
  const double skived_m = sd_beside_wall_m({0.0, 0.002});
  const double added_m2 = skived_m * skived_m - straight_m * straight_m;
  // A wall that is off its model here and there makes the bound a little more than the root of the
  // sum.
  EXPECT_NEAR(added_m2, 0.002 * 0.002, 0.3 * 0.002 * 0.002);
  EXPECT_GT(sd_beside_wall_m({0.1, 0.0}), straight_m + 0.001) << "some 35 mm behind the entry";
}

TEST(SessionClearance, CountsTheToolsOwnUncertainty) {
  WhileGuiding s;
  s.registration.uncertainty.reset();
  const auto sure = s.along({0.0255, 0.020, 0.0});
  EXPECT_GT(sure->least.clearance_m - sure->spread->lower_95_m, 0.0) << "the registration's alone";
}

TEST(SessionClearance, IsAbsentWhereNothingIsMeasuredOrAimedAt) {
  WhileGuiding s;
  EXPECT_FALSE(s.along({0.015, 0.040, 0.020}, 0.0).has_value()) << "20 mm off the axis";
  EXPECT_FALSE(s.along(kLeftEntry, 0.6).has_value()) << "34° from the plan";
  ASSERT_TRUE(s.along(kLeftEntry).has_value());
  s.tracker().guide_origin = PoseStatus::kPredicted;
  EXPECT_FALSE(s.along(kLeftEntry).has_value()) << "a prediction is no measurement";
  SessionOptions quiet;
  quiet.live_clearance = false;
  EXPECT_FALSE(WhileGuiding(quiet).along(kLeftEntry).has_value());
}

TEST(SessionClearance, AtDepthIsKeptWithTheScrew) {
  for (const bool live : {true, false}) {
    SessionOptions options;
    options.live_clearance = live;
    WhileGuiding s(options);
    s.along({0.0255, 0.020, 0.0});
    EXPECT_FALSE(s.session().levels()[0].screws[0].clearance_at_depth.has_value());
    s.says("next");
    const auto& kept = s.session().levels()[0].screws[0].clearance_at_depth;
    ASSERT_TRUE(kept.has_value());
    EXPECT_NEAR(kept->least.clearance_m, 0.0015, kSearch_m);
    EXPECT_FALSE(s.session().levels()[0].screws[1].clearance_at_depth.has_value());
  }
}

}  // namespace
}  // namespace orthonav::engine::session_clearance_test
