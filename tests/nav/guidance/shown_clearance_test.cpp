#include "nav/guidance/shown_clearance.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace orthonav::nav::shown_clearance_test {
namespace {

TEST(SteadyLeast, RoundsDownAndRisesOnlyByAnotherTenth) {
  EXPECT_EQ(SteadyLeast{}.show(12.0), 12);
  EXPECT_EQ(SteadyLeast{}.show(12.9), 12) << "never a better number than measured";
  EXPECT_EQ(SteadyLeast{}.show(-0.1), -1) << "a breach is none too small";
  SteadyLeast number;
  EXPECT_EQ(number.show(12.5), 12);
  EXPECT_EQ(number.show(13.9), 12) << "within the band";
  EXPECT_EQ(number.show(14.0), 14) << "above it";
  EXPECT_EQ(number.show(13.9), 13) << "worse is shown at once";
  number.forget();
  EXPECT_EQ(number.show(13.9), 13);
}

TEST(SteadyLeast, IsNeverAboveWhatIsMeasuredNorTwoTenthsBelow) {
  Random random(5);
  SteadyLeast number;
  double measured = 10.0;
  for (int i = 0; i < 20000; ++i) {
    measured += random.normal(0.0, 0.7);
    const int shown = number.show(measured);
    EXPECT_LE(shown, measured + 1e-6);
    EXPECT_GT(shown, measured - 2.0);
  }
}

TEST(ShownClearance, SaysWhereTheScrewMayBreakThrough) {
  ScrewClearance measured;
  measured.least.clearance_m = 0.00243;
  measured.least.outward = {-1, 0, 0};
  measured.spread = ClearanceSpread{0.00117, {}};
  const ShownClearance within = ClearanceWriter{}.write(measured, Side::kLeft);
  EXPECT_EQ(within.least_tenths, 24);
  EXPECT_EQ(within.lower_95_tenths, 11);
  EXPECT_STREQ(within.towards, "medial");
  EXPECT_FALSE(within.may_break());
  measured.spread->lower_95_m = -0.00001;
  EXPECT_TRUE(ClearanceWriter{}.write(measured, Side::kLeft).may_break());
  measured.spread.reset();
  const ShownClearance unknown = ClearanceWriter{}.write(measured, Side::kRight);
  EXPECT_FALSE(unknown.lower_95_tenths.has_value());
  EXPECT_STREQ(unknown.towards, "lateral");
  EXPECT_FALSE(unknown.may_break());
  measured.least.clearance_m = -0.0004;
  EXPECT_TRUE(ClearanceWriter{}.write(measured, Side::kLeft).may_break());
}

}  // namespace
}  // namespace orthonav::nav::shown_clearance_test
