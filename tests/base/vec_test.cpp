#include "base/vec.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "base/random.h"

namespace orthonav {
namespace {

constexpr double kRounding = 4e-15;  // a few dozen operations on numbers near 1
constexpr double kPi = std::numbers::pi;

TEST(Vec3, CrossesAndDotsRightHanded) {
  EXPECT_EQ((Vec3{1, 0, 0}.cross({0, 1, 0})), (Vec3{0, 0, 1}));
  EXPECT_EQ((Vec3{0, 1, 0}.cross({0, 0, 1})), (Vec3{1, 0, 0}));
  EXPECT_EQ((Vec3{1, 2, 3}.dot({4, 5, 6})), 32.0);
  EXPECT_EQ((Vec3{3, 4, 12}.norm()), 13.0);
  EXPECT_EQ((Vec3{0, 0, -5}.normalized()), (Vec3{0, 0, -1}));
}

TEST(Vec3, KnowsWhenItIsNotFinite) {
  EXPECT_TRUE((Vec3{1, 2, 3}.is_finite()));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE((Vec3{bad, 0, 0}.is_finite()));
    EXPECT_FALSE((Vec3{0, bad, 0}.is_finite()));
    EXPECT_FALSE((Vec3{0, 0, bad}.is_finite()));
  }
}

TEST(Angle, KeepsItsDigitsNearZeroAndNearAHalfTurn) {
  for (const double angle : {1e-9, 1e-5, 0.3, kPi / 2, kPi - 1e-9}) {
    const Vec3 rotated{std::cos(angle), std::sin(angle), 0};
    constexpr double kRelative = 1e-12;
    EXPECT_NEAR(angle_between_rad({2, 0, 0}, rotated), angle, kRelative * std::max(angle, 1e-3));
  }
  EXPECT_EQ(angle_between_rad({1, 0, 0}, {5, 0, 0}), 0.0);
  EXPECT_NEAR(angle_between_rad({1, 0, 0}, {-5, 0, 0}), kPi, kRounding);
}

TEST(Rotation, GoesThroughVectorAndQuaternionAndBack) {
  Random random(7);
  constexpr int kDraws = 500;
  for (int i = 0; i < kDraws; ++i) {
    const Vec3 axis = Vec3{random.normal(), random.normal(), random.normal()}.normalized();
    // Up to just below a half turn, where the vector's sign becomes arbitrary.
    const double angle = random.uniform() * (kPi - 1e-3);
    const Mat3 rotation = rotation_from_vector(angle * axis);
    constexpr double kNearHalfTurn = 1e-12;  // digits lost where the sine is small
    EXPECT_LT((vector_from_rotation(rotation) - angle * axis).norm(), kNearHalfTurn);
    EXPECT_LT(orthonormality_error(rotation), kRounding);
    EXPECT_NEAR(rotation.determinant(), 1.0, kRounding);
    const Quaternion q = quaternion_from_rotation(rotation);
    EXPECT_GE(q.w, 0.0);
    EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1.0, kRounding);
    const Mat3 back = rotation_from_quaternion(q);
    for (int r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(back[r][c], rotation[r][c], kRounding);
      }
    }
  }
}

TEST(Rotation, KeepsTinyTurns) {
  for (const double angle : {1e-12, 1e-8, 9.9e-5, 1.01e-4}) {
    const Vec3 v = vector_from_rotation(rotation_from_vector({0, angle, 0}));
    EXPECT_NEAR(v.y, angle, 1e-9 * angle) << angle;
  }
  EXPECT_EQ(vector_from_rotation(Mat3::identity()), (Vec3{0, 0, 0}));
}

TEST(Rotation, HandlesHalfTurnsAboutEveryAxis) {
  for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const Mat3 half = rotation_from_vector(kPi * axis);
    const Quaternion q = quaternion_from_rotation(half);
    EXPECT_NEAR(std::abs(q.x * axis.x + q.y * axis.y + q.z * axis.z), 1.0, kRounding);
    EXPECT_NEAR(vector_from_rotation(half).norm(), kPi, kRounding);
  }
}

TEST(Quaternion, FollowsHamiltonWithWLast) {
  const double h = std::sqrt(0.5);
  const Mat3 quarter_about_x = rotation_from_quaternion({h, 0, 0, h});
  EXPECT_LT((quarter_about_x * Vec3{0, 1, 0} - Vec3{0, 0, 1}).norm(), kRounding);
  // A quaternion of any length means the same rotation.
  const Mat3 scaled = rotation_from_quaternion({3 * h, 0, 0, 3 * h});
  EXPECT_LT(rotation_angle_rad(quarter_about_x, scaled), kRounding);
}

TEST(Orthonormalized, GivesTheNearestRotationOfARoundedOne) {
  Mat3 rough = rotation_from_vector({0.4, 0.5, -0.6});
  constexpr double kDisturbance = 1e-4;
  rough[0][1] += kDisturbance;
  rough[2][0] -= kDisturbance;
  const Mat3 clean = orthonormalized(rough);
  EXPECT_LT(orthonormality_error(clean), kRounding);
  EXPECT_NEAR(clean.determinant(), 1.0, kRounding);
  EXPECT_LT(rotation_angle_rad(clean, rotation_from_vector({0.4, 0.5, -0.6})), 2 * kDisturbance);
  EXPECT_GT(orthonormality_error(rough), kDisturbance / 10);
}

}  // namespace
}  // namespace orthonav
