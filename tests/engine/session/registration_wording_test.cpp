#include <gtest/gtest.h>

#include "engine/session/steps/digitizing.h"
#include "engine/session/steps/verifying.h"
#include "tests/engine/session/status_wording.h"

namespace orthonav::engine::wording_test {
namespace {

TEST(Wording, GivesEveryReasonItsNumberAndLimit) {
  EXPECT_EQ(text_of_reason(Reason::kNoise, 0.0019, 0.0016),
            "the points scatter 1.9 mm about the surface, limit 1.6 mm");
  EXPECT_EQ(text_of_reason(Reason::kInliers, 0.5, 0.7),
            "only 50 % of the points lie on the model, at least 70 %");
  EXPECT_EQ(text_of_reason(Reason::kShaftCollision, 0.4, 0.15),
            "the pointer would have gone through bone at 40 % of the points, limit 15 %");
  EXPECT_EQ(text_of_reason(Reason::kLogLikelihoodRatio, 3.25, 4.6),
            "another pose fits nearly as well (margin 3.2, at least 4.6)");
  EXPECT_EQ(text_of_reason(Reason::kTre99AtScrews, 0.0031, 0.002),
            "99 % of errors at the screws are below 3.1 mm, limit 2.0 mm");
  EXPECT_EQ(text_of(nav::RefusalReason{Reason::kFitsOtherLevel, 0.0, 0.0, {}, "L3"}),
            "the points fit level L3 as well");
}

TEST(Wording, NeverSaysThatANumberExceedsItself) {
  EXPECT_EQ(text_of_reason(Reason::kTre99AtScrews, 0.00204, 0.002),
            "99 % of errors at the screws are below 2.04 mm, limit 2.00 mm");
  EXPECT_EQ(text_of_reason(Reason::kInliers, 0.696, 0.7),
            "only 69.6 % of the points lie on the model, at least 70.0 %");
  EXPECT_EQ(text_of_reason(Reason::kLogLikelihoodRatio, 4.58, 4.6),
            "another pose fits nearly as well (margin 4.58, at least 4.60)");
  EXPECT_EQ(text_of_reason(Reason::kNoise, 0.00300001, 0.003),
            "the points scatter just over 3.0 mm about the surface, limit 3.0 mm");
  EXPECT_EQ(text_of(nav::CheckAdvice{nav::CheckAdvice::Kind::kReject, 4, 0.002003, 0.002}),
            "2.003 mm off, limit 2.000 mm: say reject level");
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
  std::string all = line_with(ByEye{}) + line_with(ChecksSoFar{&verdict}) +
                    line_with(StrokesSoFar{1, &coaching}) + text_of(motion) +
                    text_of(nav::CheckAdvice{nav::CheckAdvice::Kind::kReject, 4, kTiny, 0.002}) +
                    text_of(nav::CheckAdvice{nav::CheckAdvice::Kind::kTouchApart, 3, kTiny, 0.0});
  for (int kind = 0; kind < static_cast<int>(Reason::kFitsOtherLevel); ++kind) {
    all += text_of_reason(static_cast<Reason>(kind), kTiny, 1.0);
  }
  append_tag_size_off(all, "pointer", kTiny);
  EXPECT_EQ(all.find("-0"), std::string::npos) << all;
}

TEST(Wording, NamesTheMotionBehindAnError) {
  const nav::UncertainMotion motion{nav::UncertainMotion::Kind::kCraniocaudal, 0.0012};
  EXPECT_EQ(text_of(motion), "cranial-caudal shift (1.2 mm at the screws)");
  EXPECT_EQ(text_of(nav::RefusalReason{Reason::kTre99AtScrews, 0.0031, 0.002, motion, {}}),
            "99 % of errors at the screws are below 3.1 mm, limit 2.0 mm: cranial-caudal shift "
            "(1.2 mm at the screws)");
}

TEST(Wording, SaysWhereToStroke) {
  using Part = nav::BonePlace::Part;
  using Height = nav::BonePlace::Height;
  EXPECT_EQ(text_of(kLeftLamina), "digitize the left lamina");
  EXPECT_EQ(text_of(nav::BonePlace{Part::kFacet, Side::kRight, Height::kUpper}),
            "digitize the right upper facet");
  EXPECT_EQ(text_of(nav::BonePlace{Part::kSpinousProcess, {}, Height::kLower}),
            "digitize the lower spinous process");
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
            "touch 1 more place, 5 mm off their line");
  EXPECT_EQ(text_of(nav::CheckAdvice{Kind::kReject, 4, 0.0031, 0.002}),
            "3.1 mm off, limit 2.0 mm: say reject level");
  EXPECT_EQ(text_of(nav::CheckAdvice{Kind::kTouchMore, 1, 0.0026, 0.002}), "touch 1 more place");
  EXPECT_EQ(text_of(nav::CheckAdvice{Kind::kUncertain, 1, 0.0026, 0.002}),
            "screws ≤ 2.6 mm off, limit 2.0 mm: say reject level");
}

TEST(Wording, SaysWhereToStrokeNextOrThatItIsEnough) {
  Coaching coaching;
  EXPECT_EQ(text_of(coaching), "◇◇◇◇◇ stroke on");
  coaching.stroke_next = kLeftLamina;
  coaching.progress = 0.7;
  EXPECT_EQ(text_of(coaching), "◆◆◆◇◇ digitize the left lamina");
  EXPECT_EQ(line_with(StrokesSoFar{120, &coaching}), "◆◆◆◇◇ digitize the left lamina");
  coaching.against = nav::RefusalReason{Reason::kNoise, 0.0019, 0.0016, {}, {}};
  EXPECT_EQ(text_of(coaching), "◆◆◆◇◇ the points scatter 1.9 mm about the surface, limit 1.6 mm");
  coaching.enough = true;
  EXPECT_EQ(text_of(coaching), "◆◆◆◆◆ enough: double click");
}

TEST(Wording, SaysWhyARegistrationWasRefusedAndWhatToDo) {
  RegistrationRefused refused;
  refused.reasons = {{Reason::kNoise, 0.0019, 0.0016, {}, {}},
                     {Reason::kFitsOtherLevel, 0.0, 0.0, {}, "L3"}};
  refused.stroke_next = kLeftLamina;
  EXPECT_EQ(line_with(Message(refused)),
            "refused: the points scatter 1.9 mm about the surface, limit 1.6 mm; "
            "digitize the left lamina");
  refused.another_level_fits = true;
  EXPECT_EQ(line_with(Message(refused)),
            "refused: the points scatter 1.9 mm about the surface, limit 1.6 mm; "
            "verify the vertebral level");
  RegistrationRefused none;
  none.error = Error{"0 points, at least 100 needed"};
  EXPECT_EQ(line_with(Message(none)), "refused: 0 points, at least 100 needed");
}

}  // namespace
}  // namespace orthonav::engine::wording_test
