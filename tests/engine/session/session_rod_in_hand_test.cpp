#include <gmock/gmock.h>

#include <cmath>
#include <stdexcept>

#include "base/angle.h"
#include "engine/session/session.h"
#include "engine/session/wording.h"
#include "tests/support/rod_on_table.h"
#include "tests/support/said.h"

namespace orthonav::engine::session_rod_in_hand_test {
namespace {

using test::notice_of;
using test::said;
using test::state;
using test::step_of;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using enum ClickerAction;

/// Four times the standard error of a bend that is not near the rod's end.
constexpr double kFound_rad = 2.0 * kRadiansPerDegree;

/// The heads of the left rod are touched; a rod lies on the table, to be bent and stroked.
class RodInHandSession : public ::testing::Test {
 protected:
  RodInHandSession() { test::touches_heads_of_a_rod(s); }

  [[nodiscard]] const RodState& rod() { return s.session().rods()[0]; }
  [[nodiscard]] const nav::RodInstructions& told() { return *rod().instructions; }
  [[nodiscard]] Vec3 in_world(Vec3 in_rod) { return made.world_from_rod * in_rod + made.table_m; }
  /// The straight rod is not stroked.
  const Guidance& measures_first_bend(double too_far_rad = 0.0) {
    s.says("next");
    s.says("next");
    return made.is_bent_and_measured(s, too_far_rad);
  }
  const Guidance& measures_next_bend(double too_far_rad = 0.0) {
    s.says("next");
    return made.is_bent_and_measured(s, too_far_rad);
  }
  /// The first bend is made, to be stroked.
  void makes_first_bend() {
    s.says("next");
    s.says("next");
    made.bends = {told().bends[0].arc};
  }
  [[nodiscard]] const RodInHandSoFar* so_far() { return state<RodInHandSoFar>(s.pair()); }
  [[nodiscard]] static RodNotMeasured::Kind refusal(const Guidance& g) {
    const auto* refused = said<RodNotMeasured>(g);
    return refused ? refused->kind : throw std::runtime_error("nothing was refused");
  }

