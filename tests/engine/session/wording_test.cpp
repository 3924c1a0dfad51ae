#include "engine/session/wording.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "base/angle.h"

namespace orthonav::engine {
namespace {

using Reason = nav::RefusalReason::Kind;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

const nav::BonePlace kLeftLamina{nav::BonePlace::Part::kLamina, Side::kLeft,
                                 nav::BonePlace::Height::kMiddle};

std::string text_of_reason(Reason kind, double value, double limit) {
  return text_of(nav::RefusalReason{kind, value, limit, {}, {}});
}

std::string line_with(const Message& message) {
  StatusLine line;
  line.message = &message;
  return detail_text(line);
}

std::string line_with(const StepState& state) {
  StatusLine line;
  line.state = state;
  return detail_text(line);
}

TEST(Wording, SaysLastWhatBecomesOfWhatIsKept) {
  StatusLine line;
  line.tool = "guide";
  line.tool_lost = true;
  line.saved = Saved::kSaved;
  EXPECT_EQ(detail_text(line), "guide lost; saved");
  line.saved = Saved::kNotSaved;
  EXPECT_EQ(detail_text(line), "guide lost; NOT SAVED");
  line.saved = Saved::kNotRecorded;
  EXPECT_EQ(detail_text(line), "guide lost; NOT RECORDED");
}

TEST(Wording, SaysNothingOfTipsThatNobodyCompares) {
  const TipCheck nobody({}, {}, false);
  LandmarkTouch touch;
  touch.first = true;
  const std::string line = line_with(LandmarkSoFar{{}, true, touch, &nobody, nullptr});
  EXPECT_THAT(line, ::testing::EndsWith("dimple recorded"));
}

TEST(Wording, NamesStepsWithWhatTheyAreAbout) {
  EXPECT_EQ(step_text({Step::kSetup, {}, {}}), "setup");
  EXPECT_EQ(step_text({Step::kVerify, "L4", {}}), "verify L4");
  EXPECT_EQ(step_text({Step::kGuide, "L4", Side::kLeft}), "guide L4 left");
  EXPECT_EQ(step_text({Step::kRod, {}, Side::kRight}), "rod right");
}

TEST(Wording, GivesEveryReasonItsNumberAndLimit) {
  EXPECT_EQ(text_of_reason(Reason::kRmse, 0.0034, 0.003), "registration RMSE 3.4 mm, limit 3.0 mm");
  EXPECT_EQ(text_of_reason(Reason::kRunnerUpRmse, 1.02, 1.2),
            "another pose fits nearly as well (1.02 times the RMSE, at least 1.20)");
  EXPECT_EQ(text_of_reason(Reason::kTreAtCentre, 0.0041, 0.002),
            "the points leave the bone loose: 4.1 mm error expected at its centre, limit 2.0 mm");
  EXPECT_EQ(text_of_reason(Reason::kNoise, 0.0019, 0.0016),
            "the points scatter 1.9 mm about the surface, limit 1.6 mm");
  EXPECT_EQ(text_of_reason(Reason::kInliers, 0.5, 0.7),
            "only 50 % of the points lie on the model, at least 70 %");
  EXPECT_EQ(text_of_reason(Reason::kCoverage, 0.05, 0.1),
            "only 5 % of the surface was stroked, at least 10 %");
  EXPECT_EQ(text_of_reason(Reason::kShaftCollision, 0.4, 0.15),
            "the pointer would have gone through bone at 40 % of the points, limit 15 %");
  EXPECT_EQ(text_of_reason(Reason::kLogLikelihoodRatio, 3.25, 12.0),
            "another pose fits nearly as well (margin 3.2, at least 12)");
  EXPECT_EQ(text_of_reason(Reason::kTreAtScrews, 0.0024, 0.0015),
            "error expected at the screws 2.4 mm, limit 1.5 mm");
  EXPECT_EQ(text_of_reason(Reason::kTre99AtScrews, 0.0031, 0.002),
            "1 of 100 errors at the screws would exceed 3.1 mm, limit 2.0 mm");
  EXPECT_EQ(text_of(nav::RefusalReason{Reason::kFitsOtherLevel, 0.0, 0.0, {}, "L3"}),
            "the points fit level L3 as well");
}

TEST(Wording, NeverSaysThatANumberExceedsItself) {
  EXPECT_EQ(text_of_reason(Reason::kTre99AtScrews, 0.00204, 0.002),
            "1 of 100 errors at the screws would exceed 2.04 mm, limit 2.00 mm");
  EXPECT_EQ(text_of_reason(Reason::kInliers, 0.696, 0.7),
            "only 69.6 % of the points lie on the model, at least 70.0 %");
  EXPECT_EQ(text_of_reason(Reason::kLogLikelihoodRatio, 11.96, 12.0),
            "another pose fits nearly as well (margin 11.96, at least 12.0)");
  EXPECT_EQ(text_of_reason(Reason::kRmse, 0.00300001, 0.003),
            "registration RMSE just over 3.0 mm, limit 3.0 mm");
  EXPECT_EQ(text_of(nav::CheckAdvice{nav::CheckAdvice::Kind::kReject, 4, 0.002003, 0.002}),
            "check point 4 is 2.003 mm off, limit 2.000 mm: reject and stroke again");
  EXPECT_EQ(line_with(Message(TouchNotRecorded{TouchNotRecorded::What::kHead,
                                               {TouchRefusal::Kind::kTipMoved, 0.00304, 0.003}})),
            "head not recorded: tip moved 3.04 mm, limit 3.00 mm");
}

TEST(Wording, HasNoNegativeZero) {
  constexpr double kTiny = -1e-9;
  nav::CheckVerdict verdict{true, kTiny, {}};
  Coaching coaching;
  coaching.unique = true;
  coaching.expected_m = kTiny;
  const nav::UncertainMotion motion{nav::UncertainMotion::Kind::kCraniocaudal, kTiny};
  std::string all = line_with(RegistrationFigures{kTiny, kTiny, true}) +
                    line_with(ChecksSoFar{kTiny, 1, kTiny, &verdict}) +
                    line_with(StrokesSoFar{1, &coaching}) + text_of(motion) +
                    text_of(nav::CheckAdvice{nav::CheckAdvice::Kind::kReject, 4, kTiny, 0.002}) +
                    text_of(nav::CheckAdvice{nav::CheckAdvice::Kind::kTouchApart, 3, kTiny, 0.0});
  for (int kind = 0; kind < static_cast<int>(Reason::kFitsOtherLevel); ++kind) {
    all += text_of_reason(static_cast<Reason>(kind), kTiny, 1.0);
  }
  append_tag_size_off(all, "pointer", kTiny);
  EXPECT_EQ(all.find("-0"), std::string::npos) << all;
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
  constexpr std::array<Importance, 5> kExpected = {kDanger, kMessage, kMore, kNext, kHeard};
  ASSERT_EQ(parts.count, kExpected.size());
  for (std::size_t i = 0; i < kExpected.size(); ++i) {
    EXPECT_EQ(parts.parts[i].importance, kExpected[i]) << i;
  }
  EXPECT_EQ(text.substr(parts.parts[3].begin), "; stroke the left lamina | heard: next");
  std::string plain;
  append_beside_step(plain, line);
  EXPECT_EQ(plain, text) << "asking for the parts changes no word";
}

TEST(Wording, NamesTheMotionBehindAnError) {
  const nav::UncertainMotion motion{nav::UncertainMotion::Kind::kCraniocaudal, 0.0012};
  EXPECT_EQ(text_of(motion), "cranial-caudal shift (1.2 mm at the screws)");
  EXPECT_EQ(text_of(nav::RefusalReason{Reason::kTreAtScrews, 0.0024, 0.0015, motion, {}}),
            "error expected at the screws 2.4 mm, limit 1.5 mm: cranial-caudal shift (1.2 mm at "
            "the screws)");
  EXPECT_EQ(text_of(nav::UncertainMotion{}), "one motion of the bone is not determined");
}

TEST(Wording, SaysWhereToStroke) {
  using Part = nav::BonePlace::Part;
  using Height = nav::BonePlace::Height;
  EXPECT_EQ(text_of(kLeftLamina), "stroke the left lamina");
  EXPECT_EQ(text_of(nav::BonePlace{Part::kFacet, Side::kRight, Height::kUpper}),
            "stroke the right upper facet and root of the transverse process");
  EXPECT_EQ(text_of(nav::BonePlace{Part::kSpinousProcess, {}, Height::kLower}),
            "stroke the lower spinous process");
}

TEST(Wording, AsksForCheckPoints) {
  using Kind = nav::CheckAdvice::Kind;
  EXPECT_EQ(text_of(nav::CheckAdvice{Kind::kTouchApart, 3, 0.015, 0.0}),
            "touch 3 places, 15 mm apart");
  EXPECT_EQ(text_of(nav::CheckAdvice{Kind::kTouchApart, 2, 0.015, 0.0}),
            "touch 2 more places, 15 mm from the others");
  EXPECT_EQ(text_of(nav::CheckAdvice{Kind::kTouchApart, 1, 0.015, 0.0}),
            "touch 1 more place, 15 mm from the others");
  EXPECT_EQ(text_of(nav::CheckAdvice{Kind::kTouchOffLine, 1, 0.005, 0.0}),
            "touch 1 more place, 5 mm off the line of the others");
  EXPECT_EQ(text_of(nav::CheckAdvice{Kind::kReject, 4, 0.0031, 0.002}),
            "check point 4 is 3.1 mm off, limit 2.0 mm: reject and stroke again");
  EXPECT_EQ(text_of(nav::CheckAdvice{Kind::kTouchMore, 1, 0.0026, 0.002}),
            "touch 1 more place: 1 of 100 errors at the screws would exceed 2.6 mm, limit 2.0 mm");
  EXPECT_EQ(text_of(nav::CheckAdvice{Kind::kUncertain, 1, 0.0026, 0.002}),
            "1 of 100 errors at the screws would exceed 2.6 mm, limit 2.0 mm: reject and stroke "
            "again");
}

TEST(Wording, SaysWhatStrokesAreWorth) {
  Coaching coaching;
  coaching.unique = true;
  coaching.expected_m = 0.0024;
  coaching.stroke_next = kLeftLamina;
  EXPECT_EQ(text_of(coaching), "expected error 2.4 mm, stroke the left lamina");
  EXPECT_EQ(line_with(StrokesSoFar{120, &coaching}),
            "120 points | expected error 2.4 mm, stroke the left lamina");
  coaching.against = nav::RefusalReason{Reason::kNoise, 0.0019, 0.0016, {}, {}};
  EXPECT_EQ(text_of(coaching),
            "expected error 2.4 mm, the points scatter 1.9 mm about the surface, limit 1.6 mm");
  coaching.enough = true;
  EXPECT_EQ(text_of(coaching), "expected error 2.4 mm, enough to register");
  coaching.expected_m = kInfinite;
  EXPECT_EQ(text_of(coaching), "expected error -- mm, enough to register");
  coaching.unique = coaching.enough = false;
  coaching.against.reset();
  EXPECT_EQ(text_of(coaching), "ambiguous, stroke the left lamina")
      << "no error is promised of a pose that may be the wrong one";
}

TEST(Wording, SaysHowAStepStands) {
  EXPECT_EQ(line_with(StepState{}), "");
  EXPECT_EQ(line_with(RegistrationFigures{0.0006, 0.0012, false}),
            "RMSE 0.60 mm, expected error 1.2 mm at the screws");
  EXPECT_EQ(line_with(RegistrationFigures{kInfinite, 0.0012, true}),
            "RMSE -- mm, expected error 1.2 mm");
  EXPECT_EQ(line_with(RegistrationFigures{0.0006, 0.0012, false, true}),
            "RMSE 0.60 mm, expected error 1.2 mm at the screws (registration only)");
  EXPECT_EQ(line_with(HeadsSoFar{2}), "2 heads");
  EXPECT_EQ(line_with(HeadsSoFar{4, 0.15236, 3}), "4 heads, cut to 152.4 mm, 3 bends");
  EXPECT_EQ(line_with(HeadsSoFar{3, 0.09, 1}), "3 heads, cut to 90.0 mm, 1 bend");
  nav::CheckVerdict verdict;
  verdict.advice = {nav::CheckAdvice::Kind::kTouchApart, 2, 0.015, 0.0};
  EXPECT_EQ(line_with(ChecksSoFar{0.0008, 1, -0.0007, &verdict}),
            "expected error 0.8 mm; check 1: -0.7 mm; touch 2 more places, 15 mm from the "
            "others");
  verdict = {true, 0.0013, {}};
  EXPECT_EQ(line_with(ChecksSoFar{0.0008, 3, std::nullopt, &verdict}),
            "expected error 0.8 mm; passed, worst 1.3 mm");
  EXPECT_EQ(line_with(ChecksSoFar{0.0008, 3, std::nullopt, &verdict, false, 0.0023}),
            "expected error 0.8 mm; moved 2.3 mm; passed, worst 1.3 mm");
}

TEST(Wording, AsksForTheLandmarkAndTellsHowItWasFound) {
  const RegistrationFigures figures{0.00062, 0.0011, false};
  EXPECT_EQ(
      line_with(LandmarkSoFar{figures, false, {}}),
      "RMSE 0.62 mm, expected error 1.1 mm at the screws; make a dimple in this bone and touch it");
  EXPECT_EQ(line_with(LandmarkSoFar{figures, true, LandmarkTouch{true, 0, 0.0, 0.0015}}),
            "RMSE 0.62 mm, expected error 1.1 mm at the screws; dimple recorded");
  EXPECT_EQ(line_with(LandmarkSoFar{figures, true, {}}),
            "RMSE 0.62 mm, expected error 1.1 mm at the screws; touch the dimple");
  EXPECT_EQ(line_with(LandmarkSoFar{figures, true, LandmarkTouch{false, 0, 0.0004, 0.0015}}),
            "RMSE 0.62 mm, expected error 1.1 mm at the screws; dimple found, 0.4 mm off");
  EXPECT_EQ(
      line_with(LandmarkSoFar{figures, true, LandmarkTouch{false, 1, 0.0, 0.0015}}),
      "RMSE 0.62 mm, expected error 1.1 mm at the screws; lift the tip and touch the dimple again");
  StatusLine warned;
  warned.tool = "pointer";
  warned.tag_size_off = 0.02;
  warned.state = LandmarkSoFar{figures, true, {}};
  EXPECT_EQ(detail_text(warned),
            "pointer: tag 2.0 % larger than stated, check print and unit; touch the dimple");
}

PlacedWire wire_off(double angle_deg, double entry_m) {
  PlacedWire wire;
  wire.axis.angle_rad = {angle_deg * kRadiansPerDegree, 0.9 * kRadiansPerDegree};
  wire.axis.entry_m = {entry_m, 0.0006};
  wire.angle_limit_rad = 2.0 * kRadiansPerDegree;
  wire.entry_limit_m = 0.002;
  return wire;
}

TEST(Wording, AsksForTheSleeveAndTellsHowTheWireStands) {
  EXPECT_EQ(line_with(WireSoFar{}), "set the sleeve over the wire, turn it and click, or say next");
  const PlacedWire within = wire_off(0.8, 0.0006);
  EXPECT_EQ(line_with(WireSoFar{&within}), "placed: 0.8 ± 0.9°, 0.6 ± 0.6 mm from the plan");
  const PlacedWire turned = wire_off(2.04, 0.0006);
  EXPECT_EQ(line_with(WireSoFar{&turned}),
            "placed: 2.0 ± 0.9°, 0.6 ± 0.6 mm from the plan; angle 2.04°, limit 2.00°: say accept "
            "to keep it, delete to redo it");
  PlacedWire off = wire_off(2.6, 0.0031);
  EXPECT_EQ(line_with(WireSoFar{&off, true}),
            "placed: 2.6 ± 0.9°, 3.1 ± 0.6 mm from the plan; angle 2.6°, limit 2.0°; entry 3.1 mm, "
            "limit 2.0 mm: no other entry stays inside the bone, say accept to keep it");
  off.kept = true;
  EXPECT_EQ(line_with(WireSoFar{&off}),
            "placed: 2.6 ± 0.9°, 3.1 ± 0.6 mm from the plan; angle 2.6°, limit 2.0°; entry 3.1 mm, "
            "limit 2.0 mm: kept, say next");
  StatusLine lost;
  lost.tool = "guide";
  lost.tool_lost = true;
  lost.state = WireSoFar{};
  EXPECT_EQ(detail_text(lost),
            "guide lost; set the sleeve over the wire, turn it and click, or say next");
}

TEST(Wording, SaysWhyAWireWasNotMeasuredAndWhatBecomesOfIt) {
  using Kind = TouchRefusal::Kind;
  const auto refused = [](const TouchRefusal& why) {
    return line_with(Message(TouchNotRecorded{TouchNotRecorded::What::kWire, why}));
  };
  const double deg = kRadiansPerDegree;
  EXPECT_EQ(refused({Kind::kGuideNotSeen}), "wire not recorded: guide not seen all the while");
  EXPECT_EQ(refused({Kind::kReferenceNotSeen}), "wire not recorded: reference not seen");
  EXPECT_EQ(refused({Kind::kSleeveTurned, 0.0, 0.0, 1.4 * deg, 1.0 * deg}),
            "wire not recorded: sleeve turned 1.4°, limit 1.0°");
  EXPECT_EQ(refused({Kind::kOffTheScrew, 0.021, 0.015}),
            "wire not recorded: sleeve 21 mm off the entry, limit 15 mm");
  EXPECT_EQ(refused({Kind::kAcrossTheScrew, 0.0, 0.0, 41.0 * deg, 30.0 * deg}),
            "wire not recorded: sleeve 41° off the plan, limit 30°");
  EXPECT_EQ(refused({Kind::kEntryUnsure, 0.0018, 0.0015}),
            "wire not recorded: place known to ± 1.8 mm, limit 1.5 mm");
  EXPECT_EQ(refused({Kind::kEntryUnsure, std::numeric_limits<double>::infinity(), 0.0015}),
            "wire not recorded: how sure the registration is, is not known");
  EXPECT_EQ(refused({Kind::kAngleUnsure, 0.0, 0.0, 1.8 * deg, 1.5 * deg}),
            "wire not recorded: angle known to ± 1.8°, limit 1.5°");
  EXPECT_EQ(line_with(Message(NothingToDelete{NothingToDelete::What::kWire})),
            "measure the wire first");
  EXPECT_EQ(line_with(Message(WireUndecided{})),
            "not yet: say accept to keep it, delete to redo it");
  EXPECT_EQ(line_with(Message(NoOtherEntry{})),
            "no other entry stays inside the bone, say accept to keep it");
  EXPECT_EQ(line_with(Message(ConfirmRedo{1})),
            "redone once already: say delete again to redo it, accept to keep it");
  EXPECT_EQ(line_with(Message(ConfirmRedo{2})),
            "redone 2 times already: say delete again to redo it, accept to keep it");
  EXPECT_EQ(line_with(Message(ScrewRedone{0.0034, 0.0018})),
            "new entry 3.4 mm from the hole, clearance 1.8 mm: take the wire out and touch the "
            "dimple");
}

TEST(Wording, SaysEveryMessage) {
  using What = TouchNotRecorded::What;
  using Touch = TouchRefusal::Kind;
  EXPECT_EQ(line_with(Message(NotPossibleNow{Event::kSayAccept})), "not possible now: \"accept\"");
  EXPECT_EQ(line_with(Message(NotUnderstood{})), "not understood");
  EXPECT_EQ(line_with(Message(SaidBeforeShown{})),
            "not accepted: said before the hologram was shown");
  EXPECT_EQ(line_with(Message(NothingToDelete{NothingToDelete::What::kRegion})),
            "nothing to delete");
  EXPECT_EQ(line_with(Message(NothingToDelete{NothingToDelete::What::kCheckPoint})),
            "no check point to delete");
  EXPECT_EQ(line_with(Message(NothingToDelete{NothingToDelete::What::kHead})), "no head to delete");
  EXPECT_EQ(line_with(Message(ConfirmDelete{5})),
            "say delete again to drop the last saved 5 points");
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
            "check point not recorded: there are 48 already");
  EXPECT_EQ(line_with(Message(TouchNotRecorded{What::kLandmark, {Touch::kTooNear, 0.022, 0.030}})),
            "dimple not recorded: 22 mm from the reference, at least 30 mm: make it farther away");
  EXPECT_EQ(
      line_with(Message(TouchNotRecorded{What::kLandmark, {Touch::kTouchesApart, 0.0031, 0.0021}})),
      "dimple not recorded: touches 3.1 mm apart, limit 2.1 mm: touch it anew");
  EXPECT_EQ(line_with(Message(NothingToDelete{NothingToDelete::What::kLandmark})),
            "no touch of the dimple to delete");
  EXPECT_EQ(line_with(Message(LandmarkMissing{false})),
            "not yet: make a dimple in this bone and touch it");
  EXPECT_EQ(line_with(Message(LandmarkMissing{true})), "not yet: touch the dimple");
  EXPECT_EQ(line_with(Message(LandmarkMoved{0.0023, 0.0014, false})),
            "the patient or the map moved 2.3 mm, limit 1.4 mm: check again or reject");
  EXPECT_EQ(line_with(Message(LandmarkMoved{0.00161, 0.0016, true})),
            "the reference moved 1.61 mm, limit 1.60 mm: check again or reject");
  EXPECT_EQ(line_with(Message(BoneUnchecked{49.2, 0.0014})),
            "bone not checked for 49 s, the map may have drifted 1.4 mm: touch the dimple");
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

TEST(Wording, SaysWhyARegistrationWasRefusedAndWhatToDo) {
  RegistrationRefused refused;
  refused.reasons = {{Reason::kNoise, 0.0019, 0.0016, {}, {}},
                     {Reason::kFitsOtherLevel, 0.0, 0.0, {}, "L3"}};
  refused.stroke_next = kLeftLamina;
  EXPECT_EQ(line_with(Message(refused)),
            "refused: the points scatter 1.9 mm about the surface, limit 1.6 mm; the points fit "
            "level L3 as well; stroke the left lamina");
  refused.another_level_fits = true;
  EXPECT_EQ(line_with(Message(refused)),
            "refused: the points scatter 1.9 mm about the surface, limit 1.6 mm; the points fit "
            "level L3 as well; verify the vertebral level");
  RegistrationRefused none;
  none.error = Error{"0 points, at least 100 needed"};
  EXPECT_EQ(line_with(Message(none)), "refused: 0 points, at least 100 needed");
}

TEST(Wording, TheLossOfTheToolComesBeforeAnyMessage) {
  const Message message = NotPossibleNow{Event::kSayAccept};
  StatusLine line;
  line.tool = "guide";
  line.tool_lost = true;
  line.state = HeadsSoFar{2};
  EXPECT_EQ(detail_text(line), "guide lost") << "in place of how the step stands";
  line.message = &message;
  EXPECT_EQ(detail_text(line), "guide lost; not possible now: \"accept\"");
  line.tool_lost = false;
  line.tag_size_off = -0.032;
  EXPECT_EQ(detail_text(line),
            "guide: tag 3.2 % smaller than stated, check print and unit; not possible now: "
            "\"accept\"");
}

TEST(Wording, WhatIsToBeTouchedCountsOnBesideAWarning) {
  nav::CheckVerdict verdict;
  verdict.advice = {nav::CheckAdvice::Kind::kTouchApart, 3, 0.015, 0.0};
  StatusLine line;
  line.tool = "pointer";
  line.tool_lost = true;
  line.state = ChecksSoFar{0.0008, 0, std::nullopt, &verdict};
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
  EXPECT_EQ(text, "guide L4 left | 1 heads | heard: next? not sure");
  text.clear();
  append_without_heard(text, line);
  EXPECT_EQ(text, "guide L4 left | 1 heads");
}

}  // namespace
}  // namespace orthonav::engine
