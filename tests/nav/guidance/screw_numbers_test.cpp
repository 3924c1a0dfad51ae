#include "nav/guidance/screw_numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"

namespace orthonav::nav::screw_numbers_test {
namespace {

constexpr double kSd = 5.0;  // tenths
constexpr double kUnknown = std::numeric_limits<double>::infinity();

TEST(SteadyNumber, RoundsMagnitudesUp) {
  EXPECT_EQ(SteadyNumber{}.show(12.0, kSd), 12);
  EXPECT_EQ(SteadyNumber{}.show(12.01, kSd), 13) << "never a better number than measured";
  EXPECT_EQ(SteadyNumber{}.show(-12.01, kSd), -13);
  EXPECT_EQ(SteadyNumber{}.show(0.6, kSd), 1);
}

TEST(SteadyNumber, StaysUntilItHasFallenByAnotherTenth) {
  SteadyNumber number;
  EXPECT_EQ(number.show(12.5, kSd), 13);
  EXPECT_EQ(number.show(11.2, kSd), 13) << "within the band";
  EXPECT_EQ(number.show(11.0, kSd), 11) << "below it";
  EXPECT_EQ(number.show(11.1, kSd), 12) << "worse is shown at once";
  EXPECT_EQ(number.show(-11.1, kSd), -12) << "the other way is another number";
}

TEST(SteadyNumber, IsNeverBelowWhatIsMeasuredNorTwoTenthsAbove) {
  Random random(7);
  SteadyNumber number;
  double measured = 20.0;
  for (int i = 0; i < 20000; ++i) {
    measured += random.normal(0.0, 0.7);
    const int shown = number.show(measured, kSd);
    if (shown == 0) {
      EXPECT_LE(std::abs(measured), SteadyNumber::kLeaveZero);
      continue;
    }
    EXPECT_GE(std::abs(shown) + 1e-6, std::abs(measured));
    EXPECT_LT(std::abs(shown), std::abs(measured) + 2.0);
    EXPECT_GT(shown * measured, 0.0) << "the side is as measured";
  }
}

TEST(SteadyNumber, FlickersFarLessThanRoundingAlone) {
  // A tip that trembles by 0.02 mm about a place where rounding changes.
  Random random(3);
  SteadyNumber number;
  int changes = 0;
  int rounding_changes = 0;
  int before = number.show(12.0, kSd);
  int rounded_before = 12;
  for (int i = 0; i < 1000; ++i) {
    const double measured = 12.0 + random.normal(0.0, 0.2);
    const int shown = number.show(measured, kSd);
    const int rounded = static_cast<int>(std::ceil(measured));
    changes += shown != before ? 1 : 0;
    rounding_changes += rounded != rounded_before ? 1 : 0;
    before = shown;
    rounded_before = rounded;
  }
  EXPECT_GT(rounding_changes, 300) << "or this shows nothing";
  EXPECT_LE(changes, 2);
}

TEST(SteadyNumber, IsZeroOnlyWhereItCannotBeToldFromZero) {
  EXPECT_EQ(SteadyNumber{}.show(0.5, kSd), 0);
  EXPECT_EQ(SteadyNumber{}.show(0.5, 0.4), 1) << "known to be more than zero";
  EXPECT_EQ(SteadyNumber{}.show(0.1, kUnknown), 1) << "nobody knows";
  EXPECT_EQ(SteadyNumber{}.show(-0.1, kUnknown), -1);
  SteadyNumber number;
  EXPECT_EQ(number.show(0.3, kSd), 0);
  EXPECT_EQ(number.show(0.9, kSd), 0) << "within the band of zero";
  EXPECT_EQ(number.show(1.1, kSd), 2);
  EXPECT_EQ(number.show(0.9, kSd), 2) << "zero is entered from half a tenth";
}

TEST(SteadyNumber, ForgetsWhatWasShown) {
  SteadyNumber number;
  number.show(13.0, kSd);
  number.forget();
  EXPECT_EQ(number.show(11.5, kSd), 12);
}

TEST(ScrewNumbers, AreGreyedAboveTheirLimitsAndSayTheirSds) {
  AnatomicalDeviation measured;
  measured.tip_cranial_m = {0.00121, kSureOffset_m};
  measured.tip_medial_m = {-0.0008, kSureOffset_m * 1.001};
  measured.aim_cranial_rad = {-2.1 * 10 * kTenth_rad, kSureAngle_rad};
  measured.aim_medial_rad = {0.4 * 10 * kTenth_rad, kUnknown};
  const ScrewNumbers shown = ScrewNumberWriter{}.write(measured);
  EXPECT_EQ(shown.tip_cranial.tenths, 13);
  EXPECT_TRUE(shown.tip_cranial.sure);
  EXPECT_EQ(shown.tip_cranial.sd_tenths, 10);
  EXPECT_EQ(shown.tip_medial.tenths, -8);
  EXPECT_FALSE(shown.tip_medial.sure);
  EXPECT_EQ(shown.tip_medial.sd_tenths, 11) << "rounded up";
  EXPECT_EQ(shown.aim_cranial.tenths, -21);
  EXPECT_TRUE(shown.aim_cranial.sure);
  EXPECT_EQ(shown.aim_medial.tenths, 4);
  EXPECT_FALSE(shown.aim_medial.sure);
  EXPECT_FALSE(shown.aim_medial.sd_tenths.has_value());
}

}  // namespace
}  // namespace orthonav::nav::screw_numbers_test
