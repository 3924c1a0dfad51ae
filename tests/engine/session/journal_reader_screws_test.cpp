#include <gmock/gmock.h>

#include "tests/engine/session/journaled_operation.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::journal_reader_test {
namespace {

TEST(JournalReader, KnowsWhereTheToolWentAndNamesWhatWasNotMeasured) {
  Journaled j({"L4"}, Verification::kByTouch);
  test::ScriptedOperation& s = j.operation;
  s.registers_within(0.0003);
  s.accepts_first_by_touch();
  s.touches_dimple();
  s.says("next");
  for (const double depth_m : {0.0, 0.005, 0.010, 0.010, 0.010}) {
    s.tracker().guide = test::guide_at({0.0153, 0.020 - depth_m, 0.0}, 0.01);
    s.pair();
  }
  s.says("next");
  s.says("next");
  s.tracker().guide.reset();
  s.touches_dimple();
  s.says("next");
  s.says("next");
  s.says("next");
  const LevelState& level = s.session().levels()[0];
  ASSERT_TRUE(level.screws[0].executed);
  ASSERT_FALSE(level.screws[1].executed);
  const SessionRecord record = j.finished("");
  const RecordedScrew& left = record.levels.at(0).screws.at(0);
  ASSERT_TRUE(left.executed);
  EXPECT_EQ(left.executed->pairs, level.screws[0].executed->pairs);
  EXPECT_NEAR((left.executed->axis.point - level.screws[0].executed->axis.point).norm(), 0.0,
              1e-12);
  EXPECT_NEAR(left.executed->axis.direction.dot(level.screws[0].executed->axis.direction), 1.0,
              1e-12);
  EXPECT_NEAR(left.executed->depth_m, 0.010, 1e-3);
  EXPECT_EQ(left.executed->point_covariance_m2.has_value(),
            level.screws[0].executed->point_covariance_m2.has_value());
  ASSERT_TRUE(left.at_depth);
  EXPECT_EQ(left.at_depth->grade, "A");
  EXPECT_EQ(left.at_depth->grade_probability.has_value(),
            level.screws[0].clearance_at_depth->spread.has_value());
  const RecordedScrew& right = record.levels[0].screws.at(1);
  EXPECT_FALSE(right.executed);
  EXPECT_THAT(right.not_measured, ::testing::IsSupersetOf({"executed", "clearance"}));
  ASSERT_TRUE(record.calibration);
  EXPECT_TRUE(record.calibration->tags.empty()) << "nothing tells of it here";
  EXPECT_FALSE(record.calibration->cameras);
}

TEST(JournalReader, KnowsWhatTagsAndCamerasInUseHaveTold) {
  Journaled j({"L4"});
  test::ScriptedOperation& s = j.operation;
  s.tracker().size = nav::TagSize{0.004, 0.001, 40, false, false, 0.003};
  s.accepts_first_level();
  s.says("next");
  s.says("next");
  const SessionRecord record = j.finished("");
  ASSERT_TRUE(record.calibration);
  ASSERT_EQ(record.calibration->tags.size(), 2U);
  EXPECT_EQ(record.calibration->tags[1].tool, "guide");
  EXPECT_NEAR(record.calibration->tags[1].measured, 0.004, 1e-12);
  EXPECT_NEAR(record.calibration->tags[1].sd, 0.001, 1e-12);
  EXPECT_NEAR(record.calibration->tags[1].applied, 0.003, 1e-12);
  EXPECT_FALSE(record.calibration->cameras);
}

/// A click with the sleeve over the left screw's wire, so far off its plan.
void measures_wire(test::ScriptedOperation& s, double beside_m, double angle_rad) {
  using enum ClickerAction;
  s.tracker().guide = test::guide_at(Vec3{0.015 + beside_m, 0.020, 0.0}, angle_rad);
  s.does({kPress});
  s.pair();
  s.does({kRelease, kClick});
}

TEST(JournalReader, KnowsHowEveryWireWasMeasuredKeptOrRedone) {
  Journaled j({"L4"}, Verification::kByTouch);
  test::ScriptedOperation& s = j.operation;
  s.registers_within(0.0003);
  s.accepts_first_by_touch();
  const auto drill = [&s] {
    s.touches_dimple();
    s.says("next");
    s.says("next");
  };
  drill();
  measures_wire(s, 0.0025, 0.0);
  s.says("delete");
  drill();
  measures_wire(s, 0.0, 0.3);
  s.says("accept");
  s.says("next");
  drill();
  s.says("next");
  const SessionRecord record = j.finished("");
  ASSERT_EQ(record.levels.at(0).screws.size(), 2U);
  const RecordedScrew& left = record.levels[0].screws[0];
  EXPECT_TRUE(left.done && left.wire_asked);
  EXPECT_EQ(left.redone, 1);
  ASSERT_TRUE(left.wire);
  const PlacedWire& wire = *s.session().levels()[0].screws[0].wire.measured;
  EXPECT_NEAR(left.wire->angle_rad, wire.axis.angle_rad.value, 1e-9);
  EXPECT_NEAR(left.wire->angle_sd_rad, wire.axis.angle_rad.sd, 1e-9);
  EXPECT_NEAR(left.wire->entry_m, wire.axis.entry_m.value, 1e-9);
  EXPECT_NEAR(left.wire->entry_sd_m, wire.axis.entry_m.sd, 1e-9);
  EXPECT_TRUE(left.wire->kept && !left.wire->within);
  const RecordedScrew& right = record.levels[0].screws[1];
  EXPECT_TRUE(right.done && right.wire_asked);
  EXPECT_FALSE(right.wire) << "not measured";
  EXPECT_EQ(right.redone, 0);
}

TEST(JournalReader, KnowsWhatWasPlannedInSurgery) {
  Journaled j({"L4"});
  j.operation.accepts_first_level();
  j.operation.says("next");
  j.operation.says("move cranial one");
  j.operation.says("shorter");
  j.operation.says("undo");
  j.operation.says("next");
  j.operation.says("move medial two");
  j.operation.says("undo");
  j.operation.says("next");
  const SessionRecord record = j.finished("");
  const auto& screws = record.levels[0].screws;
  ASSERT_EQ(screws.size(), 2u);
  EXPECT_TRUE(screws[0].done) << "what was done later left the plan alone";
  ASSERT_TRUE(screws[0].planned_in_surgery);
  const LevelState& level = j.operation.session().levels()[0];
  const auto difference = nav::difference_of(level.screws[0].preoperative, level.plan.screws[0]);
  EXPECT_NEAR(screws[0].planned_in_surgery->entry_cranial_m, 0.001, 1e-9);
  EXPECT_NEAR(screws[0].planned_in_surgery->length_to_m, difference.length_to_m, 1e-9);
  EXPECT_NEAR(screws[0].planned_in_surgery->length_from_m, 0.035, 1e-9);
  EXPECT_NEAR(screws[0].planned_in_surgery->diameter_to_m, 0.006, 1e-9);
  EXPECT_FALSE(screws[1].planned_in_surgery) << "as before surgery again";
}

}  // namespace
}  // namespace orthonav::engine::journal_reader_test
