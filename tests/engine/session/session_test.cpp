#include "engine/session/session.h"

#include <gmock/gmock.h>

#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_test {
namespace {

using test::guide_at;
using test::notice_of;
using test::pointer_at;
using test::said;
using test::ScriptedOperation;
using test::state;
using test::step_of;
using enum ClickerAction;
using ::testing::HasSubstr;

constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};

TEST(Session, BeginsWithTheFirstLevelWhenTold) {
  ScriptedOperation s;
  EXPECT_EQ(step_of(s.pair()), "setup");
  EXPECT_EQ(step_of(s.says("start")), "digitize L4");
}

TEST(Session, RefusesWhatHasNoMeaningAndSaysSo) {
  ScriptedOperation s;
  const Guidance& g = s.says("accept");
  EXPECT_EQ(g.step, Step::kSetup);
  ASSERT_NE(said<NotPossibleNow>(g), nullptr);
  EXPECT_EQ(said<NotPossibleNow>(g)->event, Event::kSayAccept);
}

TEST(Session, DoesNotActOnWhatItHardlyUnderstood) {
  ScriptedOperation s;
  const Guidance& g = s.says("start", 0.49);
  EXPECT_EQ(g.step, Step::kSetup);
  EXPECT_EQ(notice_of(g), Notice::kNotUnderstood);
  EXPECT_EQ(s.says("start", 0.5).step, Step::kDigitize);
}

TEST(Session, ShowsForAWhileWhatItHeard) {
  ScriptedOperation s;
  const HeardCommand* heard = s.says("start").status.heard;
  ASSERT_NE(heard, nullptr);
  EXPECT_EQ(heard->phrase, "start");
  EXPECT_TRUE(heard->sure);
  s.says("delete", 0.4);
  heard = s.pairs(50).status.heard;
  ASSERT_NE(heard, nullptr);
  EXPECT_EQ(heard->phrase, "delete");
  EXPECT_FALSE(heard->sure);
  EXPECT_EQ(s.pairs(15).status.heard, nullptr) << "two seconds later";
  EXPECT_EQ(s.says("no command").status.heard, nullptr);
}

TEST(Session, SamplesWhileTheButtonIsDownAndNotAfter) {
  ScriptedOperation s;
  s.tracker().pointer = pointer_at({0, 0.02, 0});
  s.says("start");
  s.strokes(5);
  const Guidance& g = s.pairs(3);
  ASSERT_EQ(g.regions.size(), 1u);
  EXPECT_EQ(g.regions[0].samples.size(), 5u);
  EXPECT_FALSE(g.regions[0].saved);
  ASSERT_NE(state<StrokesSoFar>(g), nullptr);
  EXPECT_EQ(state<StrokesSoFar>(g)->points, 5u);
}

TEST(Session, DoesNotSampleAToolThatIsNotMeasured) {
  ScriptedOperation s;
  s.says("start");
  s.strokes(5);
  std::size_t samples = 0;
  for (const nav::Region& region : s.pair().regions) {
    samples += region.samples.size();
  }
  EXPECT_EQ(samples, 0u);
}

TEST(Session, RegistersWhatWasSavedAndOnlyThat) {
  ScriptedOperation s;
  s.tracker().pointer = pointer_at({0, 0.02, 0});
  s.says("start");
  s.strokes(5);
  s.says("save");
  s.strokes(4);  // never saved
  s.does({kDoubleClick});
  EXPECT_THAT(s.registered_points, ::testing::ElementsAre(5u));
}

TEST(Session, StaysInDigitizeWithTheReasonWhenTheNumbersRefuse) {
  ScriptedOperation s;
  s.registration.accepted = false;
  s.registration.reasons = {{nav::RefusalReason::Kind::kNoise, 0.0034, 0.003, {}, {}}};
  s.tracker().pointer = pointer_at({0, 0.02, 0});
  s.says("start");
  s.strokes(5);
  s.says("save");
  const Guidance& g = s.does({kDoubleClick});
  EXPECT_EQ(g.step, Step::kDigitize);
  ASSERT_NE(said<RegistrationRefused>(g), nullptr);
  ASSERT_EQ(said<RegistrationRefused>(g)->reasons.size(), 1u);
  EXPECT_EQ(said<RegistrationRefused>(g)->reasons[0].kind, nav::RefusalReason::Kind::kNoise);
  EXPECT_EQ(g.levels[0].attempts, 1);
  EXPECT_FALSE(g.levels[0].registration.has_value());
  // The saved regions stay: more strokes may make it pass.
  EXPECT_EQ(g.regions.size(), 1u);
}

