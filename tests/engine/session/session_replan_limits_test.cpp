// How far a screw may be changed in surgery, and what is taken only with consent.
#include <gmock/gmock.h>

#include <cmath>

#include "base/angle.h"
#include "engine/session/text/wording.h"
#include "tests/engine/session/replan_session.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_replan_test {
namespace {

using test::guide_at;
using test::notice_of;
using test::said;
using ::testing::HasSubstr;

/// Tolerance of the search for the least depth on the faces of a box.
constexpr double kSearch_m = 5e-6;

TEST_F(SessionReplan, TheEntryMovesTenMillimetresInAllAndNoMore) {
  s.says("move cranial nine");
  s.says("move cranial one");
  EXPECT_NEAR(s.left().entry.v.z, 10 * kMm, kExact) << "the limit itself";
  const auto* refused = said<ReplanRefusal>(s.says("entry cranial 0.1"));
  ASSERT_NE(refused, nullptr);
  EXPECT_EQ(refused->kind, Kind::kEntryTooFar);
  EXPECT_NEAR(refused->value, 10.1 * kMm, kExact);
  EXPECT_NEAR(s.left().entry.v.z, 10 * kMm, kExact);
  s.says("move caudal five");
  EXPECT_NEAR(s.left().entry.v.z, 5 * kMm, kExact) << "back is always possible";
}

TEST_F(SessionReplan, TheAxisTiltsFifteenDegreesInAllAndNoMore) {
  s.says("tilt cranial nine");
  s.says("tilt cranial six");
  EXPECT_NEAR(nav::tilt_between_rad(s.level().screws[0].preoperative, s.left()),
              15 * kRadiansPerDegree, kExact);
  EXPECT_EQ(s.refusal("tilt cranial 0.1"), Kind::kTiltTooFar);
  EXPECT_THAT(detail_text(s.pair().status), HasSubstr("limit 15.0\u00b0"));
  EXPECT_EQ(s.refusal("target cranial one"), Kind::kTiltTooFar);
  s.says("tilt caudal two");
  EXPECT_NEAR(nav::tilt_between_rad(s.level().screws[0].preoperative, s.left()),
              13 * kRadiansPerDegree, kExact);
}

TEST_F(SessionReplan, SizesAreThoseOfTheList) {
  EXPECT_EQ(s.refusal("screw six thirty two"), Kind::kNoSuchSize);
  EXPECT_THAT(detail_text(s.pair().status), HasSubstr("6.0 \u00d7 32 mm is not in the list"));
  EXPECT_EQ(s.refusal("diameter eight"), Kind::kNoSuchSize);
  EXPECT_EQ(s.refusal("length twenty"), Kind::kNoSuchSize);
  s.says("thinner");
  EXPECT_NEAR(s.left().radius_m, 2.75 * kMm, kExact);
  s.says("thinner");
  s.says("thinner");
  EXPECT_EQ(s.refusal("thinner"), Kind::kLastSize);
  EXPECT_NEAR(s.left().radius_m, 2.25 * kMm, kExact);
}

TEST_F(SessionReplan, AListOfItsOwnAndLimitsAreOptions) {
  SessionOptions options;
  options.replan.sizes = {{{0.006, {0.032}, {}}}};
  options.replan.entry_m = 0.002;
  Replan4 own(options);
  own.guides_left();
  own.says("screw six thirty two");
  EXPECT_NEAR(nav::screw_length_m(own.left()), 32 * kMm, kExact);
  EXPECT_EQ(own.refusal("move cranial three"), Kind::kEntryTooFar);
  options.replan.entry_m = 0.05;
  EXPECT_THAT(options.check(), ::testing::ElementsAre(HasSubstr("replan: entry_m")));
}

TEST_F(SessionReplan, ABreachIsRefusedUntilItIsAccepted) {
  s.says("move lateral nine");
  const auto* refused = said<ReplanRefusal>(s.says("thicker"));
  EXPECT_EQ(refused, nullptr) << "x = 24 + 3.25: still in the bone";
  s.says("tilt lateral nine");
  const Guidance& g = s.pair();
  ASSERT_NE(said<ReplanRefusal>(g), nullptr);
  EXPECT_EQ(said<ReplanRefusal>(g)->kind, Kind::kBreach);
  const double reach_m = 24 * kMm + 35 * kMm * std::sin(9 * kRadiansPerDegree) +
                         3.25 * kMm * std::cos(9 * kRadiansPerDegree);
  EXPECT_NEAR(said<ReplanRefusal>(g)->value, 30 * kMm - reach_m, kSearch_m + 1e-5);
  EXPECT_THAT(detail_text(g.status), HasSubstr("(tip): say accept result to take it"));
  EXPECT_NEAR(nav::tilt_between_rad(s.level().screws[0].preoperative, s.left()), 0.0, kExact)
      << "not before it is accepted";
  const Guidance& taken = s.says("accept");
  ASSERT_NE(said<ScrewReplanned>(taken), nullptr);
  EXPECT_EQ(s.left().accepted_breach, "accepted in surgery");
  EXPECT_NEAR(nav::tilt_between_rad(s.level().screws[0].preoperative, s.left()),
              9 * kRadiansPerDegree, kExact);
  s.says("tilt medial one");
  EXPECT_EQ(s.left().accepted_breach, "accepted in surgery") << "no worse: not asked again";
  EXPECT_EQ(s.refusal("tilt lateral two"), Kind::kBreach) << "worse";
  s.says("undo");
  s.says("undo");
  EXPECT_TRUE(s.left().accepted_breach.empty()) << "with the change its reason goes";
}

TEST_F(SessionReplan, AReasonEndsWithItsBreach) {
  s.says("move lateral nine");
  ASSERT_EQ(s.refusal("tilt lateral nine"), Kind::kBreach);
  s.pair();
  s.says("accept");
  ASSERT_FALSE(s.left().accepted_breach.empty());
  s.says("tilt medial nine");
  EXPECT_TRUE(s.left().accepted_breach.empty());
  EXPECT_EQ(s.refusal("tilt lateral nine"), Kind::kBreach) << "asked anew";
}

TEST_F(SessionReplan, ConsentCountsOnlyForTheQuestionThatIsShown) {
  s.says("move lateral nine");
  const auto breaks = [&] { return s.refusal("tilt lateral nine") == Kind::kBreach; };
  EXPECT_EQ(notice_of(s.says("accept")), Notice::kNotPossibleNow) << "nothing was asked";
  s.hears_at(s.now() + std::chrono::milliseconds(1), "tilt lateral nine");
  s.hears_at(s.now() + std::chrono::milliseconds(2), "accept");
  EXPECT_EQ(notice_of(s.pair()), Notice::kNotPossibleNow) << "said before the question was shown";
  ASSERT_TRUE(breaks());
  s.pairs(100);
  EXPECT_EQ(notice_of(s.says("accept")), Notice::kNotPossibleNow) << "its message is gone";
  ASSERT_TRUE(breaks());
  s.says("twin");
  EXPECT_EQ(notice_of(s.says("accept")), Notice::kNotPossibleNow) << "something else was done";
  ASSERT_TRUE(breaks());
  s.tracker().guide = guide_at(s.left().entry.v, 0.0);
  s.pairs(20);
  EXPECT_EQ(notice_of(s.says("accept")), Notice::kNotPossibleNow) << "the drill is set by now";
  EXPECT_NEAR(nav::tilt_between_rad(s.level().screws[0].preoperative, s.left()), 0.0, kExact);
}

TEST_F(SessionReplan, AQuestionThatWasNeverOnDisplayCannotBeConsentedTo) {
  s.says("move lateral nine");
  s.hears_at(s.now() + std::chrono::milliseconds(1), "tilt lateral nine");
  s.hears_at(s.now() + std::chrono::milliseconds(2), "move cranial");
  EXPECT_EQ(notice_of(s.pair()), Notice::kNotUnderstood) << "in place of the question";
  s.pair();
  EXPECT_EQ(notice_of(s.says("accept")), Notice::kNotPossibleNow);
  EXPECT_NEAR(nav::tilt_between_rad(s.level().screws[0].preoperative, s.left()), 0.0, kExact);
  ASSERT_EQ(s.refusal("tilt lateral nine"), Kind::kBreach);
  s.pair();
  EXPECT_EQ(notice_of(s.says("accept")), Notice::kReplanned) << "the twin, shown";
}

}  // namespace
}  // namespace orthonav::engine::session_replan_test
