#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <vector>

#include "base/random.h"
#include "nav/geometry/absolute_orientation.h"

namespace orthonav::nav {
namespace {

using ::testing::HasSubstr;

// Points of 0.1 m in double precision: 1e-15 relative, amplified by the eigenvalue gap.
constexpr double kExactM = 1e-12;
constexpr double kExactRad = 1e-10;

Vec3 random_vector(Random& random, double half) {
  return {random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
}

std::vector<Vec3> random_points(Random& random, std::size_t count) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back(random_vector(random, 0.1));
  }
  return points;
}

std::vector<Vec3> moved(const std::vector<Vec3>& points, const Mat3& rotation, Vec3 translation) {
  std::vector<Vec3> out;
  for (const Vec3& p : points) {
    out.push_back(rotation * p + translation);
  }
  return out;
}

double rmse_by_svd(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  const auto n = static_cast<Eigen::Index>(from.size());
  Eigen::Matrix3Xd a(3, n);
  Eigen::Matrix3Xd b(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    a.col(i) << from[k].x, from[k].y, from[k].z;
    b.col(i) << to[k].x, to[k].y, to[k].z;
  }
  const Eigen::Matrix4d t = Eigen::umeyama(a, b, false);
  const Eigen::Matrix3Xd left =
      ((t.topLeftCorner<3, 3>() * a).colwise() + t.topRightCorner<3, 1>()) - b;
  return std::sqrt(left.squaredNorm() / static_cast<double>(n));
}

TEST(AbsoluteOrientation, RecoversRandomRigidMotions) {
  Random random(1);
  for (int trial = 0; trial < 1000; ++trial) {
    const auto from = random_points(random, 3 + static_cast<std::size_t>(trial % 20));
    const Mat3 rotation = rotation_from_vector(random_vector(random, 3.0));
    const Vec3 translation = random_vector(random, 1.0);
    const auto fit = absolute_orientation(from, moved(from, rotation, translation));
    ASSERT_TRUE(fit.ok()) << fit.error().message;
    EXPECT_LT(rotation_angle_rad(fit->rotation, rotation), kExactRad);
    EXPECT_LT((fit->translation_m - translation).norm(), kExactM);
    EXPECT_LT(fit->rmse_m, kExactM);
  }
}

TEST(AbsoluteOrientation, TurnsByHalfATurnToo) {
  Random random(2);
  const auto from = random_points(random, 5);
  for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const Mat3 rotation = rotation_from_vector(3.14159265358979323846 * axis);
    const auto fit = absolute_orientation(from, moved(from, rotation, {}));
    ASSERT_TRUE(fit.ok());
    EXPECT_LT(rotation_angle_rad(fit->rotation, rotation), kExactRad);
  }
}

TEST(AbsoluteOrientation, FitsNoisyPointsAsWellAsTheSvd) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const auto from = random_points(random, 8);
    auto to = moved(from, rotation_from_vector(random_vector(random, 3.0)), {0.2, 0.1, 0.0});
    for (Vec3& p : to) {
      p += Vec3{random.normal(), random.normal(), random.normal()} * 0.005;
    }
    const auto fit = absolute_orientation(from, to);
    ASSERT_TRUE(fit.ok());
    EXPECT_NEAR(fit->rmse_m, rmse_by_svd(from, to), 1e-10);
  }
}

TEST(AbsoluteOrientation, NeverMirrors) {
  Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const auto from = random_points(random, 6);
    std::vector<Vec3> mirrored;
    for (const Vec3& p : from) {
      mirrored.push_back({-p.x, p.y, p.z});
    }
    const auto fit = absolute_orientation(from, mirrored);
    ASSERT_TRUE(fit.ok());
    EXPECT_NEAR(fit->rotation.determinant(), 1.0, 1e-12);
    EXPECT_GT(fit->rmse_m, 1e-3);
  }
}

TEST(AbsoluteOrientation, RefusesTooFewPointsAndUnequalCounts) {
  Random random(5);
  const auto three = random_points(random, 3);
  const std::vector<Vec3> two(three.begin(), three.begin() + 2);
  EXPECT_THAT(absolute_orientation(two, two).error().message, HasSubstr("2 points, at least 3"));
  EXPECT_THAT(absolute_orientation({}, {}).error().message, HasSubstr("0 points"));
  EXPECT_THAT(absolute_orientation(three, two).error().message, HasSubstr("3 points onto 2"));
}

TEST(AbsoluteOrientation, RefusesWhatIsNotFinite) {
  Random random(6);
  const auto good = random_points(random, 4);
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    auto bad = good;
    bad[2].y = value;
    EXPECT_THAT(absolute_orientation(good, bad).error().message, HasSubstr("not finite"));
    EXPECT_THAT(absolute_orientation(bad, good).error().message, HasSubstr("not finite"));
  }
  auto huge = good;
  huge[0].x = 1e300;
  EXPECT_FALSE(absolute_orientation(huge, good).ok());
}

TEST(AbsoluteOrientation, RefusesPointsOnALineButNotJustBesideOne) {
  std::vector<Vec3> line;
  for (int i = 0; i < 5; ++i) {
    line.push_back(Vec3{0.01, 0.02, -0.005} * i + Vec3{1.0, 2.0, 3.0});
  }
  EXPECT_THAT(absolute_orientation(line, line).error().message, HasSubstr("on a line"));
  Random random(7);
  EXPECT_FALSE(absolute_orientation(random_points(random, 5), line).ok());
  const std::vector<Vec3> one_point(4, Vec3{1, 2, 3});
  EXPECT_FALSE(absolute_orientation(one_point, one_point).ok());
  auto beside = line;
  beside[2].z += 0.001;
  EXPECT_TRUE(absolute_orientation(beside, beside).ok());
}

}  // namespace
}  // namespace orthonav::nav
