#include "nav/guidance/screw_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
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

ShownDepth written(double depth_m, double to_target_m, double sd_m = 0.0004) {
  return DepthWriter().write({depth_m, sd_m}, to_target_m).value();
}

TEST(DepthWriter, CountsToTheEntryThenToTheTargetThenPastIt) {
  EXPECT_EQ(written(-0.0123, 0.0573).to, DepthTo::kEntry);
  EXPECT_EQ(written(-0.0123, 0.0573).tenths, 123);
  EXPECT_EQ(written(0.0, 0.045).to, DepthTo::kTarget);
  EXPECT_EQ(written(0.0, 0.045).tenths, 450);
  EXPECT_EQ(written(0.0462, -0.0012).to, DepthTo::kPastTarget);
  EXPECT_EQ(written(0.0462, -0.0012).tenths, 12);
}

TEST(DepthWriter, NeverShowsTheTipShortOfWhereItIsNorTwoTenthsDeeper) {
  constexpr double kLength_m = 0.04503;
  Random random(11);
  DepthWriter writer;
  double depth_m = -0.004;
  for (int i = 0; i < 20000; ++i) {
    depth_m = std::clamp(depth_m + random.normal(1e-6, 7e-5), -0.01, 0.05);
    const ShownDepth shown = writer.write({depth_m, 0.0004}, kLength_m - depth_m).value();
    const double sign = shown.to == DepthTo::kPastTarget ? 1.0 : -1.0;
    const double from_m = shown.to == DepthTo::kEntry ? 0.0 : kLength_m;
    const double shown_m = from_m + sign * shown.tenths * kTenth_m;
    EXPECT_GE(shown_m, depth_m - 1e-9);
    EXPECT_LT(shown_m, depth_m + 2.0 * kTenth_m);
    EXPECT_GE(shown.tenths, 0);
  }
}

TEST(DepthWriter, ATremblingTipMovesNoDigit) {
  DepthWriter writer;
  int changes = -1;
  int before = -1;
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const double depth_m = 0.010 + random.normal(0.0, 2e-5);
    const int tenths = writer.write({depth_m, 0.0004}, 0.045 - depth_m)->tenths;
    changes += tenths == before ? 0 : 1;
    before = tenths;
  }
  EXPECT_LE(changes, 2);
}

TEST(DepthWriter, IsItsDeeperBoundWhereItIsNotSureAndRefusesWhatIsNoDepth) {
  EXPECT_EQ(written(0.01, 0.03, 0.0010).certainty, Certainty::kSure);
  EXPECT_EQ(written(0.01, 0.03, 0.0010).tenths, 300);
  EXPECT_EQ(written(0.01, 0.03, 0.0014).certainty, Certainty::kBound);
  EXPECT_EQ(written(0.01, 0.03, 0.0014).tenths, 276) << "30 mm less 1.645 SDs, rounded deeper";
  EXPECT_EQ(written(0.04, 0.001, 0.0014).to, DepthTo::kPastTarget) << "it may be past it";
  EXPECT_EQ(written(0.01, 0.03, kUnknown).certainty, Certainty::kUnknown);
  EXPECT_EQ(written(0.01, 0.03, kUnknown).tenths, 300);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(DepthWriter().write({nan, 0.0004}, 0.03).has_value());
  EXPECT_FALSE(DepthWriter().write({0.01, 0.0004}, kUnknown).has_value());
  EXPECT_FALSE(DepthWriter().write({-2.0, 0.0004}, 2.05).has_value());
}

TEST(ScrewSizeWriter, ShowsSizesAsMeasuredOrTheirBounds) {
  const auto written_sizes = [](double angle_rad, double offset_m, double angle_sd_rad,
                                double offset_sd_m) {
    return ScrewSizeWriter().write({angle_rad, angle_sd_rad}, {offset_m, offset_sd_m});
  };
  const ScrewSizes sure = written_sizes(0.0209, 0.00041, 0.005, 0.0004);
  EXPECT_EQ(sure.angle.tenths, 12) << "1.197 degrees, rounded up";
  EXPECT_EQ(sure.angle.certainty, Certainty::kSure);
  EXPECT_EQ(sure.offset.tenths, 5);
  const ScrewSizes unsure = written_sizes(0.0209, 0.00041, 0.03, 0.0014);
  EXPECT_EQ(unsure.angle.certainty, Certainty::kBound);
  EXPECT_EQ(unsure.angle.tenths, 55) << "1.197 degrees and 2.448 SDs";
  EXPECT_EQ(unsure.offset.tenths, 39);
  EXPECT_EQ(written_sizes(0.0209, 0.00041, kUnknown, kUnknown).offset.certainty,
            Certainty::kUnknown);
  EXPECT_EQ(written_sizes(0.0209, 0.00041, kUnknown, kUnknown).offset.tenths, 5);
}

TEST(ScrewSizeWriter, HasABoundThatHoldsNineteenTimesInTwenty) {
  // A true offset and a measured one with an error of that SD along each of two axes.
  constexpr double kSd_m = 0.0015;
  for (const double true_m : {0.0, 0.001, 0.004}) {
    Random random(7);
    int holds = 0;
    for (int i = 0; i < 4000; ++i) {
      const double measured_m =
          std::hypot(true_m + random.normal(0.0, kSd_m), random.normal(0.0, kSd_m));
      const ShownSize shown = ScrewSizeWriter().write({0.0, 0.0}, {measured_m, kSd_m}).offset;
      holds += shown.tenths * kTenth_m >= true_m ? 1 : 0;
    }
    EXPECT_GT(holds, 3800) << true_m;
  }
}

}  // namespace
}  // namespace orthonav::nav::screw_numbers_test
