#include <gtest/gtest.h>

#include <cmath>

#include "nav/guidance/predicted_error.h"
#include "nav/registration/tre.h"

namespace orthonav::nav {
namespace {

TEST(PredictedScrewError, IsKnownAtEachScrew) {
  std::vector<ScrewPlan> screws = {
      {Side::kLeft, {{0.015, 0.020, 0.0}}, {{0.012, -0.015, 0.004}}},
      {Side::kRight, {{-0.015, 0.020, 0.0}}, {{-0.012, -0.018, 0.004}}}};
  std::array<double, 36> covariance{};
  for (std::size_t k = 0; k < 3; ++k) {
    covariance[7 * k] = 1e-7;                                     // shifts of 0.3 mm
    covariance[7 * (k + 3)] = 1e-4 * static_cast<double>(k + 1);  // turns of 0.6° and more
  }
  Registration r;
  r.uncertainty = PoseUncertainty({0.0, 0.010, 0.0}, covariance);
  const auto errors = predicted_errors(r, screws);
  ASSERT_EQ(errors.size(), screws.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_EQ(errors[i].side, screws[i].side);
    EXPECT_EQ(errors[i].entry_m, r.uncertainty->predicted_tre_m(screws[i].entry));
    EXPECT_EQ(errors[i].target_m, r.uncertainty->predicted_tre_m(screws[i].target));
    EXPECT_GT(errors[i].target_m, errors[i].entry_m) << "farther from where it turns";
  }
  EXPECT_EQ(worst_m(errors), errors[1].target_m);
}

TEST(PredictedScrewError, IsUnboundedWhereThePointsLeaveAMotionOpen) {
  const std::vector<ScrewPlan> screws(2);
  EXPECT_TRUE(std::isinf(worst_m(predicted_errors(Registration{}, screws))));
  EXPECT_EQ(worst_m(predicted_errors(Registration{}, {})), 0.0);
}

TEST(PoseUncertainty, ATurnAboutAPlaceMovesWhatLiesBesideIt) {
  const Vec3 centre{0.01, -0.02, 0.03};
  const Vec3 axis = Vec3{1.0, -2.0, 0.5}.normalized();
  const Point<Vertebra> about{{0.02, 0.0, 0.01}};
  constexpr double kRotation_rad = 0.01;
  const PoseUncertainty rotated =
      with_turn(PoseUncertainty(centre, {}), about, axis, kRotation_rad);
  constexpr double kBits = 1e-10;  ///< the root of what a double leaves of the variance
  EXPECT_NEAR(rotated.predicted_tre_m(about), 0.0, kBits);
  EXPECT_NEAR(rotated.predicted_tre_m(about + 0.05 * axis), 0.05 * kRotation_rad * std::sqrt(2.0),
              kBits)
      << "along the axis, in both directions across it";
  const Vec3 across = axis.cross(Vec3{0, 0, 1}).normalized();
  EXPECT_NEAR(rotated.predicted_tre_m(about + 0.05 * across), 0.05 * kRotation_rad, kBits)
      << "beside it only along it: it does not turn about the axis itself";
}

TEST(WithTool, MovesTheToolsCovarianceToTheBonesCentre) {
  // The tool turns by 0.01 rad about World's z at a marker 0.2 m along World's x; World's x is the
  // vertebra's y.
  const Transform<Vertebra, World> vertebra_from_world{
      rotation_from_vector({0, 0, std::acos(-1.0) / 2}), {0.1, 0.2, 0.3}};
  const Point<World> marker{{0.2, 0, 0}};
  PoseCovariance tool{};
  tool[35] = 1e-4;
  tool[0] = 4e-8;
  const PoseUncertainty bone({0.1, 0.2, 0.3}, {});  // World's origin
  const PoseUncertainty both =
      with_tool(bone, vertebra_from_world, vertebra_from_world * marker, tool);
  // At World's origin: 0.2 m × 0.01 rad across, World's y, that is the vertebra's -x.
  const auto at_origin = both.covariance_at({{0.1, 0.2, 0.3}});
  EXPECT_NEAR(at_origin[0], 0.04 * 1e-4, 1e-12);
  EXPECT_NEAR(at_origin[4], 4e-8, 1e-12);
  EXPECT_NEAR(at_origin[8], 0.0, 1e-12);
  // At the marker the rotation has no effect.
  const auto at_marker = both.covariance_at(vertebra_from_world * marker);
  EXPECT_NEAR(at_marker[0], 0.0, 1e-12);
  EXPECT_NEAR(at_marker[4], 4e-8, 1e-12);
}

}  // namespace
}  // namespace orthonav::nav
