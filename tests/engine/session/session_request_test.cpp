// What other programs ask: docs/igtl.md.
#include <gmock/gmock.h>

#include "engine/session/session.h"
#include "engine/session/text/wording.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_request_test {
namespace {

using test::guide_at;
using test::said;
using test::ScriptedOperation;
using Kind = ReplanRefusal::Kind;
using ::testing::HasSubstr;

constexpr const char* kClient = "10.0.0.7";
constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};
constexpr Vec3 kLeftTarget{0.015, -0.015, 0.0};
constexpr double kRadius_m = 0.003;

/// Records what is reported about requests.
class Listener : public SessionObserver {
 public:
  std::vector<std::string> heard;
  void asked_from_outside(const Request& request) override {
    heard.push_back("asked " + request.from + ": " + request.text);
  }
  void happened(Timestamp, Step, Event event, Cell) override {
    if (event == Event::kSayStart || event == Event::kSayAccept || event == Event::kSayReplan) {
      heard.emplace_back(name_of(event));
    }
  }
  void request_answered(const Request& request, bool taken, const Message* why_not) override {
    EXPECT_FALSE(taken && why_not != nullptr);
    std::string why = "no command";
    if (why_not != nullptr) {
      why.clear();
      append(why, *why_not);
    }
    answer = request.text + ": " + (taken ? "taken" : why);
  }
  std::string answer;  ///< the last one
  void not_understood(const Phrase& phrase) override {
    heard.push_back("not understood " + phrase.text);
  }
  void replanned(Timestamp, const LevelState&, const Replan&, const ScrewReplanned&) override {
    heard.emplace_back("replanned");
  }
};

Request command(const std::string& text) { return {text, kClient, {}, {}}; }

Request plan(Vec3 entry, Vec3 target, double radius_m = kRadius_m, const std::string& level = "L4",
             nav::Side side = nav::Side::kLeft) {
  return {"plan " + level, kClient, {}, PlaceScrew{level, side, {entry}, {target}, radius_m}};
}

struct Requests4 : ScriptedOperation {
  explicit Requests4(Verification verification = Verification::kByEye)
      : ScriptedOperation({"L4", "L5"}, test::three_places(), verification) {
    session().observe(&listener);
  }
  /// What is answered to a command.
  const std::string& answer_to(const std::string& text) {
    asks(command(text));
    return listener.answer;
  }
  Listener listener;
};

TEST(RequestedCommand, IsTakenAsIfItWereSaidAndTellsWhoAsks) {
  Requests4 s;
  const Guidance& g = s.asks(command("start"));
  EXPECT_EQ(s.session().current_step(), Step::kDigitize);
  EXPECT_THAT(s.listener.heard, ::testing::ElementsAre("asked 10.0.0.7: start", "\"start\""));
  std::string status;
  append_status(status, g.status);
  EXPECT_THAT(status, HasSubstr("10.0.0.7 asks: start"));
}

TEST(RequestedCommand, ThatIsNoneChangesNothing) {
  Requests4 s;
  s.asks(command("begin"));
  EXPECT_EQ(s.session().current_step(), Step::kSetup);
  EXPECT_THAT(s.listener.heard,
              ::testing::ElementsAre("asked 10.0.0.7: begin", "not understood begin"));
}

TEST(RequestedCommand, AcceptsNothingBeforeItWasShown) {
  Requests4 s;
  s.registers_first_level();
  // It arrives with the pair that first shows the registration.
  s.asks(command("accept"));
  EXPECT_EQ(s.session().current_step(), Step::kVerify);
  s.asks(command("accept"));
  EXPECT_EQ(s.session().current_step(), Step::kTouchLandmark);
}

TEST(RequestedCommand, IsAnsweredByWhatBecameOfIt) {
  Requests4 s;
  EXPECT_EQ(s.answer_to("next"), "next: not possible now: \"go to next\"");
  EXPECT_EQ(s.answer_to("begin"), "begin: no command");
  EXPECT_EQ(s.answer_to("start"), "start: taken");
  EXPECT_EQ(s.answer_to("save"), "save: not possible now: \"save points\"")
      << "nothing was stroked";
  EXPECT_THAT(s.answer_to("delete"), HasSubstr("delete: nothing"));
  s.tracker().pointer = test::pointer_at({0, 0.02, 0});
  s.strokes(5);
  EXPECT_EQ(s.answer_to("save"), "save: taken");
  EXPECT_THAT(s.answer_to("delete"), HasSubstr("again")) << "not yet";
  EXPECT_EQ(s.answer_to("delete"), "delete: taken");
}

TEST(RequestedCommand, ThatHadNothingToActOnIsNotTaken) {
  Requests4 s;
  s.registers_first_level();
  EXPECT_NE(s.answer_to("accept"), "accept: taken") << "before it was shown";
  EXPECT_EQ(s.answer_to("accept"), "accept: taken");
  EXPECT_EQ(s.answer_to("accept"), "accept: not possible now: \"accept result\"");
  EXPECT_EQ(s.answer_to("next"), "next: taken");
  EXPECT_EQ(s.session().current_step(), Step::kGuide);
  EXPECT_EQ(s.answer_to("twin"), "twin: taken");
  EXPECT_EQ(s.answer_to("accept"), "accept: not possible now: \"accept result\"");
}

