// A session of rods alone: the screws are in, and nothing is registered.
#include <gmock/gmock.h>

#include <cmath>

#include "engine/holograms/scene_builder.h"
#include "engine/session/session.h"
#include "engine/session/text/resume_wording.h"
#include "engine/session/text/wording.h"
#include "tests/support/is_ok.h"
#include "tests/support/logged_operation.h"
#include "tests/support/memory_env.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_rods_alone_test {
namespace {

using test::error_of;
using test::guide_at;
using test::is_ok;
using test::kLogFolder;
using test::log_of;
using test::MemoryEnv;
using test::ScriptedOperation;
using test::state;
using test::step_of;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using enum ClickerAction;

// Arithmetic on values of the order of 1: far below what any device resolves.
constexpr double kExact = 1e-9;

ScriptedOperation rods_alone() { return ScriptedOperation(std::vector<std::string>{}); }

/// A pointer with its tip there, turned by `angle_rad` about the patient's left-right axis.
Transform<World, Marker> pointer_leaning(Vec3 tip, double angle_rad) {
  const Mat3 rotation = rotation_from_vector({angle_rad, 0, 0});
  const Vec3 tip_in_marker = test::pointer_at({}).translation() * -1.0;
  return {rotation, tip - rotation * tip_in_marker};
}

const Guidance& touches_leaning(ScriptedOperation& s, Vec3 tip, double angle_rad) {
  s.tracker().pointer = pointer_leaning(tip, angle_rad);
  s.does({kPress});
  s.pair();
  return s.does({kRelease, kClick});
}

TEST(RodsAlone, GoFromSetupThroughBothRodsToTheEndWithThePointerAlone) {
  ScriptedOperation s = rods_alone();
  ASSERT_EQ(s.session().tracker().tools().size(), 1u);
  EXPECT_EQ(step_of(s.touches({0.02, 0.03, 0.00})), "setup") << "no head is touched before start";
  EXPECT_EQ(step_of(s.says("start")), "rod left");
  EXPECT_TRUE(state<HeadsSoFar>(s.pair())->unplanned);
  s.touches({0.02, 0.03, 0.00});
  const Guidance& g = s.touches({0.02, 0.03, 0.04});
  ASSERT_TRUE(g.rods[0].rod);
  EXPECT_NEAR(g.rods[0].rod->length_m, 0.04, 1e-6);
  EXPECT_TRUE(g.levels.empty());
  EXPECT_TRUE(s.says("move rod").rods_moved_away);
  EXPECT_EQ(step_of(s.says("done")), "rod right");
  EXPECT_EQ(step_of(s.says("done")), "done") << "a side without heads has no rod";
  EXPECT_GT(s.session().rods()[0].took_s.value_or(0), 0.0);
}

TEST(RodsAlone, TakeTheWayToTheBoneFromThePointer) {
  SessionOptions options;
  options.head_to_seat_m = 0.004;
  ScriptedOperation s({}, options);
  s.says("start");
  touches_leaning(s, {0.02, 0.03, 0.00}, 0.3);
  const Guidance& g = touches_leaning(s, {0.02, 0.03, 0.04}, 0.3);
  ASSERT_TRUE(g.rods[0].instructions) << g.rods[0].no_instructions;
  EXPECT_EQ(g.rods[0].seat_by_pointer_m, 0.004);
  EXPECT_EQ(state<HeadsSoFar>(g)->seat_by_pointer_m, 0.004);
  const auto& seats = g.rods[0].instructions->seats_m;
  EXPECT_NEAR((seats[0] - Vec3{0.02, 0.026, 0.00}).norm(), 0.0, kExact) << "square to the rod";
  EXPECT_THAT(detail_text(g.status), HasSubstr("rod 4.0 mm below the touches"));
}

TEST(RodsAlone, HaveNoInstructionsByAPointerThatLiesAlongTheRod) {
  ScriptedOperation s = rods_alone();
  s.says("start");
  touches_leaning(s, {0.02, 0.03, 0.00}, 1.1);
  const Guidance& g = touches_leaning(s, {0.02, 0.03, 0.04}, 1.1);
  ASSERT_TRUE(g.rods[0].rod) << "the spline needs no direction";
  EXPECT_FALSE(g.rods[0].instructions);
  EXPECT_FALSE(g.rods[0].seat_by_pointer_m);
  EXPECT_THAT(g.rods[0].no_instructions, HasSubstr("off the rod, at least 30° needed"));
}

TEST(RodsAlone, ShowNothingButTheRodAndItsHeads) {
  ScriptedOperation s = rods_alone();
  s.says("start");
  s.touches({0.02, 0.03, 0.00});
  const Guidance& g = s.touches({0.02, 0.03, 0.04});
  SceneBuilder builder;
  builder.update(g);
  ShownFrame frame;
  builder.write_shown(g, frame);
  ASSERT_EQ(frame.holograms.size(), 1u);
  EXPECT_EQ(frame.holograms[0].kind, HologramKind::kRod);
}

TEST(RodsAlone, AreForgottenWithTheMap) {
  ScriptedOperation s = rods_alone();
  s.says("start");
  s.touches({0.02, 0.03, 0.00});
  s.map_epoch = 1;
  EXPECT_TRUE(s.pair().rods[0].heads.empty());
  EXPECT_EQ(step_of(s.pair()), "rod left");
}

TEST(RodsAlone, GoOnAfterACrashWithTheRodThatIsNotDone) {
  MemoryEnv env;
  {
    ScriptedOperation s = rods_alone();
    const auto log = log_of(s, env);
    s.says("start");
    s.touches({0.02, 0.03, 0.00});
    s.touches({0.02, 0.03, 0.04});
    s.says("done");
    s.touches({-0.02, 0.03, 0.00});
    env = MemoryEnv(env.files());  // as the crash left it
  }
  const auto found = OperationLog::find(env, kLogFolder);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_THAT(resume_lines(*found),
              ElementsAre(HasSubstr("case 'boxes', rods alone, begun"),
                          "done: the left rod, 2 heads", "lost: of the right rod 1 head"));
  LoggedOperation logged = found->operation;
  logged.reopen();
  ScriptedOperation again = rods_alone();
  EXPECT_TRUE(is_ok(check_same(logged.identity, test::identity_of(again), "operation.resume")));
  ASSERT_TRUE(is_ok(again.session().resume(logged)));
  EXPECT_EQ(step_of(again.pair()), "setup");
  EXPECT_EQ(step_of(again.says("start")), "rod right");
  EXPECT_TRUE(again.pair().rods[1].heads.empty()) << "touched again";
  EXPECT_EQ(step_of(again.says("done")), "done");

  ScriptedOperation with_levels({"L4", "L5"});
  EXPECT_EQ(
      error_of(check_same(logged.identity, test::identity_of(with_levels), "operation.resume")),
      "operation.resume: is of rods alone, not of levels L4, L5");
}

TEST(RodsAlone, EndAtOnceIfBothWereDoneBeforeTheCrash) {
  LoggedOperation logged;
  logged.state.rods[0].done = logged.state.rods[1].done = true;
  ScriptedOperation s = rods_alone();
  ASSERT_TRUE(is_ok(s.session().resume(logged)));
  EXPECT_EQ(step_of(s.says("start")), "done");
}

TEST(RodsAlone, AreAskedForByTheOperation) {
  const auto refusal = [](bool rods_alone, const std::vector<std::string>& labels) {
    Operation operation = test::operation_of(labels);
    operation.rods_alone = rods_alone;
    const auto problems = operation.check();
    return problems.empty() ? "" : problems.front();
  };
  EXPECT_EQ(refusal(true, {}), "");
  EXPECT_EQ(refusal(false, {"L4"}), "");
  EXPECT_EQ(refusal(false, {}),
            "operation: no level, at least 1 needed, unless it is of rods alone");
  EXPECT_EQ(refusal(true, {"L4"}), "operation: of rods alone, but has 1 level");
}

}  // namespace
}  // namespace orthonav::engine::session_rods_alone_test
