#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "nav/evaluation/errors.h"
#include "nav/guidance/predicted_error.h"
#include "nav/published/icp.h"
#include "nav/registration/tre.h"
#include "tests/support/mesh_builder.h"
#include "tests/support/registration_builder.h"

namespace orthonav::nav {
namespace {

using test::digitized;
using ::testing::HasSubstr;

class PredictedError : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    level_ = test::anatomy_level("visible-human/L4");
    if (level_) {
      model_ = VertebraModel::prepare(level_->mesh).value();
    }
  }
  static void TearDownTestSuite() { model_.reset(), level_.reset(); }
  void SetUp() override {
    if (!level_) {
      GTEST_SKIP() << "needs shared/anatomy";
    }
  }
  /// The least-squares pose of the points on the bone.
  Transform<World, Vertebra> fitted(const test::Digitization& d) const {
    return published::refine_icp(model_->reachable_surface(), d.points, d.truth)
        .value()
        .world_from_vertebra;
  }
  static inline std::optional<test::AnatomyLevel> level_;
  static inline std::shared_ptr<const VertebraModel> model_;
};

TEST_F(PredictedError, IsOnTheSafeSide) {
  // Over many registrations the error's RMS stays below what was predicted, and the prediction is
  // not a blanket figure: at most four times the truth.
  double predicted_m2 = 0.0;
  double actual_m2 = 0.0;
  constexpr int kRuns = 12;
  for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
    const auto d = digitized(*level_, 100 + seed);
    const auto pose = fitted(d);
    const auto u = PoseUncertainty::estimate(*model_, pose, d.points);
    ASSERT_TRUE(u.ok());
    for (const ScrewPlan& screw : level_->screws) {
      predicted_m2 += std::pow(u->predicted_tre_m(screw.target), 2);
      actual_m2 += std::pow((pose * screw.target - d.truth * screw.target).norm(), 2);
    }
  }
  EXPECT_LT(actual_m2, predicted_m2);
  EXPECT_LT(predicted_m2, 16.0 * actual_m2);
}

TEST_F(PredictedError, IsKnownAtEachScrew) {
  const auto d = digitized(*level_, 12);
  Registration r;
  r.uncertainty = PoseUncertainty::estimate(*model_, d.truth, d.points).value();
  const auto errors = predicted_errors(r, level_->screws);
  ASSERT_EQ(errors.size(), level_->screws.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_EQ(errors[i].side, level_->screws[i].side);
    EXPECT_EQ(errors[i].entry_m, r.uncertainty->predicted_tre_m(level_->screws[i].entry));
    EXPECT_EQ(errors[i].target_m, r.uncertainty->predicted_tre_m(level_->screws[i].target));
    worst = std::max({worst, errors[i].entry_m, errors[i].target_m});
  }
  EXPECT_EQ(worst_m(errors), worst);
  EXPECT_TRUE(std::isfinite(worst) && worst > 0.0);
}

TEST(PredictedScrewError, IsUnboundedWhereThePointsLeaveAMotionOpen) {
  const std::vector<ScrewPlan> screws(2);
  EXPECT_TRUE(std::isinf(worst_m(predicted_errors(Registration{}, screws))));
  EXPECT_EQ(worst_m(predicted_errors(Registration{}, {})), 0.0);
}

TEST_F(PredictedError, IsLargerFromFewerRegionsAndFartherAway) {
  const auto full = digitized(*level_, 12);
  const auto part = digitized(*level_, 12, {true, false, false});
  const auto u_full = PoseUncertainty::estimate(*model_, full.truth, full.points);
  const auto u_part = PoseUncertainty::estimate(*model_, part.truth, part.points);
  ASSERT_TRUE(u_full.ok() && u_part.ok());
  const Point<Vertebra> target = level_->screws[0].target;
  EXPECT_GT(u_part->predicted_tre_m(target), 1.2 * u_full->predicted_tre_m(target));
  EXPECT_GT(u_full->predicted_tre_m(target - Vec3{0, 0.1, 0}), u_full->predicted_tre_m(target));
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

TEST(PoseUncertainty, RefusesASurfaceThatLeavesAMotionOpen) {
  const auto model = VertebraModel::prepare(test::box({-0.04, -0.03, -0.02}, {0.04, 0.03, 0.02}));
  ASSERT_TRUE(model.ok());
  std::vector<Point<World>> plane;  // all on the back face: free to slide
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      plane.push_back({{-0.03 + 0.003 * i, 0.0301, -0.01 + 0.001 * j}});
    }
  }
  const auto u = PoseUncertainty::estimate(**model, {}, plane);
  ASSERT_FALSE(u.ok());
  EXPECT_THAT(u.error().message, HasSubstr("leave a motion of the bone open"));
  EXPECT_FALSE(PoseUncertainty::estimate(**model, {}, std::span(plane).first(6)).ok());
}

}  // namespace
}  // namespace orthonav::nav
