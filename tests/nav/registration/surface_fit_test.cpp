#include "nav/registration/search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/slab_bone.h"

namespace orthonav::nav {
namespace {

using test::apart_m;
using test::CentredPoints;

/// Without noise nothing is left but rounding and the last step.
constexpr double kExact_m = 1e-6;
/// What a search leaves.
constexpr double kStartTranslation_m = 0.002;
constexpr double kStartRotation_rad = 0.05;
constexpr int kStarts = 6;

SurfaceFitOptions to_the_end() {
  SurfaceFitOptions options;
  options.max_iterations = 60;
  options.last_step_m = 1e-10;
  return options;
}

class SurfaceFitTest : public ::testing::Test {
 protected:
  /// The largest error from several starts.
  double worst_m(const std::vector<Vec3>& in_vertebra, const SurfaceFitOptions& options,
                 double translation_m = kStartTranslation_m) const {
    double worst = 0.0;
    for (std::uint64_t seed = 0; seed < kStarts; ++seed) {
      Random random(seed);
      const CentredPoints cloud = test::centred_somewhere(in_vertebra, random);
      const CentredPose start = test::moved(cloud.truth, translation_m, kStartRotation_rad, random);
      const auto fit = fit_to_surface(surface_, cloud.points_m, start, options);
      if (!fit) {
        return 1.0;
      }
      worst = std::max(worst, apart_m(fit->pose, cloud.truth));
    }
    return worst;
  }
  const TriangleMesh mesh_ = test::slab_bone(test::crooked_back);
  const SurfaceIndex surface_{mesh_};
  const std::vector<Vec3> places_ = test::strokes_over(surface_, 8);
};

TEST_F(SurfaceFitTest, IsExactOnPointsWithoutNoise) {
  EXPECT_LT(worst_m(places_, to_the_end()), kExact_m);
  // As the options are by default it stops when a step is 10 um: then less than that is left.
  EXPECT_LT(worst_m(places_, {}), 1e-5);
}

TEST_F(SurfaceFitTest, EndsAtTheSamePoseFromWhereverItStarts) {
  Random random(9);
  std::vector<Vec3> noisy = places_;
  for (Vec3& p : noisy) {
    p += Vec3{random.normal(0, 0.0004), random.normal(0, 0.0004), random.normal(0, 0.0004)};
  }
  const CentredPoints cloud = test::centred_somewhere(noisy, random);
  const auto once = fit_to_surface(surface_, cloud.points_m, cloud.truth, to_the_end());
  ASSERT_TRUE(once.has_value());
  EXPECT_GT(apart_m(once->pose, cloud.truth), 1e-5) << "noise moves it: the start is not the end";
  for (int i = 0; i < kStarts; ++i) {
    const auto again = fit_to_surface(
        surface_, cloud.points_m,
        test::moved(cloud.truth, kStartTranslation_m, kStartRotation_rad, random), to_the_end());
    ASSERT_TRUE(again.has_value());
    EXPECT_LT(apart_m(again->pose, once->pose), kExact_m);
    EXPECT_NEAR(again->noise_m, 0.0004, 0.00006) << "along the normal, as along any axis";
  }
}

TEST_F(SurfaceFitTest, IgnoresOneInEightPointsOffTheBone) {
  Random random(12);
  std::vector<Vec3> soiled = places_;
  for (Vec3& p : soiled) {
    if (random.uniform() < 0.12) {
      p.y += random.uniform(0.0015, 0.010);
    }
  }
  EXPECT_LT(worst_m(soiled, to_the_end()), kExact_m);
  // Least squares, which weigh every point alike, do not: the outliers are there.
  SurfaceFitOptions plain = to_the_end();
  plain.least_noise_m = plain.most_noise_m = 1.0;
  plain.farthest_m = 0.02;
  EXPECT_GT(worst_m(soiled, plain), 0.0003);
}

TEST_F(SurfaceFitTest, CountsOutliersAsNoneAndLeavesTheRestTheirWeight) {
  Random random(13);
  std::vector<Vec3> soiled = places_;
  std::vector<bool> off;
  for (Vec3& p : soiled) {
    p += Vec3{random.normal(0, 0.0001), random.normal(0, 0.0001), random.normal(0, 0.0001)};
    off.push_back(random.uniform() < 0.12);
    if (off.back()) {
      p.y += random.uniform(0.004, 0.010);
    }
  }
  const CentredPoints cloud = test::centred_somewhere(soiled, random);
  const auto fit = fit_to_surface(surface_, cloud.points_m, cloud.truth, {});
  ASSERT_TRUE(fit.has_value());
  ASSERT_EQ(fit->points.size(), soiled.size());
  for (std::size_t i = 0; i < soiled.size(); ++i) {
    const FittedPoint& p = fit->points[i];
    // Beside a steep flank 4 mm upwards may be less than 1 mm away.
    if (off[i] && p.residual_m > 0.001) {
      EXPECT_EQ(p.weight, 0.0) << i;
    }
    if (!off[i]) {
      // Three SDs leave (1 - (3 / 4.685)^2)^2; the least noise that is reckoned with is larger.
      EXPECT_GT(p.weight, 0.35) << i;
    }
    EXPECT_LT(p.residual_m, SurfaceFitOptions().farthest_m + 1e-9);
  }
}

TEST_F(SurfaceFitTest, TakesTheTipsRadiusIntoAccount) {
  constexpr double kRadius_m = 0.0015;
  std::vector<Vec3> centres;
  for (const Vec3& p : places_) {
    const Vec3 centre = p + kRadius_m * surface_.nearest(p)->normal;
    // In a hollow the ball would touch elsewhere.
    if (std::abs(surface_.nearest(centre)->distance_m - kRadius_m) < 1e-9) {
      centres.push_back(centre);
    }
  }
  ASSERT_GT(centres.size(), places_.size() / 3);
  SurfaceFitOptions ball = to_the_end();
  ball.tip_radius_m = kRadius_m;
  EXPECT_LT(worst_m(centres, ball), kExact_m);
  EXPECT_GT(worst_m(centres, to_the_end()), 0.5 * kRadius_m) << "without it they lie too high";
}

TEST_F(SurfaceFitTest, IsNothingForTooFewPointsOrPointsFarAway) {
  const CentredPose pose;
  EXPECT_FALSE(fit_to_surface(surface_, {}, pose, {}).has_value());
  EXPECT_FALSE(fit_to_surface(surface_, std::vector<Vec3>(5), pose, {}).has_value());
  EXPECT_FALSE(
      fit_to_surface(surface_, std::vector<Vec3>(50, Vec3{1, 1, 1}), pose, {}).has_value());
}

TEST_F(SurfaceFitTest, NeverBecomesAMirrorImage) {
  Random random(21);
  std::vector<Vec3> mirrored = places_;
  for (Vec3& p : mirrored) {
    p.x = -p.x;
  }
  const CentredPoints cloud = test::centred_somewhere(mirrored, random);
  const auto fit = fit_to_surface(surface_, cloud.points_m, cloud.truth, to_the_end());
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(fit->pose.rotation.determinant(), 1.0, 1e-12);
  EXPECT_GT(truncated_cost_m2(*fit, 0.002), 1e-7) << "RMS 0.3 mm: it does not fit";
}

}  // namespace
}  // namespace orthonav::nav
