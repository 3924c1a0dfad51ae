#include <gmock/gmock.h>

#include <array>

#include "engine/session/session.h"
#include "engine/session/steps/rod_templating.h"
#include "engine/session/text/wording.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_rod_test {
namespace {

using test::notice_of;
using test::pointer_at;
using test::said;
using test::ScriptedOperation;
using test::state;
using test::step_of;
using test::touch_refusal;
using enum ClickerAction;

// Arithmetic on values of the order of 1: far below what any device resolves.
constexpr double kExact = 1e-9;

class RodSession : public ::testing::Test {
 protected:
  RodSession() { s.finishes_every_screw(); }
  ScriptedOperation s;
};

/// A side with fewer than two screws has nothing to join.
TEST(RodTemplating, AsksOnlyForSidesWithARod) {
  OperationState operation;
  RodTemplating right(false, true);
  EXPECT_EQ(right.side(), nav::Side::kRight);
  EXPECT_FALSE(right.finish(operation));
  RodTemplating left(true, false);
  EXPECT_EQ(left.side(), nav::Side::kLeft);
  EXPECT_FALSE(left.finish(operation));
  RodTemplating both(true, true);
  EXPECT_TRUE(both.finish(operation));
  EXPECT_EQ(both.side(), nav::Side::kRight);
  EXPECT_FALSE(both.finish(operation));
}

TEST_F(RodSession, RecordsHeadsAtTheTipAndJoinsThem) {
  ASSERT_EQ(step_of(s.pair()), "rod left");
  s.touches({0.02, 0.03, 0.00});
  EXPECT_FALSE(s.session().rods()[0].rod.has_value());
  const Guidance& g = s.touches({0.02, 0.03, 0.04});
  ASSERT_EQ(g.rods[0].heads.size(), 2u);
  EXPECT_NEAR((g.rods[0].heads[1].v - Vec3{0.02, 0.03, 0.04}).norm(), 0.0, kExact);
  ASSERT_TRUE(g.rods[0].rod.has_value());
  EXPECT_NEAR(g.rods[0].rod->length_m, 0.04, 1e-6);
  ASSERT_NE(state<HeadsSoFar>(g), nullptr);
  EXPECT_EQ(state<HeadsSoFar>(g)->count, 2u);
}

TEST_F(RodSession, InstructsHowToBendTheRod) {
  s.touches({0.02, 0.03, 0.00});
  const Guidance& straight = s.touches({0.02, 0.03, 0.04});
  ASSERT_TRUE(straight.rods[0].instructions) << straight.rods[0].no_instructions;
  // Two heads: a straight rod, 5 mm longer at both ends than from seat to seat.
  const auto& seats = straight.rods[0].instructions->seats_m;
  ASSERT_EQ(seats.size(), 2u);
  EXPECT_NEAR((seats[0] - Vec3{0.02, 0.03, 0.00}).norm(), 0.006, kExact) << "below the head";
  EXPECT_NEAR(straight.rods[0].instructions->cut_length_m(), (seats[1] - seats[0]).norm() + 0.010,
              1e-6);
  EXPECT_TRUE(straight.rods[0].instructions->bends.empty());
  ASSERT_NE(state<HeadsSoFar>(straight), nullptr);
  EXPECT_TRUE(state<HeadsSoFar>(straight)->cut_length_m.has_value());
  const Guidance& bent = s.touches({0.02, 0.04, 0.08});
  ASSERT_TRUE(bent.rods[0].instructions) << bent.rods[0].no_instructions;
  EXPECT_EQ(bent.rods[0].instructions->bends.size(), 1u);
  EXPECT_FALSE(s.says("delete").rods[0].instructions->bends.size() > 0);
}

TEST(RodSeats, AreThoseOfTheScrewsWhereTheListStatesThem) {
  SessionOptions options;
  options.replan.sizes = {{{0.006, {0.035}, 0.0085}}};  // the box's screws
  ScriptedOperation s({"L4", "L5"}, options);
  s.finishes_every_screw();
  s.touches({0.02, 0.03, 0.00});
  const Guidance& g = s.touches({0.02, 0.03, 0.04});
  ASSERT_TRUE(g.rods[0].instructions) << g.rods[0].no_instructions;
  EXPECT_NEAR((g.rods[0].instructions->seats_m[0] - Vec3{0.02, 0.03, 0.00}).norm(), 0.0085, kExact);
}

TEST_F(RodSession, SaysWhyThereAreNoInstructions) {
  s.touches({0.02, 0.03, 0.00});
  s.touches({0.02, 0.035, 0.02});
  const Guidance& g = s.touches({0.02, 0.03, 0.04});
  EXPECT_TRUE(g.rods[0].rod.has_value());
  EXPECT_FALSE(g.rods[0].instructions.has_value());
  EXPECT_THAT(g.rods[0].no_instructions,
              ::testing::HasSubstr("no bend fits between seats 1 and 2"));
  EXPECT_FALSE(state<HeadsSoFar>(g)->cut_length_m.has_value());
}

TEST_F(RodSession, MakesAHeadSurerThatIsTouchedAgain) {
  s.touches({0.02, 0.03, 0.00});
  const HeadsSoFar once = *state<HeadsSoFar>(s.touches({0.02, 0.03, 0.04}));
  ASSERT_TRUE(once.last);
  EXPECT_EQ(once.last->head, 1u);
  EXPECT_EQ(once.last->touches, 1u);
  const Guidance& g = s.touches({0.0206, 0.03, 0.04});
  ASSERT_EQ(g.rods[0].heads.size(), 2u);
  EXPECT_NEAR(g.rods[0].heads[1].v.x, 0.0203, kExact);
  EXPECT_NEAR((g.rods[0].rod->heads_m[1] - Vec3{0.0203, 0.03, 0.04}).norm(), 0.0, kExact)
      << "the template follows";
  EXPECT_EQ(state<HeadsSoFar>(g)->last->touches, 2u);
  EXPECT_LT(state<HeadsSoFar>(g)->last->head_sd_m, once.last->head_sd_m);
  // "delete" takes one touch back, then the head.
  EXPECT_NEAR(s.says("delete").rods[0].heads[1].v.x, 0.02, kExact);
  EXPECT_EQ(s.says("delete").rods[0].heads.size(), 1u);
}

TEST_F(RodSession, RefusesATouchThatDisagreesWithItsHead) {
  s.touches({0.02, 0.03, 0.00});
  const Guidance& g = s.touches({0.024, 0.03, 0.00});
  ASSERT_EQ(g.rods[0].heads.size(), 1u);
  EXPECT_EQ(g.rods[0].touched.touches_of(0), 1u);
  EXPECT_EQ(touch_refusal(g).kind, TouchRefusal::Kind::kTouchesApart);
  EXPECT_NEAR(touch_refusal(g).value_m, 0.004, kExact);
  EXPECT_THAT(detail_text(g.status), ::testing::StartsWith("head not recorded: touches 4.0 mm "));
}

TEST_F(RodSession, SaysWhichHeadToTouchAgain) {
  const auto touch_again = [this] { return state<HeadsSoFar>(s.pair())->touch_again.has_value(); };
  constexpr std::array<Vec3, 4> kHeads = {
      {{0.02, 0.030, 0.00}, {0.02, 0.032, 0.04}, {0.02, 0.036, 0.08}, {0.02, 0.040, 0.12}}};
  s.touches(kHeads[0]);
  s.touches(kHeads[1]);
  EXPECT_FALSE(touch_again()) << "two heads: any straight rod";
  s.touches(kHeads[2]);
  EXPECT_FALSE(touch_again()) << "three are sure enough";
  const Guidance& g = s.touches(kHeads[3]);
  ASSERT_TRUE(g.rods[0].expected);
  const double once = g.rods[0].expected->within;
  EXPECT_LT(once, 0.95);
  EXPECT_TRUE(touch_again());
  for (const Vec3 head : kHeads) {
    s.touches(head);
  }
  ASSERT_TRUE(s.pair().rods[0].expected);
  EXPECT_GT(s.pair().rods[0].expected->within, once);
}

TEST_F(RodSession, DropsTheLastHead) {
  s.touches({0.02, 0.03, 0.00});
  s.touches({0.02, 0.03, 0.04});
  const Guidance& g = s.says("delete");
  EXPECT_EQ(g.rods[0].heads.size(), 1u);
  EXPECT_FALSE(g.rods[0].rod.has_value());
  s.says("delete");
  EXPECT_EQ(notice_of(s.says("delete")), Notice::kNothingToDelete);
}

TEST_F(RodSession, DoesNotRecordAHeadWithAnUnseenPointer) {
  s.tracker().pointer.reset();
  s.pairs(5);
  const Guidance& g = s.does({kPress, kRelease, kClick});
  EXPECT_TRUE(g.rods[0].heads.empty());
  EXPECT_TRUE(g.status.tool_lost);
  EXPECT_EQ(touch_refusal(g).kind, TouchRefusal::Kind::kPointerNotSeen);
}

TEST_F(RodSession, MovesTheRodsAwayAndBack) {
  s.touches({0.02, 0.03, 0.00});
  EXPECT_TRUE(s.says("move rod").rods_moved_away);
  EXPECT_FALSE(s.says("move rod").rods_moved_away);
}

TEST_F(RodSession, AButtonHeldTooLongRecordsNothingAndSaysSo) {
  s.tracker().pointer = pointer_at({0.02, 0.03, 0.00});
  s.does({kPress});
  EXPECT_EQ(touch_refusal(s.does({kHold})).kind, TouchRefusal::Kind::kHeldTooLong);
  const Guidance& g = s.does({kRelease});
  EXPECT_EQ(touch_refusal(g).kind, TouchRefusal::Kind::kHeldTooLong)
      << "letting go does not wipe it";
  EXPECT_EQ(said<TouchNotRecorded>(g)->what, TouchNotRecorded::What::kHead);
  EXPECT_TRUE(g.rods[0].heads.empty());
  // The next touch starts anew.
  EXPECT_EQ(s.touches({0.02, 0.03, 0.01}).rods[0].heads.size(), 1u);
}

TEST_F(RodSession, TipsAfterTheReleaseHaveNoPartInTheHead) {
  const Vec3 head{0.02, 0.03, 0.00};
  s.tracker().pointer = pointer_at(head);
  s.does({kPress});
  s.does({kRelease});
  s.tracker().pointer = pointer_at(head + Vec3{0.0005, 0, 0});
  s.pairs(3);
  const Guidance& g = s.does({kClick});
  ASSERT_EQ(g.rods[0].heads.size(), 1u);
  EXPECT_NEAR((g.rods[0].heads[0].v - head).norm(), 0.0, kExact);
}

/// A touch of two pairs whose tips lie `apart_m` from each other: the spread is half of it.
const Guidance& touches_moving(ScriptedOperation& s, double apart_m) {
  s.tracker().pointer = pointer_at({0.02, 0.03, 0.00});
  s.does({kPress});
  s.tracker().pointer = pointer_at({0.02 + apart_m, 0.03, 0.00});
  s.pair();
  return s.does({kRelease, kClick});
}

TEST_F(RodSession, RefusesATipThatMoved) {
  EXPECT_EQ(touches_moving(s, 0.0059).rods[0].heads.size(), 1u);
  const Guidance& g = touches_moving(s, 0.0064);
  EXPECT_EQ(g.rods[0].heads.size(), 1u);
  EXPECT_EQ(touch_refusal(g).kind, TouchRefusal::Kind::kTipMoved);
  EXPECT_NEAR(touch_refusal(g).value_m, 0.0032, kExact);
  EXPECT_DOUBLE_EQ(touch_refusal(g).limit_m, 0.003);
}

TEST_F(RodSession, ADoubleClickLeavesNoTouchBehind) {
  const Vec3 head{0.02, 0.03, 0.00};
  s.touches(head);
  s.does({kPress});
  s.does({kRelease, kDoubleClick});
  s.tracker().pointer = pointer_at({0.30, 0.03, 0.00});
  s.pairs(5);
  EXPECT_EQ(s.pair().rods[0].heads.size(), 1u);
  // If the second press had continued the touch, the far tips would spoil this one.
  const Guidance& g = s.touches(head + Vec3{0, 0, 0.04});
  ASSERT_EQ(g.rods[0].heads.size(), 2u) << detail_text(g.status);
  EXPECT_NEAR((g.rods[0].heads[1].v - (head + Vec3{0, 0, 0.04})).norm(), 0.0, kExact);
}

TEST_F(RodSession, APressForOneRodRecordsNothingOnTheOther) {
  s.tracker().pointer = pointer_at({0.02, 0.03, 0.00});
  s.does({kPress});
  EXPECT_EQ(step_of(s.says("done")), "rod right");
  const Guidance& g = s.does({kRelease, kClick});
  EXPECT_TRUE(g.rods[0].heads.empty());
  EXPECT_TRUE(g.rods[1].heads.empty());
  EXPECT_EQ(touch_refusal(g).kind, TouchRefusal::Kind::kPressAgain);
}

/// One level has one screw per side, so there is nothing for a rod to join.
TEST(OneLevel, IsDoneAfterItsLastScrew) {
  ScriptedOperation s({"L5"});
  const Guidance& g = s.finishes_every_screw();
  EXPECT_EQ(g.step, Step::kDone);
  EXPECT_EQ(step_of(g), "done");
  EXPECT_EQ(detail_text(g.status), "") << "no head is asked for";
}

TEST(RodPlanned, WhereASideHasTwoScrews) {
  Operation operation = test::operation_of({"L4", "L5"});
  std::vector<LevelState> levels(2);
  levels[0].plan = operation.levels[0];
  levels[1].plan = operation.levels[1];
  EXPECT_TRUE(rod_planned(levels, nav::Side::kLeft));
  EXPECT_TRUE(rod_planned(levels, nav::Side::kRight));
  levels[1].plan.screws.erase(levels[1].plan.screws.begin());
  ASSERT_EQ(levels[1].plan.screws[0].side, nav::Side::kRight);
  EXPECT_FALSE(rod_planned(levels, nav::Side::kLeft));
  EXPECT_TRUE(rod_planned(levels, nav::Side::kRight));
  EXPECT_FALSE(rod_planned(std::span(levels).first(1), nav::Side::kRight));
}

}  // namespace
}  // namespace orthonav::engine::session_rod_test