  test::RodOnTable made;
  test::ScriptedOperation s;
};

TEST_F(RodInHandSession, ShowsTheStraightRodWhereItWasStroked) {
  ASSERT_TRUE(rod().instructions) << rod().no_instructions;
  ASSERT_GE(told().bends.size(), 2u);
  const double length_m = told().cut_length_m();
  EXPECT_THAT(detail_text(s.says("next").status), StartsWith("stroke the straight rod "));
  const Guidance& stroked = made.is_stroked(s, length_m);
  EXPECT_TRUE(stroked.rod_stroked);
  EXPECT_EQ(so_far()->points, 270u) << "90 pairs on each side";
  const Guidance& g = s.says("save");
  ASSERT_TRUE(rod().lying) << detail_text(g.status);
  EXPECT_TRUE(rod().measured.empty());
  EXPECT_LT((rod().lying->axis.front().v - made.table_m).norm(), 0.003) << "its first end";
  EXPECT_NEAR((rod().lying->axis.back() - rod().lying->axis.front()).norm(), length_m, 0.004);
  const Vec3 first_m = in_world({0, 0, told().bends[0].arc.centre_m});
  EXPECT_LT((rod().lying->bend.at.v - first_m).norm(), 0.003);
  EXPECT_FALSE(rod().lying->towards) << "the line can't be felt";
  EXPECT_FALSE(rod().lying->cut);
  EXPECT_THAT(detail_text(g.status), StartsWith("bend 1: "));
  EXPECT_THAT(detail_text(g.status), HasSubstr("towards the line, set "));
}

TEST_F(RodInHandSession, SaysWhereToCutARodThatIsTooLong) {
  s.says("next");
  made.is_stroked(s, told().cut_length_m() + 0.05);
  const Guidance& g = s.says("save");
  ASSERT_TRUE(rod().lying && rod().lying->cut) << detail_text(g.status);
  const Vec3 cut_m = in_world({0, 0, told().cut_length_m()});
  EXPECT_LT((rod().lying->cut->at.v - cut_m).norm(), 0.003);
  EXPECT_THAT(detail_text(g.status), StartsWith("cut to "));
}

TEST_F(RodInHandSession, MeasuresABendAndInstructsWhatIsLeft) {
  const nav::RodInstructions before = told();
  const double too_far_rad = 4.0 * kRadiansPerDegree;
  const Guidance& g = measures_first_bend(too_far_rad);
  ASSERT_EQ(rod().measured.size(), 1u) << detail_text(g.status);
  const nav::MeasuredBend& found = rod().measured[0].found;
  EXPECT_NEAR(found.arc.angle_rad, made.bends[0].angle_rad, kFound_rad);
  EXPECT_LT(found.angle_se_rad, 0.5 * kFound_rad);
  EXPECT_LT(found.one_sided, 0.3);
  EXPECT_EQ(told().made, 1u);
  EXPECT_DOUBLE_EQ(told().bends[0].arc.angle_rad, found.arc.angle_rad);
  EXPECT_DOUBLE_EQ(told().bends[0].set_rad, before.bends[0].set_rad) << "as it was set";
  EXPECT_GT(std::abs(told().bends[1].set_rad - before.bends[1].set_rad), 0.001)
      << "the others make up for it";
  ASSERT_TRUE(rod().lying && rod().lying->next && rod().lying->towards);
  EXPECT_EQ(rod().lying->next->number, 2u);
  // Where the far end goes, by the rod as it is.
  const nav::RodPlace place = nav::rod_place(made.bends, told().bends[1].arc.centre_m);
  const double roll_rad = told().bends[1].arc.roll_rad;
  const Vec3 towards =
      made.world_from_rod * (std::cos(roll_rad) * place.line + std::sin(roll_rad) * place.beside);
  EXPECT_GT(rod().lying->towards->dot(towards), std::cos(10.0 * kRadiansPerDegree));
  EXPECT_LT((rod().lying->bend.at.v - in_world(place.at_m)).norm(), 0.002);
  EXPECT_THAT(detail_text(g.status), StartsWith("bend 2: "));
  EXPECT_THAT(detail_text(g.status), HasSubstr(", then say go to next"));
}

TEST_F(RodInHandSession, GoesOnToTheLastBend) {
  measures_first_bend();
  for (std::size_t bend = 2; bend <= told().bends.size(); ++bend) {
    s.says("next");
    EXPECT_FALSE(rod().lying) << "it is taken up";
    const Guidance& g = made.is_bent_and_measured(s);
    ASSERT_EQ(rod().measured.size(), bend) << detail_text(g.status);
  }
  EXPECT_THAT(detail_text(s.pair().status), HasSubstr("all bends are made, say finish rod"));
  EXPECT_EQ(refusal(s.says("next")), RodNotMeasured::Kind::kAllMade);
  EXPECT_EQ(step_of(s.says("done")), "rod right");
  EXPECT_EQ(rod().measured.size(), told().bends.size()) << "kept for the report";
  EXPECT_FALSE(rod().lying);
}

TEST_F(RodInHandSession, DoesNotShowItForever) {
  measures_first_bend();
  s.pairs(29 * 30);
  EXPECT_TRUE(rod().lying);
  const Guidance& g = s.pairs(2 * 30);
  EXPECT_FALSE(rod().lying);
  EXPECT_THAT(detail_text(g.status), HasSubstr("; no longer shown: it may have moved"));
  EXPECT_EQ(rod().measured.size(), 1u) << "what was measured still holds";
}

TEST_F(RodInHandSession, GoesBackStepByStep) {
  const nav::RodInstructions before = told();
  measures_first_bend(0.05);
  s.says("next");
  made.is_stroked(s, 0, 0.0, 0.1);
  EXPECT_GT(so_far()->points, 0u);
  s.says("delete");
  EXPECT_EQ(so_far()->points, 0u) << "the strokes";
  EXPECT_EQ(so_far()->made, 2u);
  s.says("delete");
  EXPECT_EQ(so_far()->made, 1u) << "the second bend";
  EXPECT_FALSE(so_far()->stroking);
  s.says("delete");
  EXPECT_TRUE(so_far()->stroking) << "the measured bend";
  EXPECT_TRUE(rod().measured.empty());
  EXPECT_DOUBLE_EQ(told().bends[1].set_rad, before.bends[1].set_rad);
  s.says("delete");
  EXPECT_EQ(so_far()->made, 0u);
  const Guidance& g = s.says("delete");
  EXPECT_NE(state<HeadsSoFar>(g), nullptr) << "heads are touched again";
  EXPECT_EQ(g.rods[0].heads.size(), 4u);
  EXPECT_EQ(s.says("delete").rods[0].heads.size(), 3u) << "and now a head is taken back";
}

TEST_F(RodInHandSession, RefusesTooFewPoints) {
  s.says("next");
  made.is_stroked(s, 0, 0.0, 0.01);
  s.says("delete");
  const Guidance& g = s.says("save");
  EXPECT_EQ(refusal(g), RodNotMeasured::Kind::kRefused);
  EXPECT_EQ(detail_text(g.status), "rod not measured: stroke of the rod has 0 points, limit 30");
  EXPECT_FALSE(rod().lying);
}

TEST_F(RodInHandSession, RefusesAStrokeOfOneSideOfTheBend) {
  makes_first_bend();
  made.is_stroked(s, made.bends[0].centre_m);
  const Guidance& g = s.says("save");
  EXPECT_EQ(refusal(g), RodNotMeasured::Kind::kRefused) << detail_text(g.status);
  EXPECT_TRUE(rod().measured.empty());
  EXPECT_GT(so_far()->points, 0u) << "more may be stroked";
}

TEST_F(RodInHandSession, RefusesASinglePass) {
  makes_first_bend();
  made.is_stroked(s, 0, 0.0, told().cut_length_m());
  const Guidance& g = s.says("save");
  EXPECT_EQ(refusal(g), RodNotMeasured::Kind::kOneSide) << detail_text(g.status);
  EXPECT_THAT(detail_text(g.status), HasSubstr("stroked on one side alone: stroke it on 3 sides"));
  EXPECT_TRUE(rod().measured.empty());
}

TEST_F(RodInHandSession, RefusesARodThatMovedMeanwhile) {
  makes_first_bend();
  const double length_m = told().cut_length_m();
  made.is_stroked(s, 0, 0.0, length_m);
  made.is_stroked(s, 1, 0.0, length_m);
  made.table_m += made.world_from_rod * Vec3{0.015, 0.015, 0.0};
  made.is_stroked(s, 2, 0.0, length_m);
  const Guidance& g = s.says("save");
  EXPECT_EQ(refusal(g), RodNotMeasured::Kind::kRefused);
  EXPECT_THAT(detail_text(g.status), HasSubstr(" off the rod (rms), limit "));
  EXPECT_TRUE(rod().measured.empty());
}

TEST_F(RodInHandSession, MeasuresNoRodBeforeItsHeadsAreTouched) {
  test::ScriptedOperation other;
  other.finishes_every_screw();
  const Guidance& g = other.says("next");
  EXPECT_EQ(refusal(g), RodNotMeasured::Kind::kNoInstructions);
  EXPECT_EQ(notice_of(other.says("save")), Notice::kNotPossibleNow);
}

TEST_F(RodInHandSession, SkipsNoBend) {
  s.says("next");
  s.says("next");
  EXPECT_EQ(refusal(s.says("next")), RodNotMeasured::Kind::kMeasureFirst);
  EXPECT_EQ(so_far()->made, 1u);
}

TEST_F(RodInHandSession, SavesNothingTwice) {
  measures_first_bend();
  EXPECT_EQ(notice_of(s.says("save")), Notice::kNotPossibleNow);
  EXPECT_EQ(rod().measured.size(), 1u);
}

/// Bent by 30° too far, with one bend left to make up for it.
TEST_F(RodInHandSession, GivesUpARodThatCannotReachTheHeads) {
  const nav::RodInstructions before = told();
  measures_first_bend();
  ASSERT_EQ(rod().measured.size(), 1u) << detail_text(s.pair().status);
  const Guidance& g = measures_next_bend(30.0 * kRadiansPerDegree);
  ASSERT_THAT(detail_text(g.status), HasSubstr("begin another"));
  EXPECT_TRUE(rod().measured.empty());
  EXPECT_EQ(told().made, 0u);
  EXPECT_DOUBLE_EQ(told().bends[0].set_rad, before.bends[0].set_rad);
  const Guidance& later = s.pairs(120);
  EXPECT_THAT(detail_text(later.status), HasSubstr("this rod cannot be corrected: take a new one"));
  s.says("delete");
  ASSERT_NE(so_far(), nullptr) << "the stroke may have been bad";
  EXPECT_EQ(so_far()->made, 2u);
  EXPECT_TRUE(so_far()->stroking);
  EXPECT_EQ(rod().measured.size(), 1u);
}

/// A bender that was set wrongly, beyond what a hand errs, is measured as it is.
TEST_F(RodInHandSession, IsNotMisledByWhatWasInstructed) {
  measures_first_bend(12.0 * kRadiansPerDegree);
  ASSERT_EQ(rod().measured.size(), 1u) << detail_text(s.pair().status);
  EXPECT_NEAR(rod().measured[0].found.arc.angle_rad, made.bends[0].angle_rad, kFound_rad);
}

TEST_F(RodInHandSession, AClickWhileItIsMeasuredTouchesNoHead) {
  s.says("next");
  EXPECT_EQ(s.touches({0.02, 0.05, 0.16}).rods[0].heads.size(), 4u);
}

TEST_F(RodInHandSession, ALongPressIsAStroke) {
  s.says("next");
  s.does({kPress});
  EXPECT_EQ(notice_of(s.does({kHold})), Notice::kNone);
  EXPECT_GT(so_far()->points, 0u);
}

TEST_F(RodInHandSession, TakesNoPointWhereThePointerIsNotSeen) {
  s.says("next");
  s.tracker().pointer.reset();
  s.does({kPress});
  s.pairs(5);
  EXPECT_EQ(so_far()->points, 0u);
  EXPECT_TRUE(s.pair().status.tool_lost);
}

TEST_F(RodInHandSession, ForgetsWhatWasMeasuredWhenTheMapMoves) {
  measures_first_bend();
  ++s.map_epoch;
  const Guidance& g = s.pair();
  EXPECT_TRUE(g.rods[0].measured.empty());
  EXPECT_FALSE(g.rods[0].lying);
  EXPECT_FALSE(g.rod_stroked);
  EXPECT_NE(state<HeadsSoFar>(g), nullptr);
}

TEST_F(RodInHandSession, TheOtherSideBeginsWithItsHeads) {
  measures_first_bend();
  const Guidance& g = s.says("done");
  EXPECT_EQ(step_of(g), "rod right");
  EXPECT_FALSE(g.rod_stroked);
  EXPECT_NE(state<HeadsSoFar>(g), nullptr);
  EXPECT_EQ(s.touches({-0.02, 0.03, 0.00}).rods[1].heads.size(), 1u);
}

}  // namespace
}  // namespace orthonav::engine::session_rod_in_hand_test
