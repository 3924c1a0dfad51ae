#include <gmock/gmock.h>

#include "engine/session/session.h"
#include "engine/session/text/wording.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_tips_test {
namespace {

using test::guide_at;
using test::said;
using test::ScriptedOperation;
using test::touch_refusal;
using ::testing::HasSubstr;
using enum ClickerAction;

constexpr Vec3 kLandmark = ScriptedOperation::kLandmark;
constexpr double kExact = 1e-9;
constexpr double kTilt_rad = 0.3;

/// With a reference; the pointer has touched the landmark and was laid aside in view.
class TipsSession : public ::testing::Test {
 protected:
  TipsSession() : s({"L4", "L5"}, test::three_places(), Verification::kByTouch, false, true) {
    s.tracker().size_difference_sd = 0.0042;  // tags as printed, of unmeasured size
    s.accepts_first_by_touch();
    s.touches_landmark();
    s.tracker().pointer = test::pointer_at(kLandmark + Vec3{0.2, 0, 0});
  }
  /// A click with the guide's tip there, according to its description.
  const Guidance& touches_by_guide(Vec3 tip) {
    s.tracker().guide = guide_at(tip, kTilt_rad);
    s.does({kPress});
    s.pair();
    return s.does({kRelease, kClick});
  }
  /// Distance of the tip from the landmark when the description puts it there in another
  /// orientation.
  double tip_off_m() {
    s.tracker().guide = guide_at(kLandmark, -kTilt_rad);
    return (s.pairs(2).tool->measured->tip.v - kLandmark).norm();
  }
  ScriptedOperation s;
};

TEST_F(TipsSession, TipsThatAgreeAreToldAndLeftAlone) {
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kGuideTipHeld);
  const Guidance& g = touches_by_guide(kLandmark + Vec3{0.0006, 0, 0});
  EXPECT_THAT(detail_text(g.status), HasSubstr("say go to next"));
  EXPECT_EQ(checks_asked(g.status), ChecksAsked::kPassed);
  s.says("accept");
  ASSERT_NE(said<NotPossibleNow>(s.pair()), nullptr) << "there is nothing to correct";
  s.says("next");
  EXPECT_NEAR(tip_off_m(), 0.0, kExact);
}

TEST_F(TipsSession, ADifferenceIsCorrectedOnlyWithConsent) {
  const Vec3 off{0.004, 0.001, -0.003};
  const Guidance& g = touches_by_guide(kLandmark + off);
  EXPECT_THAT(detail_text(g.status), HasSubstr("guide's tip 5.1 mm from the pointer's"));
  EXPECT_EQ(checks_asked(g.status), ChecksAsked::kCorrectGuide);
  s.says("next");
  EXPECT_NEAR(tip_off_m(), 0.0, kExact) << "not yet";
}

/// If the tag sizes are not known yet, most of a difference may come from them.
TEST_F(TipsSession, TheCorrectionIsOfTheToolHoweverItIsHeldAndByWhatIsKnown) {
  const Vec3 off{0.004, 0.001, -0.003};
  touches_by_guide(kLandmark + off);
  s.tracker().guide = guide_at({0.3, 0.3, 0.3}, 1.2);  // moved before the consent
  const Guidance& g = s.says("accept");
  ASSERT_NE(said<TipCorrected>(g), nullptr);
  const double by_m = said<TipCorrected>(g)->by_m;
  EXPECT_THAT(detail_text(g.status), HasSubstr("tip corrected by "));
  EXPECT_GT(by_m, 0.1 * off.norm());
  EXPECT_LT(by_m, 0.5 * off.norm());
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kNone) << "while the message stands";
  // In the same pose as at the landmark, its tip is nearer to the pointer's now.
  s.says("next");
  s.tracker().guide = guide_at(kLandmark + off, kTilt_rad);
  EXPECT_NEAR((s.pairs(2).tool->measured->tip.v - kLandmark).norm(), off.norm() - by_m, kExact);
  EXPECT_NEAR(tip_off_m(), by_m, kExact) << "turned, the correction turns with it";
}

/// SD along an axis of the distance between the two described tips.
constexpr double kPriorSd_m = 0.0007;

TEST(TipCheck, TheBetterATouchIsTheMoreOfItIsBelieved) {
  const nav::PressedPlace pointer{{{0, 0, 0}}, 0.0001};
  const nav::PressedPlace guide{{{0.001, 0, 0}}, 0.0001};
  double before_m = 0.001;
  for (const double size_sd : {0.0003, 0.002, 0.01}) {
    TipCheck check(kPriorSd_m);
    const auto taken = check.take(guide, {}, pointer, true, size_sd);
    const double by_m = std::get<TipDifference>(taken).by_m.norm();
    EXPECT_LT(by_m, before_m) << size_sd;
    before_m = by_m;
  }
  EXPECT_LT(before_m, 0.0002) << "two tags of unknown size tell nothing of a tip";
}

