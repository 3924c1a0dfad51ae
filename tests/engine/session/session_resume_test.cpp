#include <gmock/gmock.h>

#include <algorithm>
#include <cerrno>

#include "engine/holograms/scene_builder.h"
#include "engine/session/session.h"
#include "engine/session/text/resume_wording.h"
#include "engine/session/text/wording.h"
#include "tests/support/is_ok.h"
#include "tests/support/resumed_operation.h"
#include "tests/support/said.h"
#include "tests/support/scripted_surgeon.h"

namespace orthonav::engine::session_resume_test {
namespace {

using test::error_of;
using test::is_ok;
using test::kLogFolder;
using test::log_of;
using test::MemoryEnv;
using test::notice_of;
using test::ResumedOperation;
using test::ScriptedOperation;
using test::ScriptedSurgeon;
using test::step_of;
using test::touched_operation;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr Vec3 kOnBone{0, 0.02, 0};

/// An operation that was killed once the surgeon had reached that step.
std::unique_ptr<MemoryEnv> killed_in(Step step, bool reference) {
  MemoryEnv env;
  auto s = touched_operation(reference);
  auto log = log_of(*s, env, reference);
  ScriptedSurgeon surgeon(*s);
  while (s->session().current_step() != step && surgeon.act()) {
  }
  return std::make_unique<MemoryEnv>(env.files());
}

/// What a wearer sees of the patient.
std::size_t shown(const Guidance& guidance) {
  SceneBuilder builder;
  builder.update(guidance);
  ShownFrame frame;
  builder.write_shown(guidance, frame);
  return frame.holograms.size();
}

TEST(ResumedSession, ShowsNothingOnThePatientBeforeItsLandmarkIsFound) {
  auto env = killed_in(Step::kGuide, true);
  ResumedOperation r(*env, true);
  ScriptedOperation& s = *r.operation;
  EXPECT_EQ(shown(s.pair()), 0u) << "in setup";
  s.says("start");
  EXPECT_EQ(shown(s.pair()), 0u) << "in landmark";
  s.touches_landmark();
  s.tracker().guide = test::guide_at({0.015, 0.020, 0.0}, 0.0);
  s.says("next");
  EXPECT_GT(shown(s.pair()), 0u) << "the control";
}

TEST(ResumedSession, GuidesNothingBeforeItsLandmarkIsFound) {
  auto env = killed_in(Step::kGuide, true);
  ResumedOperation r(*env, true);
  ASSERT_TRUE(is_ok(r.resumed));
  ScriptedOperation& s = *r.operation;
  EXPECT_EQ(step_of(s.pair()), "setup");
  EXPECT_EQ(step_of(s.says("start")), "landmark L4") << "where it stood, or as near as can be";
  const LevelState& level = s.session().levels()[0];
  EXPECT_TRUE(level.unverified && level.accepted && level.registration);
  EXPECT_FALSE(level.usable());
  EXPECT_EQ(notice_of(s.says("next")), Notice::kLandmarkMissing);
  EXPECT_EQ(s.session().current_step(), Step::kTouchLandmark);
  s.touches_landmark();
  EXPECT_TRUE(level.usable()) << "found where it was";
  EXPECT_EQ(step_of(s.says("next")), "guide L4 left");
}

TEST(ResumedSession, IsVerifiedOnceMoreWhereItsLandmarkMoved) {
  auto env = killed_in(Step::kGuide, true);
  ResumedOperation r(*env, true);
  ScriptedOperation& s = *r.operation;
  s.pair();
  s.says("start");
  const Guidance& moved = s.touches_landmark({0.004, 0, 0});
  EXPECT_EQ(step_of(moved), "verify L4");
  EXPECT_EQ(notice_of(moved), Notice::kLandmarkMoved);
  const LevelState& level = s.session().levels()[0];
  EXPECT_FALSE(level.usable());
  s.accepts();
  EXPECT_EQ(s.session().current_step(), Step::kVerify) << "not before places were touched";
  s.checks_by_touch();
  s.accepts();
  EXPECT_EQ(s.session().current_step(), Step::kTouchLandmark);
  EXPECT_TRUE(level.usable());
}

TEST(ResumedSession, WithoutALandmarkCheckPointsVerify) {
  auto env = killed_in(Step::kVerify, true);
  ResumedOperation r(*env, true);
  ScriptedOperation& s = *r.operation;
  s.pair();
  EXPECT_EQ(step_of(s.says("start")), "verify L4");
  const LevelState& level = s.session().levels()[0];
  EXPECT_TRUE(level.unverified);
  EXPECT_TRUE(level.check_points.empty()) << "touched again";
  s.accepts();
  EXPECT_EQ(s.session().current_step(), Step::kVerify);
  s.checks_by_touch();
  s.accepts();
  EXPECT_EQ(step_of(s.pair()), "landmark L4");
  EXPECT_TRUE(level.usable());
}

TEST(ResumedSession, InheritsNoPlaceOfTheHeadsetsMap) {
  for (const Step step : {Step::kVerify, Step::kTouchLandmark, Step::kGuide, Step::kMeasureWire}) {
    auto env = killed_in(step, false);
    ResumedOperation r(*env, false);
    ASSERT_TRUE(is_ok(r.resumed));
    ScriptedOperation& s = *r.operation;
    s.pair();
    EXPECT_EQ(step_of(s.says("start")), "digitize L4");
    const LevelState& level = s.session().levels()[0];
    EXPECT_FALSE(level.registration);
    EXPECT_FALSE(level.landmark);
    EXPECT_TRUE(s.pair().regions.empty());
    EXPECT_EQ(level.attempts, 1);
  }
}

TEST(ResumedSession, GoesOnWithTheStrokesThatHangOnAReference) {
  MemoryEnv env;
  {
    auto s = touched_operation(true);
    auto log = log_of(*s, env, true);
    ScriptedSurgeon surgeon(*s);
    surgeon.act();
    surgeon.act();
    s->strokes(3);
  }
  ResumedOperation r(env, true);
  ScriptedOperation& s = *r.operation;
  s.pair();
  s.says("start");
  ASSERT_EQ(s.pair().regions.size(), 1u) << "what was saved; three more samples were not";
  EXPECT_EQ(s.pair().regions[0].samples.size(), 5u);
  constexpr double kRounding_m = 1e-12;
  EXPECT_LT((s.pair().regions[0].samples[0].tip_in_world.v - kOnBone).norm(), kRounding_m);
  ScriptedSurgeon(s).finish();
  EXPECT_EQ(s.registered_points[0], 10u);
}

/// Refuses the first two registrations.
void refuses_all_but_the_new(ScriptedOperation& s) {
  s.before_registering = [&s, asked = 0]() mutable { s.registration.accepted = ++asked > 2; };
}

TEST(ResumedSession, GoesOnWithStrokesThatCountAloneAfterARefusal) {
  MemoryEnv env;
  {
    auto s = touched_operation(true);
    auto log = log_of(*s, env, true);
    refuses_all_but_the_new(*s);
    s->registers_first_level();
    EXPECT_EQ(s->session().current_step(), Step::kDigitize);
    s->strokes(7);
    s->says("save");
    s->does({ClickerAction::kDoubleClick});
    EXPECT_EQ(s->session().current_step(), Step::kVerify);
    EXPECT_THAT(s->registered_points, ::testing::ElementsAre(5u, 12u, 7u));
    EXPECT_EQ(s->session().levels()[0].newest->points.size(), 7u);
  }
  ResumedOperation r(env, true);
  ScriptedOperation& s = *r.operation;
  s.pair();
  EXPECT_EQ(step_of(s.says("start")), "verify L4");
  ASSERT_TRUE(s.session().levels()[0].newest);
  EXPECT_EQ(s.session().levels()[0].newest->points.size(), 7u);
}

TEST(StrokesAfterARefusal, CountAloneOnlyWhereTheSurgeonTouches) {
  ScriptedOperation s({"L4"}, {}, Verification::kByEye);
  refuses_all_but_the_new(s);
  s.registers_first_level();
  s.strokes(7);
  s.says("save");
  s.does({ClickerAction::kDoubleClick});
  EXPECT_EQ(s.session().current_step(), Step::kDigitize);
  EXPECT_THAT(s.registered_points, ::testing::ElementsAre(5u, 12u));
}

TEST(ResumedSession, DoubtsARegistrationThatWasMadeOfOtherPoints) {
  auto env = killed_in(Step::kTouchLandmark, true);
  std::vector<Record> records = read_log(*env, test::kLogPath)->records;
  const auto region = std::ranges::find(
      records, static_cast<std::uint16_t>(OperationRecord::kRegion), &Record::type);
  ASSERT_NE(region, records.end());
  records.erase(region);
  const LoggedOperation logged = LoggedOperation::from(records, "log").value();
  auto s = touched_operation(true);
  s->tracker().reference.places = logged.references;
  ASSERT_TRUE(is_ok(s->session().resume(logged)));
  s->pair();
  EXPECT_EQ(step_of(s->says("start")), "digitize L4");
  EXPECT_FALSE(s->session().levels()[0].registration);
}

TEST(ResumedSession, ForgetsWhatHungOnReferencesThatMovedMeanwhile) {
  auto env = killed_in(Step::kGuide, true);
  ResumedOperation r(*env, true);
  ScriptedOperation& s = *r.operation;
  s.pair();
  s.tracker().reference.moves = 1;
  s.pair();
  EXPECT_FALSE(s.session().levels()[0].registration) << "before \"start\" was said";
  EXPECT_EQ(step_of(s.says("start")), "digitize L4");
}

TEST(ResumedSession, GoesOnUnsavedWhereTheDiskTakesNothingMore) {
  auto left = killed_in(Step::kGuide, true);
  test::Files torn = left->files();
  torn[test::kLogPath] += "torn";
  for (const int problem : {ENOSPC, EIO, EROFS}) {
    for (std::size_t call = 0; call < 8; ++call) {
      MemoryEnv env(torn);
      env.fail_at(call, problem, true);
      ResumedOperation r(env, true);
      ASSERT_TRUE(is_ok(r.resumed));
      EXPECT_FALSE(r.log->written().ok());
      ScriptedSurgeon surgeon(*r.operation);
      EXPECT_THAT(detail_text(r.operation->pair().status), ::testing::EndsWith("NOT SAVED"));
      surgeon.finish();
      EXPECT_EQ(r.operation->session().current_step(), Step::kDone);
      MemoryEnv after(env.files());
      EXPECT_GE(read_log(after, test::kLogPath)->records.size(),
                read_log(*left, test::kLogPath)->records.size())
          << "what was saved before still is";
    }
  }
  RecordProperty("faults", 3 * 8);
}

TEST(ResumedSession, IsRefusedWhereReferencesLieElsewhereAndOnceItBegan) {
  auto env = killed_in(Step::kGuide, true);
  LoggedOperation logged = OperationLog::find(*env, kLogFolder)->operation;
  auto elsewhere = touched_operation(true);
  elsewhere->tracker().reference.places[0].anchored_from_marker =
      Transform<World, Marker>(Mat3::identity(), {0, 0, 0.101});
  EXPECT_EQ(error_of(elsewhere->session().resume(logged)),
            "the patient references are not placed as the log has them");
  auto begun = touched_operation(true);
  begun->pair();
  EXPECT_EQ(error_of(begun->session().resume(logged)),
            "an operation is resumed before its first step");
}

TEST(ResumedSession, OfAnotherPatientIsRefusedInOneLine) {
  auto s = touched_operation(true);
  const OperationIdentity same = test::identity_of(*s, true);
  EXPECT_TRUE(is_ok(check_same(same, same, "operation.resume")));
  const auto refusal = [&](auto change) {
    OperationIdentity other = same;
    change(other);
    const Status status = check_same(same, other, "operation.resume");
    EXPECT_FALSE(status.ok());
    EXPECT_THAT(error_of(status), Not(HasSubstr("\n")));
    return error_of(status);
  };
  EXPECT_EQ(refusal([](auto& other) { other.case_name = "Miller"; }),
            "operation.resume: is of case 'boxes', not of 'Miller'");
  EXPECT_THAT(refusal([](auto& other) { other.models_hash = "00"; }),
              HasSubstr("is of another patient: the models of case 'boxes' were"));
  EXPECT_THAT(refusal([](auto& other) { other.plan_hash = "00"; }), HasSubstr("has another plan"));
  EXPECT_THAT(refusal([](auto& other) { other.tools_hash = "00"; }), HasSubstr("other tools"));
  EXPECT_THAT(refusal([](auto& other) { other.method = "paper"; }),
              HasSubstr("was begun with method 'scripted', not 'paper'"));
  EXPECT_THAT(refusal([](auto& other) { other.patient_reference = false; }),
              HasSubstr("was begun with a patient reference, not without"));
  EXPECT_EQ(refusal([](auto& other) { other.levels = {"L4"}; }),
            "operation.resume: is of levels L4, L5, not of levels L4");
  EXPECT_EQ(refusal([](auto& other) { other.levels = {}; }),
            "operation.resume: is of levels L4, L5, not of rods alone");
  EXPECT_THAT(refusal([](auto& other) { other.room = "seed 2"; }), HasSubstr("simulated patient"));
}

TEST(ResumedSession, HashesTellOneVertexAndOneScrewApart) {
  auto s = touched_operation(false);
  const auto tools = s->session().tracker().tools();
  std::vector<LevelState> levels(s->session().levels().begin(), s->session().levels().end());
  const OperationIdentity before = identity_of("boxes", levels, tools, "scripted", false);
  levels[1].screws[0].preoperative.target.v.x += 1e-9;
  EXPECT_NE(identity_of("boxes", levels, tools, "scripted", false).plan_hash, before.plan_hash);
  nav::TriangleMesh mesh = levels[1].plan.model->mesh();
  mesh.vertices_m[0].z += 1e-6;
  levels[1].plan.model = nav::VertebraModel::prepare(mesh).value();
  EXPECT_NE(identity_of("boxes", levels, tools, "scripted", false).models_hash, before.models_hash);
}

TEST(ResumeLines, SayWhatItWasAndWhatIsLost) {
  auto on_map = killed_in(Step::kMeasureWire, false);
  const auto lost = resume_lines(OperationLog::find(*on_map, kLogFolder).value());
  EXPECT_THAT(lost[0],
              HasSubstr("resuming out/operation.resume: case 'boxes', levels L4, L5, begun"));
  EXPECT_EQ(lost[1], "placed: no screw");
  EXPECT_EQ(lost[2],
            "lost: of L4 2 regions, its accepted registration, its landmark, 3 check points");
  auto anchored = killed_in(Step::kRod, true);
  const auto rods = resume_lines(OperationLog::find(*anchored, kLogFolder).value());
  EXPECT_EQ(rods[1], "placed: L4 left, L4 right, L5 left, L5 right");
  auto guided = killed_in(Step::kGuide, true);
  EXPECT_THAT(resume_lines(OperationLog::find(*guided, kLogFolder).value()),
              Contains("L4: accepted before, not verified: touch its landmark"));
}

}  // namespace
}  // namespace orthonav::engine::session_resume_test
