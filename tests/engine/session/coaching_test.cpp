#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/session/coach.h"
#include "engine/session/text/wording.h"
#include "tests/engine/session/promising_registration.h"

namespace orthonav::engine::coach_test {
namespace {

TEST(Coaching, SaysWhatToExpectAndWhereToStroke) {
  nav::Registration r = promising();
  EXPECT_EQ(text_of(coaching_from(r)), "◆◆◆◇◇ digitize the left lamina");
  r.tre_99_m = std::numeric_limits<double>::infinity();
  EXPECT_EQ(text_of(coaching_from(r)), "◇◇◇◇◇ digitize the left lamina");
}

TEST(Coaching, SaysWhenItIsEnough) {
  nav::Registration r = promising();
  r.accepted = true;
  r.reasons.clear();
  r.tre_99_m = 0.0012;
  EXPECT_EQ(text_of(coaching_from(r)), "◆◆◆◆◆ enough: double click");
}

TEST(Coaching, SendsWhoStrokesOverTissueToTheBone) {
  nav::Registration r = promising();
  r.provisional = true;
  EXPECT_FALSE(coaching_from(r).enough) << "more strokes would help";
  r.reasons.push_back({nav::RefusalReason::Kind::kSoftTissue, 0.001, 0.0003});
  EXPECT_EQ(text_of(coaching_from(r)), "◆◆◆◆◆ double click, touch the bone");
}

TEST(Coaching, AddsWhatAllStrokesShare) {
  nav::Registration r = promising();
  r.common.tip_m = 0.001;
  EXPECT_DOUBLE_EQ(coaching_from(r).expected_m, std::hypot(0.0024, std::sqrt(3.0) * 0.001));
  EXPECT_FALSE(coaching_from(r).registration_only);
  // More strokes don't make it smaller: progress is that of the registration.
  EXPECT_EQ(text_of(coaching_from(r)), "◆◆◆◇◇ digitize the left lamina");
}

TEST(Coaching, PromisesNoErrorOfAPoseThatMayBeTheWrongOne) {
  nav::Registration r = promising();
  r.reasons = {{nav::RefusalReason::Kind::kLogLikelihoodRatio, 3.0, 4.6, {}, {}}};
  r.tre_99_m = 0.0012;
  EXPECT_EQ(text_of(coaching_from(r)), "◇◇◇◇◇ digitize the left lamina");
}

TEST(Coaching, SaysWhatElseStandsAgainstASmallError) {
  nav::Registration r = promising();
  r.tre_99_m = 0.0012;
  r.reasons = {{nav::RefusalReason::Kind::kNoise, 0.0019, 0.0016, {}, {}}};
  EXPECT_EQ(text_of(coaching_from(r)),
            "◆◆◆◆◇ the points scatter 1.9 mm about the surface, "
            "limit 1.6 mm");
}

}  // namespace
}  // namespace orthonav::engine::coach_test
