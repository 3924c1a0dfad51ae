#include <gmock/gmock.h>

#include <atomic>

#include "engine/session/text/wording.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"
#include "tests/support/wait_until.h"

namespace orthonav::engine::session_registering_test {
namespace {

using test::pointer_at;
using test::said;
using test::ScriptedOperation;
using test::wait_until;
using enum ClickerAction;

/// Registrations wait until they are let through.
class SlowRegistration : public ::testing::Test, public SessionObserver {
 protected:
  SlowRegistration() {
    s.time_runs = true;
    s.before_registering = [this] {
      const int mine = ++begun;
      EXPECT_TRUE(wait_until([&] { return let_through >= mine; }));
    };
    s.session().observe(this);
    s.tracker().pointer = pointer_at({0, 0.02, 0});
  }
  ~SlowRegistration() override { let_through = 1000; }

  const Guidance& asks_for_registration() {
    s.strokes(120);
    s.says("save");
    return s.does({kPress, kRelease, kClick, kPress, kRelease, kClick, kDoubleClick});
  }
  Step step_after_answer() {
    EXPECT_TRUE(wait_until([&] { return s.pair().step != Step::kRegistering; }));
    return s.session().current_step();
  }

  void happened(Timestamp time, Step /*from*/, Event /*event*/, Cell /*answer*/) override {
    EXPECT_GE(time, newest) << "a log goes on in time";
    newest = time;
  }
  void registered(Timestamp, const LevelState&, const RegistrationOutcome&) override { ++answers; }

  std::atomic<int> begun = 0;
  std::atomic<int> let_through = 0;
  int answers = 0;
  Timestamp newest = Timestamp::min();
  ScriptedOperation s{{"L4", "L5"}};  ///< destroyed first
};

TEST_F(SlowRegistration, HoldsUpNoPair) {
  s.says("start");
  const Guidance& asked = asks_for_registration();
  EXPECT_EQ(asked.step, Step::kRegistering);
  EXPECT_EQ(step_text(asked.status.at), "registering L4");
  ASSERT_TRUE(wait_until([&] { return begun == 1; }));
  for (int i = 0; i < 300; ++i) {  // would hang here if one waited
    s.tracker().pointer = pointer_at({0.001 * i, 0.02, 0});
    ASSERT_EQ(s.pair().step, Step::kRegistering);
  }
  const auto& pointer = s.session().tool_states()[0].world_from_marker;
  EXPECT_EQ(pointer.status, PoseStatus::kMeasured);
  EXPECT_EQ(pointer.time, s.now()) << "tracking went on";
  EXPECT_EQ(answers, 0) << "an operation killed now goes on with its strokes";
  EXPECT_EQ(s.session().levels()[0].attempts, 0);

  let_through = 1;
  EXPECT_EQ(step_after_answer(), Step::kVerify);
  EXPECT_EQ(answers, 1);
  const LevelState& level = s.session().levels()[0];
  EXPECT_EQ(level.attempts, 1);
  EXPECT_TRUE(level.registration.has_value());
  EXPECT_EQ(s.registered_points, std::vector<std::size_t>{120});
  // The time until it was asked for, which the computation does not lengthen.
  EXPECT_LT(level.digitization_s, 5.0);
}

TEST_F(SlowRegistration, RefusesWhatIsSaidMeanwhile) {
  s.says("start");
  asks_for_registration();
  for (const char* phrase : {"accept", "delete", "save", "next", "reject", "done", "start"}) {
    const Guidance& g = s.says(phrase);
    EXPECT_EQ(g.step, Step::kRegistering) << phrase;
    EXPECT_NE(said<NotPossibleNow>(g), nullptr) << phrase;
  }
  EXPECT_EQ(s.strokes(30).step, Step::kRegistering);
  let_through = 1;
  EXPECT_EQ(step_after_answer(), Step::kVerify);
  EXPECT_EQ(s.registered_points, std::vector<std::size_t>{120}) << "as they were when asked";
}

TEST_F(SlowRegistration, ThatIsRefusedSaysWhyAndGoesOnWithTheStrokes) {
  s.unusable = "99 points, needs at least 100";
  s.says("start");
  asks_for_registration();
  let_through = 1;
  EXPECT_EQ(step_after_answer(), Step::kDigitize);
  EXPECT_NE(said<RegistrationRefused>(s.pair()), nullptr);
  s.unusable.reset();
  s.does({kDoubleClick});
  let_through = 2;
  EXPECT_EQ(step_after_answer(), Step::kVerify);
  EXPECT_EQ(s.registered_points, (std::vector<std::size_t>{120, 120}));
}

TEST_F(SlowRegistration, OfAMapThatMovedIsForgottenAndTheNextOneCountsAlone) {
  s.says("start");
  asks_for_registration();
  ASSERT_TRUE(wait_until([&] { return begun == 1; }));
  ++s.map_epoch;
  EXPECT_EQ(s.pair().step, Step::kDigitize);
  s.strokes(80);
  s.says("save");
  EXPECT_EQ(s.does({kDoubleClick}).step, Step::kRegistering) << "though the first is still at work";
  s.pairs(50);
  EXPECT_EQ(begun, 1) << "one after the other";
  let_through = 1;
  ASSERT_TRUE(wait_until([&] {
    EXPECT_EQ(s.pair().step, Step::kRegistering);
    return begun == 2;
  }));
  EXPECT_EQ(answers, 0);
  let_through = 2;
  EXPECT_EQ(step_after_answer(), Step::kVerify);
  EXPECT_EQ(answers, 1);
  EXPECT_EQ(s.session().levels()[0].registration->points, s.registration.points);
  EXPECT_EQ(s.registered_points, (std::vector<std::size_t>{120, 80}));
}

TEST_F(SlowRegistration, IsAnsweredAtOnceWherePairsMakeTheTime) {
  s.time_runs = false;
  let_through = 1;
  s.says("start");
  EXPECT_EQ(asks_for_registration().step, Step::kVerify);
  EXPECT_EQ(answers, 1);
}

}  // namespace
}  // namespace orthonav::engine::session_registering_test
