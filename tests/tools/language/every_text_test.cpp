#include <gmock/gmock.h>

#include <span>
#include <thread>

#include "base/angle.h"
#include "engine/session/steps/digitizing.h"
#include "engine/session/steps/guiding.h"
#include "engine/session/steps/replanning.h"
#include "engine/session/steps/verifying.h"
#include "engine/session/text/wording.h"
#include "tests/engine/session/status_wording.h"
#include "tests/support/allocation_count.h"
#include "tests/tools/language/every_message.h"
#include "tests/tools/language/pseudo_language.h"

namespace orthonav::engine::every_text_test {
namespace {

using test::each_up_to;
using test::english_left;
using wording_test::wire_off;

/// Everything is written for a wearer, in a language of brackets.
class EveryText : public ::testing::Test {
 protected:
  static void expect_translated(const std::string& text) {
    EXPECT_EQ(english_left(text), "") << text;
    ++said_;
  }
  static void expect_said(const Message& message) {
    StatusLine line;
    line.message = &message;
    std::string text;
    append_detail(text, line);
    EXPECT_NE(text, "");
    expect_translated(text);
  }
  static void expect_shown(const StepState& state) {
    StatusLine line;
    line.state = state;
    expect_translated(detail_text(line));
  }

  test::PseudoLanguage pseudo_;
  WearersLanguage language_;
  inline static int said_ = 0;
};

TEST_F(EveryText, OfTheStepsIsTranslated) {
  for (const engine::Step step : each_up_to(engine::Step::kDone)) {
    expect_translated(step_text({step, "L4", Side::kLeft}));
    expect_translated(step_text({step, {}, Side::kRight}));
  }
}

TEST_F(EveryText, OfTheFindingsIsTranslated) {
  for (const nav::RefusalReason& reason : test::every_reason()) {
    expect_translated(text_of(reason));
  }
  for (const nav::CheckAdvice& advice : test::every_advice()) {
    expect_translated(text_of(advice));
  }
  for (const nav::BonePlace& place : test::every_place()) {
    expect_translated(text_of(place));
  }
  expect_translated(text_of(std::span<const nav::RefusalReason>()));
  for (const int bits : each_up_to(63)) {
    Coaching coaching;
    coaching.unique = (bits & 1) != 0;
    coaching.enough = (bits & 2) != 0;
    coaching.then_touch = (bits & 4) != 0;
    coaching.registration_only = (bits & 8) != 0;
    coaching.expected_m = 0.001;
    if ((bits & 16) != 0) {
      coaching.against = nav::RefusalReason{};
    }
    if ((bits & 32) != 0) {
      coaching.stroke_next = nav::BonePlace{};
    }
    expect_shown(StrokesSoFar{120, &coaching});
  }
}

TEST_F(EveryText, OfTheStatesIsTranslated) {
  for (const bool flag : {false, true}) {
    expect_shown(ByEye{});
    nav::CheckVerdict verdict;
    verdict.passed = flag;
    verdict.advice = {nav::CheckAdvice::Kind::kTouchApart, 2, 0.015, 0.0};
    expect_shown(ChecksSoFar{&verdict, 0.0023});
    expect_shown(LandmarkSoFar{flag, {}});
    for (const int missing : {0, 1}) {
      expect_shown(LandmarkSoFar{true, LandmarkTouch{flag, missing, 0.0004, 0.0015}});
    }
    PlacedWire wire = wire_off(2.6, 0.0031);
    wire.kept = flag;
    expect_shown(WireSoFar{&wire, false});
    expect_shown(WireSoFar{&wire, true});
  }
  const PlacedWire within = wire_off(0.8, 0.0006);
  expect_shown(WireSoFar{&within});
  expect_shown(WireSoFar{});
  expect_shown(HeadsSoFar{1});
  expect_shown(HeadsSoFar{3, 0.09, 1});
  expect_shown(HeadsSoFar{3, 0.09, 1, HeadTouch{0, {}, 0.0001, 1, 0.0004}, 2});
  expect_shown(HeadsSoFar{3, 0.09, 1, HeadTouch{0, {}, 0.0001, 2, 0.0003}});
  expect_shown(HeadsSoFar{4, 0.15, 3});
  expect_shown(HeadsSoFar{2, 0.038, 0});
}

TEST_F(EveryText, OfWarningsIsTranslated) {
  for (const double off : {0.02, -0.02}) {
    StatusLine line;
    line.tool = "guide";
    line.unused_tool = "pointer";
    line.tag_size_off = off;
    line.stop_past_target_m = 0.004;
    expect_translated(detail_text(line));
  }
  StatusLine apart;
  apart.pictures_apart = true;
  expect_translated(detail_text(apart));
  StatusLine lost;
  lost.tool = "guide";
  lost.tool_lost = true;
  for (const Saved saved : {Saved::kSaved, Saved::kNotSaved, Saved::kNotRecorded}) {
    lost.saved = saved;
    expect_translated(detail_text(lost));
  }
  lost.no_clicker = true;
  expect_translated(detail_text(lost));
  for (std::size_t part = 0; part < kPartCount; ++part) {
    StatusLine stalled;
    stalled.stalled = static_cast<Part>(part);
    expect_translated(detail_text(stalled));
  }
  for (const char* from : {"", "L3"}) {
    std::string heard;
    append_heard(heard, {"mm", false, from});
    expect_translated(heard);
  }
}

TEST_F(EveryText, OfTheMessagesIsTranslated) {
  for (std::size_t event = 0; event < kEventCount; ++event) {
    expect_said(NotPossibleNow{static_cast<Event>(event)});
  }
  for (const auto what : each_up_to(NothingToDelete::What::kWire)) {
    expect_said(NothingToDelete{what});
  }
  for (const auto what : each_up_to(TouchNotRecorded::What::kWire)) {
    for (const auto kind : each_up_to(TouchRefusal::Kind::kAngleUnsure)) {
      expect_said(TouchNotRecorded{what, {kind, 0.003, 0.002, 0.03, 0.02}});
      expect_said(TouchNotRecorded{what, {kind, test::kInfinite, 0.002, 0.03, 0.02}});
    }
  }
  for (const nav::CheckAdvice& advice : test::every_advice()) {
    expect_said(ChecksMissing{advice});
  }
  for (const engine::Step step : each_up_to(engine::Step::kDone)) {
    expect_said(MapMoved{step});
    expect_said(ReferenceMoved{step});
  }
  for (const bool flag : {false, true}) {
    expect_said(LandmarkMissing{flag});
    expect_said(LandmarkMoved{0.0023, 0.0014, flag});
    RegistrationRefused refused;
    refused.reasons = test::every_reason();
    refused.stroke_next = nav::BonePlace{};
    refused.another_level_fits = flag;
    expect_said(refused);
  }
  for (const Message& message :
       {Message(NotUnderstood{}), Message(SaidBeforeShown{}), Message(ConfirmDelete{1}),
        Message(ConfirmDelete{5}), Message(BoneUnchecked{49.2, 0.0014}),
        Message(TipCorrected{0.001}), Message(AxisCorrected{0.01}), Message(WireUndecided{}),
        Message(NoOtherEntry{}), Message(ConfirmRedo{1}), Message(ConfirmRedo{2}),
        Message(ScrewRedone{0.0034, 0.0018}), Message(NoImages{}), Message(Ended{})}) {
    expect_said(message);
  }
  for (const Repeated repeats : each_up_to(Repeated::kHeadPose)) {
    expect_said(NoImages{repeats});
  }
  EXPECT_EQ(std::variant_size_v<Message>, 26u) << "a new message belongs here";
}

TEST_F(EveryText, OfWhatOthersSayIsTranslated) {
  const auto errors = test::every_rod_error();
  EXPECT_EQ(errors.size(), 9u);
  for (const Error& why : errors) {
    expect_said(NoRod{why});
  }
  EXPECT_EQ(test::every_registration_error().size(), 5u);
  for (const Error& why : test::every_registration_error()) {
    RegistrationRefused refused;
    refused.error = why;
    expect_said(refused);
  }
  EXPECT_EQ(test::every_unclear_phrase().size(), 9u);
  for (const Error& why : test::every_unclear_phrase()) {
    std::string text;
    append(text, Message(ReplanUnclear{why}));
    // Between the brackets only the verb and the example are left.
    EXPECT_THAT(text, ::testing::MatchesRegex("\\[[a-z]+( \\[\\] [a-z ]+)?\\]")) << why.message;
  }
}

TEST_F(EveryText, OfChangesOfTheScrewIsTranslated) {
  for (const auto kind : each_up_to(ReplanRefusal::Kind::kBreach)) {
    for (const double diameter_m : {0.0, 0.006}) {
      ReplanRefusal refusal{kind, 0.003, 0.002, diameter_m, 0.045};
      for (const char* towards : {"medial", "anterior", "posterior", "tip"}) {
        refusal.towards = towards;
        expect_said(refusal);
      }
    }
  }
  for (const double by : {0.003, -0.003}) {
    ScrewReplanned done;
    done.level = "L4";
    done.towards = "medial";
    done.difference = {by, by, by, 10.0 * by, 10.0 * by, 0.0055, 0.006, 0.04, 0.045};
    done.undone = by > 0.0;
    expect_said(done);
    done.clearance_m = by;
    expect_said(done);
    done.as_before_surgery = true;
    expect_said(done);
  }
  expect_translated(text_of(nav::ScrewDifference{}));
}

TEST_F(EveryText, OfTheNumbersIsTranslated) {
  for (const int tenths : {-12, 0, 12}) {
    const nav::ShownNumber number{tenths, 3, tenths == 0};
    std::string text;
    for (const NumberRow row : each_up_to(NumberRow::kAimMedial)) {
      text.clear();
      append_number(text, {number, number, number, number}, row);
      expect_translated(text);
    }
    for (const char* towards :
         {"medial", "lateral", "cranial", "caudal", "anterior", "posterior", "tip"}) {
      for (const int bound : {-1, 1}) {
        text.clear();
        append_clearance_line(text, {tenths, bound, towards}, true);
        expect_translated(text);
      }
    }
  }
  for (const auto alarm : each_up_to(nav::DrillAlarm::kStop)) {
    for (const bool watched : {false, true}) {
      std::string text;
      append_drill(text, {nav::DrillPhase::kDrilling, alarm, watched, 0.004});
      expect_translated(text);
    }
  }
  for (const auto to : each_up_to(nav::DepthTo::kPastTarget)) {
    std::string text;
    append_depth(text, {to, 12, nav::Certainty::kBound});
    expect_translated(text);
  }
  std::string offset;
  append_offset(offset, {12, nav::Certainty::kSure});
  expect_translated(offset);
}

TEST_F(EveryText, IsWrittenWithoutAllocating) {
  RegistrationRefused refused;
  refused.reasons = test::every_reason();
  RegistrationRefused none;
  none.error = test::every_registration_error().back();
  const Message messages[] = {
      refused, none, NoRod{test::every_rod_error()[3]}, BoneUnchecked{49.2, 0.0014},
      TouchNotRecorded{TouchNotRecorded::What::kHead, {TouchRefusal::Kind::kTipMoved, 3, 2}}};
  std::string text;
  text.reserve(1u << 20u);
  StatusParts parts;
  const std::size_t before = test::allocation_count();
  for (const Message& message : messages) {
    StatusLine line;
    line.tool = "guide";
    line.tool_lost = true;
    line.message = &message;
    line.saved = Saved::kSaved;
    append_detail(text, line, &parts);
  }
  EXPECT_EQ(test::allocation_count(), before);
}

TEST_F(EveryText, IsEnglishWhereNoWearerReadsIt) {
  // The control: what a log holds is found to be English.
  StatusLine line;
  line.tool = "guide";
  line.tool_lost = true;
  std::string written;
  std::thread([&] { written = detail_text(line); }).join();
  EXPECT_EQ(written, "guide lost");
  EXPECT_EQ(english_left(written), "lost");
}

}  // namespace
}  // namespace orthonav::engine::every_text_test