TEST(RequestedCommand, ThatTheChecksDoNotBearOutIsNotTaken) {
  Requests4 s(Verification::kByTouch);
  s.registers_first_level();
  s.pairs(2);
  EXPECT_THAT(s.answer_to("accept"), ::testing::Not(HasSubstr("taken")));
  EXPECT_EQ(s.session().current_step(), Step::kVerify);
  EXPECT_THAT(s.answer_to("delete"), HasSubstr("no check point to delete"));
  s.checks_by_touch();
  EXPECT_EQ(s.answer_to("accept"), "accept: taken") << "the control";
  EXPECT_THAT(s.answer_to("next"), ::testing::Not(HasSubstr("taken"))) << "the landmark first";
  EXPECT_EQ(s.session().current_step(), Step::kTouchLandmark);
}

class RequestedPlan : public ::testing::Test {
 protected:
  RequestedPlan() {
    s.tracker().guide = guide_at(kLeftEntry + Vec3{0, 0.030, 0}, 0.0);
    s.accepts_first_level();
    s.listener.heard.clear();
  }
  const nav::ScrewPlan& left() { return s.session().levels()[0].plan.screws[0]; }
  void expect_refused(const Request& request, Kind kind) {
    const nav::ScrewPlan before = left();
    const auto* refused = said<ReplanRefusal>(s.asks(request));
    ASSERT_NE(refused, nullptr);
    EXPECT_EQ(refused->kind, kind);
    EXPECT_EQ(left().entry, before.entry);
    EXPECT_EQ(left().target, before.target);
    EXPECT_EQ(left().radius_m, before.radius_m);
    EXPECT_THAT(s.listener.heard, ::testing::Not(::testing::Contains("replanned")));
  }
  Requests4 s;
};

TEST_F(RequestedPlan, IsInUseAtOnceWithinTheLimitsOfAChangeInSurgery) {
  const Vec3 entry = kLeftEntry + Vec3{0, 0, 0.004};
  const Vec3 target = kLeftTarget + Vec3{0.001, 0.002, 0.003};
  s.asks(plan(entry, target, 0.00275));
  EXPECT_EQ(left().entry.v, entry);
  EXPECT_EQ(left().target.v, target);
  EXPECT_EQ(left().radius_m, 0.00275);
  EXPECT_EQ(s.session().levels()[0].screws[0].preoperative.entry.v, kLeftEntry)
      << "and what was planned";
  EXPECT_THAT(s.listener.heard, ::testing::ElementsAre("asked 10.0.0.7: plan L4",
                                                       "change of the screw", "replanned"));
  s.says("undo");
  EXPECT_EQ(left().entry.v, kLeftEntry);
}

TEST_F(RequestedPlan, BeyondTheLimitsIsRefused) {
  expect_refused(plan(kLeftEntry + Vec3{0, 0, 0.0101}, kLeftTarget), Kind::kEntryTooFar);
  expect_refused(plan(kLeftEntry, kLeftTarget + Vec3{0.0, 0.0, 0.012}), Kind::kTiltTooFar);
  expect_refused(plan(kLeftEntry, kLeftTarget, 0.0031), Kind::kNoSuchSize);
  expect_refused(plan(kLeftEntry, kLeftEntry - Vec3{0, 0.009, 0}), Kind::kIllSized);
}

TEST_F(RequestedPlan, OfAnotherScrewThanThatInWorkIsRefused) {
  expect_refused(plan(kLeftEntry, kLeftTarget, kRadius_m, "L5"), Kind::kOtherScrew);
  expect_refused(plan(kLeftEntry, kLeftTarget, kRadius_m, "L4", nav::Side::kRight),
                 Kind::kOtherScrew);
}

TEST_F(RequestedPlan, ThatLeavesTheCortexWaitsForTheSurgeonsWord) {
  const Vec3 out = kLeftEntry + Vec3{0.0095, 0, 0};  // 24.5 mm of 30, and 6.5 mm thick
  const auto request = plan(out, kLeftTarget + Vec3{0.013, 0, 0}, 0.00325);
  expect_refused(request, Kind::kBreach);
}

TEST(RequestedPlanTooEarly, IsRefusedBeforeItsLevelIsAccepted) {
  Requests4 s;
  s.asks(command("start"));
  const Guidance& g = s.asks(plan(kLeftEntry, kLeftTarget));
  EXPECT_NE(said<NotPossibleNow>(g), nullptr);
  EXPECT_THAT(s.listener.heard, ::testing::Not(::testing::Contains("replanned")));
}

}  // namespace
}  // namespace orthonav::engine::session_request_test
