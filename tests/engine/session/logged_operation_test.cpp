// What a log tells is what the session had, at every moment: state and reports are made of it.
#include "engine/session/log/logged_operation.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "engine/session/log/operation_log.h"
#include "tests/support/is_ok.h"
#include "tests/support/logged_operation.h"
#include "tests/support/memory_env.h"
#include "tests/support/resumed_operation.h"
#include "tests/support/scripted_surgeon.h"

namespace orthonav::engine::logged_operation_test {
namespace {

using test::is_ok;
using test::kLogPath;
using test::MemoryEnv;
using ::testing::HasSubstr;
using ::testing::Not;

/// A session with its log.
struct Logged {
  explicit Logged(const std::vector<std::string>& labels,
                  Verification verification = Verification::kByEye)
      : operation(labels, {}, verification), log(test::log_of(operation, env)) {}

  LoggedOperation so_far() {
    auto told = LoggedOperation::read(env, kLogPath);
    EXPECT_TRUE(is_ok(told));
    return told ? *told : LoggedOperation{};
  }
  LoggedOperation finished(bool done, const std::string& reason = "") {
    EXPECT_TRUE(is_ok(log->finish(done, reason)));
    return so_far();
  }

  MemoryEnv env;
  test::ScriptedOperation operation;
  std::unique_ptr<OperationLog> log;
};

void expect_the_same(const LevelState& told, const LevelState& level) {
  SCOPED_TRACE(level.plan.label);
  EXPECT_EQ(told.plan.label, level.plan.label);
  EXPECT_EQ(told.attempts, level.attempts);
  EXPECT_EQ(told.accepted, level.accepted);
  EXPECT_EQ(told.tag_size.has_value(), level.tag_size.has_value());
  ASSERT_EQ(told.registration.has_value(), level.registration.has_value());
  if (told.registration) {
    EXPECT_EQ(told.registration->world_from_vertebra, level.registration->world_from_vertebra);
    EXPECT_EQ(told.registration->rmse_m, level.registration->rmse_m);
    EXPECT_EQ(told.registration->points, level.registration->points);
    EXPECT_EQ(told.digitization_s, level.digitization_s);
    EXPECT_EQ(nav::worst_m(told.predicted), nav::worst_m(level.predicted));
  }
  ASSERT_EQ(told.check_points.size(), level.check_points.size());
  for (std::size_t c = 0; c < told.check_points.size(); ++c) {
    EXPECT_EQ(told.check_points[c].distance_m, level.check_points[c].distance_m);
    EXPECT_EQ(told.check_points[c].within, level.check_points[c].within);
  }
  ASSERT_EQ(told.screws.size(), level.screws.size());
  for (std::size_t s = 0; s < told.screws.size(); ++s) {
    const ScrewState& is = told.screws[s];
    const ScrewState& was = level.screws[s];
    EXPECT_EQ(is.done, was.done);
    EXPECT_EQ(is.done_at, was.done_at);
    EXPECT_EQ(is.redone, was.redone);
    EXPECT_EQ(is.earlier_plans.size(), was.earlier_plans.size());
    EXPECT_EQ(told.plan.screws[s].target, level.plan.screws[s].target);
    ASSERT_EQ(is.at_depth.has_value(), was.at_depth.has_value());
    if (is.at_depth) {
      EXPECT_EQ(is.at_depth->angle_rad, was.at_depth->angle_rad);
      EXPECT_EQ(is.at_depth->tip_to_entry_m, was.at_depth->tip_to_entry_m);
      EXPECT_EQ(is.at_depth->tip_off_axis_m, was.at_depth->tip_off_axis_m);
      EXPECT_EQ(is.at_depth->depth_m, was.at_depth->depth_m);
    }
    ASSERT_EQ(is.executed.has_value(), was.executed.has_value());
    if (is.executed) {
      EXPECT_EQ(is.executed->axis.point, was.executed->axis.point);
      EXPECT_EQ(is.executed->point_covariance_m2, was.executed->point_covariance_m2);
    }
    ASSERT_EQ(is.clearance_at_depth.has_value(), was.clearance_at_depth.has_value());
    if (is.clearance_at_depth) {
      EXPECT_EQ(is.clearance_at_depth->least.clearance_m,
                was.clearance_at_depth->least.clearance_m);
      EXPECT_EQ(is.clearance_at_depth->spread.has_value(),
                was.clearance_at_depth->spread.has_value());
    }
    if (was.done) {
      EXPECT_EQ(is.wire.asked, was.wire.asked);
      ASSERT_EQ(is.wire.measured.has_value(), was.wire.measured.has_value());
    }
  }
}

void expect_the_same(const RodState& told, const RodState& rod) {
  EXPECT_EQ(told.side, rod.side);
  EXPECT_EQ(told.done, rod.done);
  EXPECT_EQ(told.heads, rod.heads);
  ASSERT_EQ(told.touched.heads(), rod.touched.heads());
  for (std::size_t head = 0; head < rod.touched.heads(); ++head) {
    EXPECT_EQ(told.touched.touches_of(head), rod.touched.touches_of(head));
    EXPECT_EQ(told.touched.sd_m(head), rod.touched.sd_m(head));
  }
  if (!rod.done) {
    return;
  }
  EXPECT_EQ(told.no_instructions, rod.no_instructions);
  EXPECT_EQ(told.took_s, rod.took_s);
  ASSERT_EQ(told.rod.has_value(), rod.rod.has_value());
  if (rod.rod) {
    EXPECT_EQ(told.rod->length_m, rod.rod->length_m);
    EXPECT_EQ(told.rod->bends.size(), rod.rod->bends.size());
  }
  ASSERT_EQ(told.instructions.has_value(), rod.instructions.has_value());
  EXPECT_EQ(told.expected.has_value(), rod.expected.has_value());
  if (rod.instructions) {
    EXPECT_EQ(told.instructions->cut_length_m(), rod.instructions->cut_length_m());
    ASSERT_EQ(told.instructions->bends.size(), rod.instructions->bends.size());
    EXPECT_EQ(told.expected->within, rod.expected->within);
  }
}

/// Compares everything that reports have of a session's levels and rods.
void expect_the_same(const LoggedOperation& told, const Session& session) {
  ASSERT_EQ(told.state.levels.size(), session.levels().size());
  for (std::size_t i = 0; i < told.state.levels.size(); ++i) {
    expect_the_same(told.state.levels[i], session.levels()[i]);
  }
  for (std::size_t i = 0; i < told.state.rods.size(); ++i) {
    expect_the_same(told.state.rods[i], session.rods()[i]);
  }
}

TEST(LoggedOperation, IsTheOperationAsTheSessionHasIt) {
  Logged j({"L4", "L5"});
  j.operation.tracker().guide = test::guide_at({0.015, 0.020, 0.0}, 0.1);
  j.operation.finishes_every_screw();
  j.operation.touches({0.02, 0.03, 0.00});
  j.operation.touches({0.02, 0.03, 0.04});
  // The second head twice more, of which one touch is taken back: still two heads.
  j.operation.touches({0.0204, 0.03, 0.04});
  j.operation.touches({0.0201, 0.03, 0.04});
  j.operation.says("delete");
  j.operation.says("mumble");
  j.operation.says("done");
  j.operation.touches({-0.02, 0.03, 0.00});
  const LoggedOperation told = j.finished(false, "cable");
  EXPECT_TRUE(told.ended);
  EXPECT_FALSE(told.done);
  EXPECT_EQ(told.reason, "cable");
  expect_the_same(told, j.operation.session());
  EXPECT_EQ(told.state.rods[0].heads.size(), 2U);
  EXPECT_EQ(told.state.rods[0].touched.touches_of(1), 2U);
  EXPECT_EQ(told.registrations.size(), 2U);
  const auto& pose = told.state.levels[0].screws[0].at_depth;
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->angle_rad, 0.1, 1e-9);
  EXPECT_FALSE(told.state.levels[0].screws[0].wire.asked) << "by eye nobody is";
  std::vector<Step> course;
  for (const LoggedOperation::ReachedStep& step : told.steps) {
    course.push_back(step.step);
  }
  using enum Step;
  EXPECT_THAT(course, ::testing::ElementsAre(kDigitize, kRegistering, kVerify, kTouchLandmark,
                                             kGuide, kDigitize, kRegistering, kVerify,
                                             kTouchLandmark, kGuide, kRod));
}

/// After each act: no later fact is needed to make up for an earlier one.
TEST(LoggedOperation, IsTheOperationAsTheSessionHasItAtEveryMoment) {
  for (const test::Story story : {test::Story::kPlain, test::Story::kEventful}) {
    MemoryEnv env;
    auto s = test::touched_operation(true);
    auto log = test::log_of(*s, env, true);
    test::ScriptedSurgeon surgeon(*s, 5, story);
    while (surgeon.act()) {
      const auto told = LoggedOperation::read(env, kLogPath);
      ASSERT_TRUE(is_ok(told));
      expect_the_same(*told, s->session());
      ASSERT_FALSE(::testing::Test::HasFailure()) << name_of(s->session().current_step());
    }
  }
}

TEST(LoggedOperation, KnowsWhatWasAcceptedAfterTouching) {
  Logged j({"L4"}, Verification::kByTouch);
  std::array<double, 36> covariance{};
  for (const std::size_t k : {0U, 7U, 14U}) {
    covariance[k] = 0.25e-6;
  }
  j.operation.registration.uncertainty = nav::PoseUncertainty({}, covariance);
  j.operation.registers_first_level();
  for (const Vec3 place : {Vec3{-0.015, 0.02, -0.01}, {0.015, 0.02, -0.01}, {0.0, 0.02, 0.012}}) {
    j.operation.touches(place);
  }
  j.operation.says("accept");
  ASSERT_TRUE(j.operation.session().levels()[0].accepted);
  const LoggedOperation told = j.so_far();
  expect_the_same(told, j.operation.session());
  EXPECT_NE(told.state.levels[0].registration->uncertainty->covariance(), covariance)
      << "it holds the touches";
  EXPECT_EQ(told.registrations.at(0).result->uncertainty->covariance(), covariance);
}

TEST(LoggedOperation, KnowsEveryTouchOfTheLandmarkAndWhatItTookBack) {
  Logged j({"L4"}, Verification::kByTouch);
  j.operation.accepts_first_by_touch();
  j.operation.touches_landmark();
  j.operation.says("next");
  j.operation.says("next");
  j.operation.says("next");
  j.operation.touches_landmark(Vec3{0.0006, 0, 0});
  j.operation.says("delete");
  j.operation.touches_landmark(Vec3{0, 0, 0.0031});
  ASSERT_EQ(j.operation.pair().step, Step::kVerify);
  const LoggedOperation told = j.so_far();
  expect_the_same(told, j.operation.session());
  EXPECT_FALSE(told.state.levels[0].accepted);
  EXPECT_TRUE(told.state.levels[0].registration) << "it is judged anew";
  const std::vector<LoggedTouch>& touches = told.landmark_touches[0];
  ASSERT_EQ(touches.size(), 3U);
  EXPECT_TRUE(touches[0].touch.first);
  EXPECT_NEAR(touches[1].touch.off_m, 0.0006, 1e-9);
  EXPECT_TRUE(touches[1].touch.held() && touches[1].dropped);
  EXPECT_NEAR(touches[2].touch.off_m, 0.0031, 1e-9);
  EXPECT_FALSE(touches[2].touch.held() || touches[2].dropped);
  EXPECT_NEAR(touches[2].touch.limit_m, kMaxLandmarkOff_m, 1e-9);
}

TEST(LoggedOperation, FollowsRejectionsCheckPointsAndAMovedMap) {
  Logged j({"L4", "L5"}, Verification::kByTouch);
  j.operation.registers_first_level();
  j.operation.touches({0.0, 0.0213, 0.0});
  j.operation.touches({0.02, 0.0251, 0.0});
  j.operation.says("delete");
  expect_the_same(j.so_far(), j.operation.session());
  EXPECT_FALSE(j.so_far().ended);
  EXPECT_EQ(j.so_far().state.levels[0].check_points.size(), 1U);
  j.operation.says("reject");
  expect_the_same(j.so_far(), j.operation.session());
  EXPECT_FALSE(j.so_far().state.levels[0].registration);
  j.operation.registers_first_level();
  ++j.operation.map_epoch;
  j.operation.pairs(2);
  EXPECT_FALSE(j.so_far().state.levels[0].registration);
  expect_the_same(j.finished(false, "end"), j.operation.session());
}

TEST(LoggedOperation, KnowsWhereTheToolWentAndWhatWasNotMeasured) {
  Logged j({"L4"}, Verification::kByTouch);
  test::ScriptedOperation& s = j.operation;
  s.registers_within(0.0003);
  s.accepts_first_by_touch();
  s.touches_landmark();
  s.says("next");
  for (const double depth_m : {0.0, 0.005, 0.010, 0.010, 0.010}) {
    s.tracker().guide = test::guide_at({0.0153, 0.020 - depth_m, 0.0}, 0.01);
    s.pair();
  }
  s.says("next");
  s.says("next");
  s.tracker().guide.reset();
  s.touches_landmark();
  s.says("next");
  s.says("next");
  s.says("next");
  const LoggedOperation told = j.finished(true);
  expect_the_same(told, s.session());
  const ScrewState& left = told.state.levels.at(0).screws.at(0);
  ASSERT_TRUE(left.executed);
  EXPECT_NEAR(left.executed->depth_m, 0.010, 1e-3);
  const ScrewState& right = told.state.levels[0].screws.at(1);
  EXPECT_FALSE(right.executed || right.clearance_at_depth);
  ASSERT_TRUE(told.calibration);
  EXPECT_TRUE(told.calibration->tags.empty()) << "nothing tells of it here";
  EXPECT_FALSE(told.calibration->cameras);
}

TEST(LoggedOperation, KnowsWhatTagsAndCamerasInUseHaveTold) {
  Logged j({"L4"});
  test::ScriptedOperation& s = j.operation;
  s.tracker().size = nav::TagSize{0.004, 0.001, 40, false, false, 0.003};
  s.accepts_first_level();
  s.says("next");
  s.says("next");
  const LoggedOperation told = j.so_far();
  ASSERT_TRUE(told.calibration);
  ASSERT_EQ(told.calibration->tags.size(), 2U);
  EXPECT_EQ(told.calibration->tags[1].tool, "guide");
  EXPECT_EQ(told.calibration->tags[1].measured, 0.004);
  EXPECT_EQ(told.calibration->tags[1].sd, 0.001);
  EXPECT_EQ(told.calibration->tags[1].applied, 0.003);
  EXPECT_FALSE(told.calibration->cameras);
}

/// A click with the sleeve over the left screw's wire, so far off its plan.
void measures_wire(test::ScriptedOperation& s, double beside_m, double angle_rad) {
  using enum ClickerAction;
  s.tracker().guide = test::guide_at(Vec3{0.015 + beside_m, 0.020, 0.0}, angle_rad);
  s.does({kPress});
  s.pair();
  s.does({kRelease, kClick});
}

TEST(LoggedOperation, KnowsHowEveryWireWasMeasuredKeptOrRedone) {
  Logged j({"L4"}, Verification::kByTouch);
  test::ScriptedOperation& s = j.operation;
  s.registers_within(0.0003);
  s.accepts_first_by_touch();
  const auto drill = [&s] {
    s.touches_landmark();
    s.says("next");
    s.says("next");
  };
  drill();
  measures_wire(s, 0.0025, 0.0);
  EXPECT_FALSE(j.so_far().state.levels[0].screws[0].wire.measured->within());
  s.says("delete");
  EXPECT_FALSE(j.so_far().state.levels[0].screws[0].wire.measured) << "it is taken out";
  drill();
  measures_wire(s, 0.0, 0.3);
  s.says("accept");
  s.says("next");
  drill();
  s.says("next");
  const LoggedOperation told = j.so_far();
  const ScrewState& left = told.state.levels[0].screws[0];
  EXPECT_TRUE(left.done && left.wire.asked);
  EXPECT_EQ(left.redone, 1);
  ASSERT_TRUE(left.wire.measured);
  const PlacedWire& wire = *s.session().levels()[0].screws[0].wire.measured;
  EXPECT_EQ(left.wire.measured->axis.angle_rad.value, wire.axis.angle_rad.value);
  EXPECT_EQ(left.wire.measured->axis.entry_m.sd, wire.axis.entry_m.sd);
  EXPECT_TRUE(left.wire.measured->kept && !left.wire.measured->within());
  const ScrewState& right = told.state.levels[0].screws[1];
  EXPECT_TRUE(right.done && right.wire.asked);
  EXPECT_FALSE(right.wire.measured) << "not measured";
  EXPECT_EQ(right.redone, 0);
}

/// The log of an operation that was killed in that step of the first level and then continued to
/// another one.
LoggedOperation resumed_log(Step killed_in, Step ends_in) {
  MemoryEnv env;
  {
    auto s = test::touched_operation(true);
    auto log = test::log_of(*s, env, true);
    test::ScriptedSurgeon surgeon(*s);
    while (s->session().current_step() != killed_in && surgeon.act()) {
    }
  }
  MemoryEnv disk(env.files());
  test::ResumedOperation r(disk, true);
  EXPECT_TRUE(is_ok(r.resumed));
  test::ScriptedSurgeon surgeon(*r.operation);
  while (r.operation->session().current_step() != ends_in && surgeon.act()) {
  }
  return LoggedOperation::read(disk, kLogPath).value();
}

TEST(LoggedOperation, HasALevelAsAcceptedThatWasAcceptedBeforeItWasResumed) {
  for (const Step step : {Step::kTouchLandmark, Step::kGuide, Step::kMeasureWire}) {
    const LoggedOperation told = resumed_log(step, Step::kGuide);
    EXPECT_TRUE(told.state.levels[0].accepted) << "and not taken back";
    EXPECT_EQ(told.resumed, 1);
  }
}

TEST(LoggedOperation, ThatWasResumedTellsOfEveryRegistrationOnce) {
  for (const Step step :
       {Step::kVerify, Step::kTouchLandmark, Step::kGuide, Step::kMeasureWire, Step::kRod}) {
    const LoggedOperation told = resumed_log(step, Step::kDone);
    EXPECT_EQ(told.registrations.size(), 2u);
    for (const LevelState& level : told.state.levels) {
      EXPECT_TRUE(level.accepted && level.registration && level.finished());
    }
  }
}

// Records that no operation wrote.

Record begun() {
  return {1, 1, kOperationRecordVersion,
          R"({"case":"c","levels":["L4"],"models_hash":"","plan_hash":"","tools_hash":"",)"
          R"("method":"best","room":"","begun":"","orthonav":"0.3.0","device":"d","seed":0,)"
          R"("plan":[{"label":"L4","screws":[]}]})"};
}

struct Hostile {
  const char* name;
  OperationRecord type;
  std::string payload;
  const char* refusal;
};
void PrintTo(const Hostile& hostile, std::ostream* out) { *out << hostile.name; }

class HostileRecord : public ::testing::TestWithParam<Hostile> {};

TEST_P(HostileRecord, IsRefusedInOneLineThatNamesFileAndRecord) {
  const auto type = static_cast<std::uint16_t>(GetParam().type);
  const auto told = LoggedOperation::from(
      {begun(), {2, type, kOperationRecordVersion, GetParam().payload}}, "bad");
  ASSERT_FALSE(told.ok());
  EXPECT_THAT(told.error().message, HasSubstr(GetParam().refusal));
  EXPECT_THAT(told.error().message, Not(HasSubstr("\n")));
}

INSTANTIATE_TEST_SUITE_P(
    Every, HostileRecord,
    ::testing::Values(
        Hostile{"NoJson", OperationRecord::kEnded, "x", "bad: record 2: is not JSON"},
        Hostile{"AList", OperationRecord::kEnded, "[]", "must hold a JSON object"},
        Hostile{"BegunTwice", OperationRecord::kBegun, begun().payload, "only once"},
        Hostile{"UnknownStep", OperationRecord::kEvent, R"({"time_ns":1,"next":"fly"})",
                "next \"fly\" is unknown"},
        Hostile{"WrongType", OperationRecord::kRegistration,
                R"({"time_ns":1,"level":0,"attempt":"two","passed":false,"reason":""})",
                "attempt must be a number, is string"},
        Hostile{"Infinite", OperationRecord::kWire, R"({"time_ns":1e999})",
                "holds a number that is too large"},
        Hostile{"NoSide", OperationRecord::kHead, R"({"side":"up"})", "side is \"up\""},
        Hostile{"NoLevel", OperationRecord::kCheckPoint, R"({"level":1})", "level must be below 1"},
        Hostile{"NoScrew", OperationRecord::kScrew, R"({"level":0,"screw":0})",
                "screw must be below 0"},
        Hostile{"NoRegion", OperationRecord::kRegionDropped, R"({"level":0})",
                "has no region to be deleted"},
        Hostile{"PassedWithoutOne", OperationRecord::kRegistration,
                R"({"level":0,"attempt":1,"passed":true,"reason":""})", "registration is missing"},
        Hostile{"NoTime", OperationRecord::kEnded, R"({"time_ns":1e300,"reason":""})",
                "time_ns is not a time"}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(LoggedOperation, OfAnEarlierVersionIsRefusedByName) {
  Record earlier = begun();
  earlier.version = 1;
  EXPECT_THAT(LoggedOperation::from({earlier}, "old").error().message,
              HasSubstr("old: record 1: is of an earlier version of orthonav"));
  Record later = begun();
  later.version = kOperationRecordVersion + 1;
  EXPECT_THAT(LoggedOperation::from({later}, "new").error().message,
              HasSubstr("of a sort that this program does not know"));
  EXPECT_TRUE(is_ok(LoggedOperation::from({begun()}, "log")));
}

}  // namespace
}  // namespace orthonav::engine::logged_operation_test
