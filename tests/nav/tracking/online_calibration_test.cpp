#include "nav/tracking/online_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Dense>
#include <limits>

#include "base/random.h"

namespace orthonav::nav {
namespace {

using Unknowns = Eigen::Matrix<double, 6, 1>;
using Square = Eigen::Matrix<double, 6, 6>;

/// Pairs of a linear world: every pair measures the unknowns along random directions, with errors
/// of one.
class LinearWorld {
 public:
  explicit LinearWorld(std::vector<Unknowns> truth) : left_(std::move(truth)) {}

  /// The remaining correction once `by` was corrected for a tool.
  void correct(std::size_t tool, const Unknowns& by) { left_[tool] -= by; }
  CalibrationEquations pair(std::size_t tool) {
    CalibrationEquations out;
    Eigen::Map<Square> information(out.information.data());
    Eigen::Map<Unknowns> right(out.right.data());
    information.setZero();
    right.setZero();
    for (int row = 0; row < 9; ++row) {
      Unknowns j;
      for (int k = 0; k < 6; ++k) {
        j(k) = random_.normal(0.0, kSensitivity);
      }
      const double seen = j.dot(left_[tool]) + random_.normal(0.0, 1.0);
      information += j * j.transpose();
      right += seen * j;
    }
    return out;
  }

 private:
  static constexpr double kSensitivity = 3000.0;
  std::vector<Unknowns> left_;
  Random random_{7};
};

Unknowns unknowns(double x, double y, double z, double focal, double baseline, double size) {
  Unknowns out;
  out << x, y, z, focal, baseline, size;
  return out;
}

/// Runs both tools; returns how often it corrected.
int run(OnlineCalibration& calibration, LinearWorld& world, int pairs) {
  int corrections = 0;
  for (int i = 0; i < pairs; ++i) {
    for (std::size_t tool = 0; tool < 2; ++tool) {
      calibration.add(tool, world.pair(tool));
    }
    const std::array<double, 2> before = {calibration.size_factor(0), calibration.size_factor(1)};
    if (calibration.correct()) {
      ++corrections;
      const Vec3 rotation_rad = calibration.rotation_rad();
      for (std::size_t tool = 0; tool < 2; ++tool) {
        world.correct(tool, unknowns(rotation_rad.x, rotation_rad.y, rotation_rad.z, 0, 0,
                                     std::log(calibration.size_factor(tool) / before[tool])));
      }
    }
  }
  return corrections;
}

TEST(OnlineCalibration, FindsRotationAndSizes) {
  LinearWorld world({unknowns(0.001, -0.002, 0.0005, 0.0005, -0.001, 0.004),
                     unknowns(0.001, -0.002, 0.0005, 0.0005, -0.001, -0.002)});
  OnlineCalibration calibration(2);
  EXPECT_GE(run(calibration, world, 400), 1);
  const auto found = calibration.alignment();
  ASSERT_TRUE(found.has_value());
  EXPECT_TRUE(found->applied && found->significant && found->within_bounds);
  EXPECT_NEAR(found->rotation_rad.x, 0.001, 4 * found->sd_rad.x);
  EXPECT_NEAR(found->rotation_rad.y, -0.002, 4 * found->sd_rad.y);
  EXPECT_NEAR(found->focal_fraction, 0.0005, 4 * found->focal_sd);
  EXPECT_NEAR(found->baseline_fraction, -0.001, 4 * found->baseline_sd);
  constexpr double kSizeSd = 0.0005;
  EXPECT_NEAR(std::log(calibration.size_factor(0)), 0.004, 0.0004 + 4 * kSizeSd);
  EXPECT_NEAR(std::log(calibration.size_factor(1)), -0.002, 0.0004 + 4 * kSizeSd);
  const double apart = std::log(calibration.size_factor(0) / calibration.size_factor(1));
  EXPECT_NEAR(apart, 0.006, 0.0004 + 4 * calibration.size_difference_sd(0, 1));
  EXPECT_LT(calibration.size_difference_sd(0, 1), kSizeSd);
}

TEST(OnlineCalibration, LeavesWhatIsRightAlone) {
  LinearWorld world({Unknowns::Zero(), Unknowns::Zero()});
  OnlineCalibration calibration(2);
  EXPECT_EQ(run(calibration, world, 400), 0);
  EXPECT_EQ(calibration.size_factor(0), 1.0);
  EXPECT_FALSE(calibration.alignment()->significant);
}

TEST(OnlineCalibration, NeverGoesBeyondItsLimits) {
  LinearWorld wrong_print({unknowns(0, 0, 0, 0, 0, 0.04), Unknowns::Zero()});
  OnlineCalibration sizes(2);
  EXPECT_EQ(run(sizes, wrong_print, 400), 0);
  LinearWorld other_device({unknowns(0, 0.02, 0, 0, 0, 0), unknowns(0, 0.02, 0, 0, 0, 0)});
  OnlineCalibration cameras(2);
  EXPECT_EQ(run(cameras, other_device, 400), 0);
  EXPECT_FALSE(cameras.alignment()->within_bounds);
}

TEST(OnlineCalibration, SaysNothingOfWhatWasNotSeen) {
  OnlineCalibration calibration(2);
  EXPECT_FALSE(calibration.alignment());
  EXPECT_FALSE(calibration.correct());
  LinearWorld world({unknowns(0.001, -0.002, 0.0005, 0, 0, 0.004), Unknowns::Zero()});
  for (int i = 0; i < 400; ++i) {
    calibration.add(0, world.pair(0));
  }
  EXPECT_GE(calibration.size_difference_sd(0, 1), CalibrationOptions{}.size_sd);
  EXPECT_EQ(calibration.size_difference_sd(1, 1), 0.0);
}

TEST(OnlineCalibration, PassesOverEquationsThatAreNoNumbers) {
  LinearWorld world({unknowns(0.001, 0, 0, 0, 0, 0), unknowns(0.001, 0, 0, 0, 0, 0)});
  OnlineCalibration calibration(2);
  CalibrationEquations broken;
  broken.information[7] = std::numeric_limits<double>::quiet_NaN();
  calibration.add(0, broken);
  EXPECT_FALSE(calibration.alignment());
  EXPECT_GE(run(calibration, world, 200), 1);
  EXPECT_TRUE(std::isfinite(calibration.size_factor(0)));
}

}  // namespace
}  // namespace orthonav::nav
