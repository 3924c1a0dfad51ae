// Blur of a swinging tag, told pair by pair.
#include "nav/tracking/tool_follower.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"

namespace orthonav::nav {
namespace {

constexpr double kPair_s = 1.0 / 30.0;
constexpr double kUsual_s = 0.005;

/// A tag whose cells are six pixels wide and turned, swinging by `amplitude_px`.
BlurSighting swinging(int k, double amplitude_px, double exposure_s, Random& random) {
  const double t = k * kPair_s;
  const double speed = 4.0 * amplitude_px * std::cos(4.0 * t);
  const Vec2 along{std::cos(0.6), std::sin(0.6)};
  BlurSighting s;
  s.time = Timestamp(from_seconds(1.0 + t));
  s.centre_px = Vec2{300.0, 200.0} + amplitude_px * std::sin(4.0 * t) * along;
  s.column_px = {6.0 * std::cos(0.2), 6.0 * std::sin(0.2)};
  s.row_px = {-6.0 * std::sin(0.2), 6.0 * std::cos(0.2)};
  const auto blur = [&](double part) {
    const double lens_px2 = 0.6 * 0.6;
    const double motion_px2 = std::pow(part * speed * exposure_s, 2) / 12.0;
    return std::sqrt(lens_px2 + motion_px2) / 6.0 + random.normal(0.0, 0.002);
  };
  s.blur_cells = {blur(std::cos(0.4)), blur(std::sin(0.4))};
  return s;
}

double estimated_s(double amplitude_px, double exposure_s) {
  ExposureEstimator estimator;
  Random random(3);
  for (int k = 0; k < 90; ++k) {
    estimator.add(swinging(k, amplitude_px, exposure_s, random));
  }
  return estimator.exposure_s();
}

TEST(ExposureEstimator, IsToldByTheBlurOfMotion) {
  for (const double exposure_s : {0.002, 0.004, 0.010, 0.020}) {
    EXPECT_NEAR(estimated_s(120.0, exposure_s), exposure_s, 0.001) << exposure_s;
  }
}

TEST(ExposureEstimator, StaysAtTheUsualWhereNothingMoves) {
  EXPECT_EQ(ExposureEstimator().exposure_s(), kUsual_s);
  EXPECT_NEAR(estimated_s(0.0, 0.020), kUsual_s, 1e-6);
}

TEST(ExposureEstimator, BelievesNoGapNoOtherTagAndNoNonsense) {
  Random random(3);
  ExposureEstimator gaps;
  ExposureEstimator other;
  ExposureEstimator nonsense;
  for (int k = 0; k < 90; ++k) {
    BlurSighting s = swinging(k, 120.0, 0.020, random);
    s.time = Timestamp(from_seconds(1.0 + 0.1 * k));
    gaps.add(s);
    s = swinging(k, 120.0, 0.020, random);
    s.view = static_cast<std::size_t>(k % 2);
    other.add(s);
    s = swinging(k, 120.0, 0.020, random);
    s.row_px = s.column_px;
    if (k % 3 == 0) {
      s.centre_px.x = std::numeric_limits<double>::quiet_NaN();
    }
    nonsense.add(s);
  }
  EXPECT_EQ(gaps.exposure_s(), kUsual_s);
  EXPECT_EQ(other.exposure_s(), kUsual_s);
  EXPECT_EQ(nonsense.exposure_s(), kUsual_s);
}

TEST(ExposureEstimator, FollowsTheLight) {
  ExposureEstimator estimator;
  Random random(3);
  for (int k = 0; k < 300; ++k) {
    estimator.add(swinging(k, 120.0, 0.004, random));
  }
  for (int k = 300; k < 900; ++k) {
    estimator.add(swinging(k, 120.0, 0.012, random));
  }
  EXPECT_NEAR(estimator.exposure_s(), 0.012, 0.001);
}

}  // namespace
}  // namespace orthonav::nav
