#include <gmock/gmock.h>

#include "engine/session/session.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_checks_test {
namespace {

using test::pointer_at;
using test::ScriptedOperation;
using enum ClickerAction;
using ::testing::HasSubstr;

// Arithmetic on values of the order of 1: far below what any device resolves.
constexpr double kExact = 1e-9;
// On the box's posterior face (y = 20 mm), more than 15 mm apart and not on a line.
constexpr Vec3 kFirst{-0.015, 0.020, -0.010};
constexpr Vec3 kSecond{0.015, 0.020, -0.010};
constexpr Vec3 kThird{0.000, 0.020, 0.012};

/// In `verify`, with a registration that puts the box where it is: World is Vertebra.
class CheckedSession : public ::testing::Test {
 protected:
  CheckedSession() : s({"L4", "L5"}, {}, Verification::kByTouch) { s.registers_first_level(); }
  const std::vector<nav::CheckPoint>& points() { return s.session().levels()[0].check_points; }
  ScriptedOperation s;
};

TEST_F(CheckedSession, AcceptsOnceThreeSpreadPlacesLieOnTheSurface) {
  EXPECT_THAT(s.pair().detail, HasSubstr("expected; touch 3 places, 15 mm apart"));
  EXPECT_EQ(s.says("accept").step_text, "verify L4");
  EXPECT_EQ(s.pair().detail, "not accepted: touch 3 places, 15 mm apart");
  EXPECT_THAT(s.touches(kFirst).detail, HasSubstr("touch 2 more places, 15 mm from the others"));
  EXPECT_EQ(s.says("accept").step, Step::kVerify);
  EXPECT_THAT(s.touches(kSecond).detail, HasSubstr("touch 1 more place, 15 mm from the others"));
  EXPECT_EQ(s.says("accept").step, Step::kVerify);
  EXPECT_THAT(s.touches(kThird).detail, HasSubstr("checked, worst 0.0 mm"));
  EXPECT_FALSE(s.pair().levels[0].accepted) << "the word is still his";
  EXPECT_EQ(s.says("accept").step_text, "accepted L4");
  EXPECT_TRUE(s.pair().levels[0].accepted);
}

TEST_F(CheckedSession, RecordsTheSignedDistanceFromTheSurface) {
  s.touches(kFirst + Vec3{0, 0.0012, 0});
  s.touches(kSecond - Vec3{0, 0.0007, 0});
  ASSERT_EQ(points().size(), 2u);
  EXPECT_NEAR(points()[0].distance_m, 0.0012, kExact);
  EXPECT_NEAR(points()[1].distance_m, -0.0007, kExact);
  EXPECT_NEAR((points()[0].place.v - kFirst).norm(), 0.0012, kExact);
  EXPECT_THAT(s.pair().detail, HasSubstr("check point 2: -0.7 mm off"));
}

TEST_F(CheckedSession, AcceptsNothingWithAPlaceTooFarOff) {
  s.touches(kFirst);
  s.touches(kSecond + Vec3{0, 0.0031, 0});
  s.touches(kThird);
  const char* why = "check point 2 is 3.1 mm off, limit 2.0 mm: reject and stroke again";
  EXPECT_THAT(s.pair().detail, HasSubstr(why));
  EXPECT_EQ(s.says("accept").step, Step::kVerify);
  EXPECT_EQ(s.pair().detail, std::string("not accepted: ") + why);
  // The twin: as far as the limit lets it.
  ScriptedOperation near({"L4"}, {}, Verification::kByTouch);
  near.registers_first_level();
  near.touches(kFirst);
  near.touches(kSecond + Vec3{0, 0.0019, 0});
  near.touches(kThird);
  EXPECT_EQ(near.says("accept").step, Step::kAccepted);
}

TEST_F(CheckedSession, TheSamePlaceThreeTimesIsOnePlace) {
  for (int i = 0; i < 3; ++i) {
    s.touches(kFirst + Vec3{0.001 * i, 0, 0});
  }
  EXPECT_THAT(s.pair().detail, HasSubstr("touch 2 more places"));
  EXPECT_EQ(s.says("accept").step, Step::kVerify);
}

TEST_F(CheckedSession, DeleteDropsTheLastCheckPoint) {
  EXPECT_EQ(s.says("delete").detail, "no check point to delete");
  s.touches(kFirst);
  s.touches(kSecond + Vec3{0, 0.0031, 0});
  s.says("delete");
  ASSERT_EQ(points().size(), 1u);
  EXPECT_NEAR((points()[0].place.v - kFirst).norm(), 0.0, kExact);
}

TEST_F(CheckedSession, RejectForgetsThemAndTheNextRegistrationStartsWithNone) {
  s.touches(kFirst);
  s.says("reject");
  EXPECT_TRUE(points().empty());
  s.strokes(5);
  s.says("save");
  EXPECT_EQ(s.does({kDoubleClick}).step, Step::kVerify);
  EXPECT_TRUE(points().empty());
}

TEST_F(CheckedSession, AButtonHeldTooLongOrATipThatMovesRecordsNothing) {
  s.tracker().pointer = pointer_at(kFirst);
  s.does({kPress});
  EXPECT_EQ(s.does({kHold}).detail, "check point not recorded: hold too long");
  s.does({kRelease});
  EXPECT_TRUE(points().empty());
  s.does({kPress});
  s.tracker().pointer = pointer_at(kFirst + Vec3{0.0064, 0, 0});
  s.pair();
  EXPECT_EQ(s.does({kRelease, kClick}).detail,
            "check point not recorded: tip moved 3.2 mm, limit 3.0 mm");
  EXPECT_TRUE(points().empty());
  EXPECT_EQ(s.touches(kFirst).levels[0].check_points.size(), 1u) << "the next starts anew";
}

TEST_F(CheckedSession, RecordsNothingOfAPointerThatIsNotSeen) {
  s.tracker().pointer.reset();
  s.pairs(5);
  const Guidance& g = s.does({kPress, kRelease, kClick});
  EXPECT_TRUE(points().empty());
  EXPECT_EQ(g.detail, "pointer lost; check point not recorded: pointer not seen");
  EXPECT_EQ(s.pairs(100).detail, "pointer lost; touch 3 places, 15 mm apart");
}

TEST_F(CheckedSession, APressFromTheStrokesIsNoTouch) {
  EXPECT_EQ(s.does({kClick}).detail, "check point not recorded: press again");
  EXPECT_TRUE(points().empty());
}

TEST_F(CheckedSession, StopsCountingAtTwenty) {
  for (std::size_t i = 0; i < nav::kMostCheckPoints; ++i) {
    s.touches(kFirst);
  }
  EXPECT_EQ(s.touches(kFirst).detail, "check point not recorded: there are 20 already");
  EXPECT_EQ(points().size(), nav::kMostCheckPoints);
}

TEST_F(CheckedSession, ShowsThemWhileVerifyingOnly) {
  s.touches(kFirst);
  s.touches(kSecond);
  s.touches(kThird);
  EXPECT_EQ(s.pair().levels[0].check_points.size(), 3u);
  EXPECT_EQ(s.says("accept").levels[0].check_points.size(), 3u) << "they stay for the report";
}

TEST(VerifiedByEye, ClicksSayNothingAndTheWordAccepts) {
  ScriptedOperation s({"L4"}, {}, Verification::kByEye);
  s.registers_first_level();
  EXPECT_THAT(s.touches(kFirst).detail, ::testing::StartsWith("RMSE"));
  EXPECT_TRUE(s.session().levels()[0].check_points.empty());
  EXPECT_EQ(s.says("delete").detail, "not possible now: \"delete\"");
  s.tracker().pointer.reset();
  EXPECT_THAT(s.pairs(100).detail, ::testing::StartsWith("RMSE")) << "no tool is in use";
  EXPECT_EQ(s.says("accept").step, Step::kAccepted);
}

TEST(SessionOptions, NamesLimitsOfCheckPointsThatMakeNoSense) {
  SessionOptions bad;
  bad.check_points = {.apart_m = 0.0, .within_m = 0.01, .off_line_m = -1.0};
  EXPECT_EQ(bad.check().size(), 3u);
}

}  // namespace
}  // namespace orthonav::engine::session_checks_test