TEST(TipCheck, SaysHowFarTheGuideMayBeOffThePointer) {
  TipCheck check(kPriorSd_m);
  constexpr double kSizeSd = 0.0005;
  const double tags_m = kTagDistance_m * kSizeSd / std::sqrt(3.0);
  const Mat3 held = Mat3::identity();
  EXPECT_NEAR(check.difference_sd_m(kSizeSd, held), std::hypot(kPriorSd_m, tags_m), kExact)
      << "as their calibrations leave them";
  EXPECT_GT(check.difference_sd_m(0.004, held), 0.001) << "tags of unknown size";
  const nav::PressedPlace pointer{{{0.01, 0.02, 0.0}}, 0.0001};
  const nav::PressedPlace guide{{{0.01, 0.0215, 0.0}}, 0.0001};
  ASSERT_TRUE(std::holds_alternative<TipDifference>(check.take(guide, {}, pointer, true, kSizeSd)));
  const TipDifference found = *check.last();
  const double left_m = kPriorSd_m * found.sd_m / std::hypot(kPriorSd_m, found.sd_m);
  EXPECT_NEAR(check.difference_sd_m(kSizeSd, held),
              std::hypot(left_m, found.by_m.norm() / std::sqrt(3.0), tags_m), kExact)
      << "known, and not corrected";
  EXPECT_EQ(check.correct(), found.by_m);
  EXPECT_NEAR(check.difference_sd_m(kSizeSd, held), std::hypot(left_m, tags_m), kExact);
  // Held otherwise, it is known less well: upside down as well as without the comparison, or worse.
  double before_m = check.difference_sd_m(kSizeSd, held);
  for (const double turned_rad : {0.2, 0.6, 1.2, 3.1}) {
    const double sd_m = check.difference_sd_m(kSizeSd, rotation_from_vector({turned_rad, 0, 0}));
    EXPECT_GT(sd_m, before_m);
    before_m = sd_m;
  }
  EXPECT_GT(before_m, kPriorSd_m);
}

TEST_F(TipsSession, AGuideElsewhereIsNoTouchOfIt) {
  const TouchRefusal why = touch_refusal(touches_by_guide(kLandmark + Vec3{0.0151, 0, 0}));
  EXPECT_EQ(why.kind, TouchRefusal::Kind::kTouchesApart);
  EXPECT_EQ(checks_asked(s.pairs(120).status), ChecksAsked::kGuideTipHeld) << "still to be done";
}

TEST_F(TipsSession, AreComparedBeforeEveryScrewAndAsHeldForIt) {
  touches_by_guide(kLandmark + Vec3{0.006, 0, 0});  // told, and left as it is
  for (int i = 0; i < 3; ++i) {  // guides the first screw, measures no wire, and comes back
    s.says("next");
  }
  s.tracker().guide.reset();
  s.touches_landmark();
  const Guidance g = s.pair();
  EXPECT_EQ(g.step, Step::kTouchLandmark);
  EXPECT_EQ(checks_asked(g.status), ChecksAsked::kGuideTipHeld);
  EXPECT_THAT(detail_text(g.status), HasSubstr("guide's tip, as drilling"));
  ASSERT_NE(said<NotPossibleNow>(s.says("accept")), nullptr) << "the old one is past";
}

TEST(Tips, AreComparedOnceOnAMapThatDrifts) {
  ScriptedOperation s({"L4", "L5"}, {}, Verification::kByTouch);
  s.accepts_first_by_touch();
  s.touches_landmark();
  s.tracker().pointer = test::pointer_at(kLandmark + Vec3{0.2, 0, 0});
  ASSERT_EQ(checks_asked(s.pair().status), ChecksAsked::kGuideTip);
  s.tracker().guide = guide_at(kLandmark + Vec3{0.0006, 0, 0}, kTilt_rad);
  s.does({kPress});
  s.pair();
  s.does({kRelease, kClick});
  for (int i = 0; i < 3; ++i) {
    s.says("next");
  }
  s.tracker().guide.reset();
  s.touches_landmark();
  const Guidance& g = s.pair();
  EXPECT_EQ(g.step, Step::kTouchLandmark);
  EXPECT_EQ(checks_asked(g.status), ChecksAsked::kCorrectGuide) << "of the first comparison";
}

TEST_F(TipsSession, NextIsTakenWithoutIt) { EXPECT_EQ(s.says("next").step, Step::kGuide); }

TEST_F(TipsSession, ThePointerInTheLandmarkIsThePointers) {
  s.tracker().guide = guide_at(kLandmark + Vec3{0.012, 0, 0}, 0.0);
  s.touches_landmark();
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kGuideTipHeld) << "the guide lay beside it";
}

}  // namespace
}  // namespace orthonav::engine::session_tips_test