TEST(Session, SaysWhyARegistrationWasUnusable) {
  ScriptedOperation s;
  s.unusable = "0 points, at least 100 needed";
  s.says("start");
  const Guidance& g = s.does({kDoubleClick});
  EXPECT_EQ(g.step, Step::kDigitize);
  ASSERT_NE(said<RegistrationRefused>(g), nullptr);
  ASSERT_TRUE(said<RegistrationRefused>(g)->error.has_value());
  EXPECT_EQ(said<RegistrationRefused>(g)->error->message, s.unusable);
  EXPECT_EQ(g.levels[0].attempts, 1);
}

TEST(Session, GuidesOnlyAfterTheSurgeonsWord) {
  ScriptedOperation s;
  s.tracker().pointer = pointer_at({0, 0.02, 0});
  s.tracker().guide = guide_at(kLeftEntry, 0.0);
  s.says("start");
  s.strokes(5);
  s.says("save");
  EXPECT_EQ(step_of(s.does({kDoubleClick})), "verify L4");
  EXPECT_FALSE(s.pair().levels[0].accepted);
  EXPECT_EQ(s.says("next").step, Step::kVerify);
  EXPECT_EQ(step_of(s.says("accept")), "landmark L4");
  EXPECT_TRUE(s.pair().levels[0].accepted);
  EXPECT_FALSE(s.pair().tool.has_value());
  EXPECT_EQ(step_of(s.says("next")), "guide L4 left");
  EXPECT_TRUE(s.pair().tool.has_value());
}

TEST(Session, RejectClearsTheLevelInVerifyAcceptedAndGuide) {
  for (const int words : {0, 1, 2}) {
    ScriptedOperation s;
    s.tracker().pointer = pointer_at({0, 0.02, 0});
    s.says("start");
    s.strokes(5);
    s.says("save");
    s.does({kDoubleClick});
    if (words > 0) {
      s.accepts();
    }
    if (words > 1) {
      s.says("next");
    }
    const Guidance& g = s.says("reject");
    EXPECT_EQ(step_of(g), "digitize L4") << words;
    EXPECT_FALSE(g.levels[0].registration.has_value()) << words;
    EXPECT_FALSE(g.levels[0].accepted) << words;
    EXPECT_TRUE(g.regions.empty()) << words;
    EXPECT_FALSE(g.tool.has_value()) << words;
  }
}

TEST(Session, GoesThroughEveryScrewLevelAndRodToTheEnd) {
  ScriptedOperation s;
  s.accepts_first_level();
  EXPECT_EQ(step_of(s.says("next")), "guide L4 left");
  EXPECT_EQ(step_of(s.says("next")), "guide L4 right");
  EXPECT_EQ(step_of(s.says("next")), "digitize L5");
  s.strokes(5);
  s.says("save");
  EXPECT_EQ(step_of(s.does({kDoubleClick})), "verify L5");
  s.accepts();
  EXPECT_EQ(step_of(s.says("next")), "guide L5 left");
  EXPECT_EQ(step_of(s.says("next")), "guide L5 right");
  EXPECT_EQ(step_of(s.says("next")), "rod left");
  EXPECT_EQ(step_of(s.says("done")), "rod right");
  EXPECT_EQ(step_of(s.says("done")), "done");
  for (const LevelState& level : s.session().levels()) {
    EXPECT_TRUE(level.accepted) << level.plan.label << ": stays registered";
    EXPECT_TRUE(level.finished());
  }
}

TEST(SessionOptions, NamesEveryProblem) {
  SessionOptions bad;
  bad.stale_after = Duration::zero();
  bad.rod_diameter_m = 0.1;
  EXPECT_EQ(bad.check().size(), 2u);
  EXPECT_TRUE(SessionOptions{}.check().empty());
}

TEST(Session, RefusesAnOperationWithoutScrewsOrWithDoubleLabels) {
  Operation operation = test::operation_of({"L4", "L4"});
  operation.levels[0].screws.clear();
  const auto made =
      Session::create(std::move(operation), std::make_unique<test::ScriptedTracker>(), Method{});
  ASSERT_FALSE(made.ok());
  EXPECT_THAT(made.error().message, HasSubstr("no screw"));
  EXPECT_THAT(made.error().message, HasSubstr("named twice"));
}

}  // namespace
}  // namespace orthonav::engine::session_test
