#include <gtest/gtest.h>

#include <limits>

#include "engine/session/coach.h"
#include "engine/session/text/wording.h"
#include "tests/engine/session/promising_registration.h"

namespace orthonav::engine::coach_test {
namespace {

TEST(Coaching, SaysWhatToExpectAndWhereToStroke) {
  nav::Registration r = promising();
  EXPECT_EQ(text_of(coaching_from(r)), "◆◆◆◇◇ digitize the left lamina");
  r.predicted_tre_m = std::numeric_limits<double>::infinity();
  EXPECT_EQ(text_of(coaching_from(r)), "◇◇◇◇◇ digitize the left lamina");
}

TEST(Coaching, SaysWhenItIsEnough) {
  nav::Registration r = promising();
  r.accepted = true;
  r.reasons.clear();
  r.predicted_tre_m = 0.0006;
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
  EXPECT_EQ(text_of(coaching_from(r)), "◆◆◇◇◇ digitize the left lamina");
}

TEST(Coaching, PromisesNoErrorOfAPoseThatMayBeTheWrongOne) {
  nav::Registration r = promising();
  r.reasons = {{nav::RefusalReason::Kind::kLogLikelihoodRatio, 3.0, 12.0, {}, {}}};
  r.predicted_tre_m = 0.0006;
  EXPECT_EQ(text_of(coaching_from(r)), "◇◇◇◇◇ digitize the left lamina");
}

TEST(Coaching, SaysWhatElseStandsAgainstASmallError) {
  nav::Registration r = promising();
  r.predicted_tre_m = 0.0006;
  r.reasons = {{nav::RefusalReason::Kind::kNoise, 0.0019, 0.0016, {}, {}}};
  EXPECT_EQ(text_of(coaching_from(r)),
            "◆◆◆◆◇ the points scatter 1.9 mm about the surface, "
            "limit 1.6 mm");
}

}  // namespace
}  // namespace orthonav::engine::coach_test
