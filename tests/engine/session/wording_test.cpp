#include "engine/session/text/wording.h"

#include <gmock/gmock.h>

#include <array>

#include "base/angle.h"

#include "tests/engine/session/status_wording.h"

namespace orthonav::engine::wording_test {
namespace {

TEST(Wording, SaysLastWhatBecomesOfWhatIsKept) {
  StatusLine line;
  line.tool = "guide";
  line.tool_lost = true;
  line.saved = Saved::kNotSaved;
  EXPECT_EQ(detail_text(line), "guide lost; NOT SAVED");
  line.saved = Saved::kNotRecorded;
  EXPECT_EQ(detail_text(line), "guide lost; NOT RECORDED");
}

TEST(Wording, SaysNothingOfTipsThatNobodyCompares) {
  const TipCheck nobody(0.0007, false);
  LandmarkTouch touch;
  touch.first = true;
  const std::string line = line_with(LandmarkSoFar{true, touch, &nobody, nullptr});
  EXPECT_EQ(line, "say go to next");
}

TEST(Wording, NamesStepsWithWhatTheyAreAbout) {
  EXPECT_EQ(step_text({Step::kSetup, {}, {}}), "setup");
  EXPECT_EQ(step_text({Step::kVerify, "L4", {}}), "verify L4");
  EXPECT_EQ(step_text({Step::kGuide, "L4", Side::kLeft}), "guide L4 left");
  EXPECT_EQ(step_text({Step::kRod, {}, Side::kRight}), "rod right");
}

TEST(Wording, SaysWhichPartsGiveWayFirst) {
  RegistrationRefused refused;
  refused.reasons = {{Reason::kNoise, 0.0019, 0.0016, {}, {}},
                     {Reason::kFitsOtherLevel, 0.0, 0.0, {}, "L3"}};
  refused.stroke_next = kLeftLamina;
  const Message message = refused;
  const HeardCommand heard{"next", true};
  StatusLine line;
  line.tool = "pointer";
  line.tool_lost = true;
  line.message = &message;
  line.heard = &heard;
  std::string text;
  StatusParts parts;
  append_beside_step(text, line, &parts);
  using enum Importance;
  constexpr std::array<Importance, 4> kExpected = {kDanger, kMessage, kNext, kHeard};
  ASSERT_EQ(parts.count, kExpected.size());
  for (std::size_t i = 0; i < kExpected.size(); ++i) {
    EXPECT_EQ(parts.parts[i].importance, kExpected[i]) << i;
  }
  EXPECT_EQ(text.substr(parts.parts[2].begin), "; digitize the left lamina | heard: next");
  std::string plain;
  append_beside_step(plain, line);
  EXPECT_EQ(plain, text) << "asking for the parts changes no word";
}

TEST(Wording, MarksThatEverythingIsSavedInPlaceOfWhatWasHeard) {
  const auto beside_step = [](const StatusLine& line) {
    std::string out;
    append_beside_step(out, line);
    return out;
  };
  StatusLine line;
  line.state = HeadsSoFar{1};
  HeardCommand heard{"save", true};
  line.heard = &heard;
  EXPECT_EQ(beside_step(line), "touch the next head | heard: save");
  line.saved = Saved::kSaved;
  EXPECT_EQ(beside_step(line), "touch the next head | ✓");
  heard.sure = false;
  EXPECT_EQ(beside_step(line), "touch the next head | heard: save? not sure");
  line.heard = nullptr;
  EXPECT_EQ(beside_step(line), "touch the next head | ✓");
}

std::string line_in(Step step, const StepState& state) {
  StatusLine line;
  line.at.step = step;
  line.state = state;
  return detail_text(line);
}

TEST(Wording, AsksForTheNextActInEveryStepAndSaysNoFigures) {
  EXPECT_EQ(line_in(Step::kSetup, {}), "say begin guiding");
  EXPECT_EQ(line_in(Step::kDigitize, StrokesSoFar{812}), "stroke the bone");
  EXPECT_EQ(line_in(Step::kRegistering, {}), "wait");
  EXPECT_EQ(line_in(Step::kVerify, ByEye{}), "say accept result or reject level");
  EXPECT_EQ(line_in(Step::kTouchLandmark, ByEye{}), "say go to next");
  EXPECT_EQ(line_in(Step::kGuide, {}), "") << "follows from what a frame shows";
  EXPECT_EQ(line_in(Step::kRod, HeadsSoFar{0}), "touch the first head");
  EXPECT_EQ(line_in(Step::kRod, HeadsSoFar{1}), "touch the next head");
  EXPECT_EQ(line_in(Step::kRod, HeadsSoFar{4, 0.15236, 3}), "bend it, then say finish rod");
  EXPECT_EQ(line_in(Step::kRod, HeadsSoFar{2, 0.038, 0}), "cut it, then say finish rod");
  EXPECT_EQ(line_in(Step::kRod, HeadsSoFar{3, 0.09, 1, {}, 0}), "touch head 1 again");
  nav::CheckVerdict verdict;
  verdict.advice = {nav::CheckAdvice::Kind::kTouchApart, 2, 0.015, 0.0};
  EXPECT_EQ(line_in(Step::kVerify, ChecksSoFar{&verdict}),
            "touch 2 more places, 15 mm from the others");
  verdict = {true, 0.0013, {}};
  EXPECT_EQ(line_in(Step::kVerify, ChecksSoFar{&verdict}), "passed: say accept result");
  EXPECT_EQ(line_in(Step::kVerify, ChecksSoFar{&verdict, 0.0023}),
            "moved 2.3 mm; passed: say accept result");
  EXPECT_EQ(line_in(Step::kMeasureWire, WireSoFar{}), "sleeve over wire, turn, click");
}

TEST(Wording, AsksForTheLandmarkAndOnceItWasFoundToGoOn) {
  EXPECT_EQ(line_with(LandmarkSoFar{false, {}}), "touch a new one");
  EXPECT_EQ(line_with(LandmarkSoFar{true, LandmarkTouch{true, 0, 0.0, 0.0015}}), "say go to next");
  EXPECT_EQ(line_with(LandmarkSoFar{true, {}}), "touch it");
  EXPECT_EQ(line_with(LandmarkSoFar{true, LandmarkTouch{false, 0, 0.0004, 0.0015}}),
            "say go to next");
  EXPECT_EQ(line_with(LandmarkSoFar{true, LandmarkTouch{false, 1, 0.0, 0.0015}}),
            "lift, then touch again");
  StatusLine warned;
  warned.tool = "pointer";
  warned.tag_size_off = 0.02;
  warned.state = LandmarkSoFar{true, {}};
  EXPECT_EQ(detail_text(warned),
            "pointer: tag 2.0 % larger than stated, check print and unit; touch the landmark");
}

TEST(Wording, SaysEveryMessage) {
  using What = TouchNotRecorded::What;
  using Touch = TouchRefusal::Kind;
  EXPECT_EQ(line_with(Message(NotPossibleNow{Event::kSayAccept})),
            "not possible now: \"accept result\"");
  EXPECT_EQ(line_with(Message(NotUnderstood{})), "not understood");
  EXPECT_EQ(line_with(Message(SaidBeforeShown{})),
            "not accepted: said before the hologram was shown");
  EXPECT_EQ(line_with(Message(NothingToDelete{NothingToDelete::What::kRegion})),
            "nothing to delete");
  EXPECT_EQ(line_with(Message(NothingToDelete{NothingToDelete::What::kCheckPoint})),
            "no check point to delete");
  EXPECT_EQ(line_with(Message(NothingToDelete{NothingToDelete::What::kHead})), "no head to delete");
  EXPECT_EQ(line_with(Message(ConfirmDelete{1})),
            "say delete last again to drop the last saved point");
  EXPECT_EQ(line_with(Message(ConfirmDelete{5})),
            "say delete last again to drop the last saved 5 points");
  EXPECT_EQ(line_with(Message(ChecksMissing{{nav::CheckAdvice::Kind::kTouchApart, 3, 0.015}})),
            "not accepted: touch 3 places, 15 mm apart");
  EXPECT_EQ(line_with(Message(TouchNotRecorded{What::kHead, {Touch::kTipMoved, 0.0032, 0.003}})),
            "head not recorded: tip moved 3.2 mm, limit 3.0 mm");
  EXPECT_EQ(line_with(Message(TouchNotRecorded{What::kCheckPoint, {Touch::kPointerNotSeen}})),
            "check point not recorded: pointer not seen");
  EXPECT_EQ(line_with(Message(TouchNotRecorded{What::kHead, {Touch::kPressAgain}})),
            "head not recorded: press again");
  EXPECT_EQ(line_with(Message(TouchNotRecorded{What::kHead, {Touch::kHeldTooLong}})),
            "head not recorded: hold too long");
  EXPECT_EQ(line_with(Message(TouchNotRecorded{What::kCheckPoint, {Touch::kTooMany}})),
            "check point not recorded: limit of 48 check points reached");
  EXPECT_EQ(
      line_with(Message(TouchNotRecorded{What::kLandmark, {Touch::kTooNear, 0.022, 0.030}})),
      "landmark not recorded: 22 mm from the reference, at least 30 mm: make it farther away");
  EXPECT_EQ(
      line_with(Message(TouchNotRecorded{What::kLandmark, {Touch::kTouchesApart, 0.0031, 0.0021}})),
      "landmark not recorded: touches 3.1 mm apart, limit 2.1 mm: touch again");
  EXPECT_EQ(line_with(Message(NothingToDelete{NothingToDelete::What::kLandmark})),
            "no touch of the landmark to delete");
  EXPECT_EQ(line_with(Message(LandmarkMissing{false})), "not yet: touch a new landmark");
  EXPECT_EQ(line_with(Message(LandmarkMissing{true})), "not yet: touch the landmark");
  EXPECT_EQ(line_with(Message(LandmarkMoved{0.0023, 0.0014, false})),
            "the patient or the map moved 2.3 mm, limit 1.4 mm: check again or reject level");
  EXPECT_EQ(line_with(Message(LandmarkMoved{0.00161, 0.0016, true})),
            "the reference moved 1.61 mm, limit 1.60 mm: check again or reject level");
  EXPECT_EQ(line_with(Message(BoneUnchecked{49.2, 0.0014})),
            "bone not checked for 49 s, the map may have drifted 1.4 mm: touch the landmark");
  EXPECT_EQ(line_with(Message(NoRod{{"2 heads lie 0.4 mm apart, at least 1.0 mm"}})),
            "no rod: 2 heads lie 0.4 mm apart, at least 1.0 mm");
  EXPECT_EQ(line_with(Message(MapMoved{Step::kDigitize})),
            "the headset's map moved: digitize again");
  EXPECT_EQ(line_with(Message(MapMoved{Step::kRod})),
            "the headset's map moved: touch this rod's heads again");
  EXPECT_EQ(line_with(Message(MapMoved{Step::kDone})), "the headset's map moved");
  EXPECT_EQ(line_with(Message(NoImages{})), "no camera images");
  EXPECT_EQ(line_with(Message(Ended{})), "ended");
}

TEST(Wording, TheLossOfTheToolComesBeforeAnyMessage) {
  const Message message = NotPossibleNow{Event::kSayAccept};
  StatusLine line;
  line.tool = "guide";
  line.tool_lost = true;
  line.state = HeadsSoFar{2};
  EXPECT_EQ(detail_text(line), "guide lost") << "in place of how the step stands";
  line.message = &message;
  EXPECT_EQ(detail_text(line), "guide lost; not possible now: \"accept result\"");
  line.pictures_apart = true;
  EXPECT_EQ(
      detail_text(line),
      "the two cameras' pictures do not belong together; not possible now: \"accept result\"");
  line.tool_lost = line.pictures_apart = false;
  line.tag_size_off = -0.032;
  EXPECT_EQ(detail_text(line),
            "guide: tag 3.2 % smaller than stated, check print and unit; not possible now: "
            "\"accept result\"");
}

TEST(Wording, WhatIsToBeTouchedCountsOnBesideAWarning) {
  nav::CheckVerdict verdict;
  verdict.advice = {nav::CheckAdvice::Kind::kTouchApart, 3, 0.015, 0.0};
  StatusLine line;
  line.tool = "pointer";
  line.tool_lost = true;
  line.state = ChecksSoFar{&verdict};
  EXPECT_EQ(detail_text(line), "pointer lost; touch 3 places, 15 mm apart");
}

TEST(Wording, PutsTheLineTogether) {
  StatusLine line;
  line.at = {Step::kGuide, "L4", Side::kLeft};
  std::string text;
  append_status(text, line);
  EXPECT_EQ(text, "guide L4 left");
  const HeardCommand heard{"next", false};
  line.heard = &heard;
  text.clear();
  append_status(text, line);
  EXPECT_EQ(text, "guide L4 left | heard: next? not sure");
  line.state = HeadsSoFar{1};
  text.clear();
  append_status(text, line);
  EXPECT_EQ(text, "guide L4 left | touch the next head | heard: next? not sure");
  text.clear();
  append_without_heard(text, line);
  EXPECT_EQ(text, "guide L4 left | touch the next head");
}

}  // namespace
}  // namespace orthonav::engine::wording_test
