#include "base/transform.h"

#include <gtest/gtest.h>

#include <limits>
#include <type_traits>

#include "hal/api/devices.h"

namespace orthonav {
namespace {

// Which transforms compose is decided by the compiler: a mix-up of frames does not compile.
template <class Left, class Right>
concept Composes = requires(Left left, Right right) {
  left* right;
};
template <class Left, class Right>
concept Subtracts = requires(Left left, Right right) {
  left - right;
};
template <class Left, class Right>
concept Adds = requires(Left left, Right right) {
  left + right;
};

static_assert(Composes<Transform<World, Rig>, Transform<Rig, LeftCamera>>);
static_assert(!Composes<Transform<World, Rig>, Transform<LeftCamera, Rig>>);
static_assert(!Composes<Transform<World, Rig>, Transform<World, Rig>>);
static_assert(!Composes<Transform<World, LeftCamera>, Transform<RightCamera, Marker>>);
static_assert(std::is_same_v<decltype(Transform<World, Rig>{} * Transform<Rig, Marker>{}),
                             Transform<World, Marker>>);
static_assert(std::is_same_v<decltype(Transform<World, Rig>{}.inverse()), Transform<Rig, World>>);

static_assert(Composes<Transform<World, Rig>, Point<Rig>>);
static_assert(!Composes<Transform<World, Rig>, Point<World>>);
static_assert(!Composes<Transform<World, Rig>, Point<LeftCamera>>);
static_assert(!Composes<Transform<World, Rig>, Vec3>);
static_assert(!Composes<Point<Rig>, Transform<Rig, World>>);
static_assert(std::is_same_v<decltype(Transform<World, Rig>{} * Point<Rig>{}), Point<World>>);
static_assert(Composes<Transform<World, Rig>, Direction<Rig>>);
static_assert(!Composes<Transform<World, Rig>, Direction<World>>);

static_assert(Subtracts<Point<World>, Point<World>>);
static_assert(!Subtracts<Point<World>, Point<Rig>>);
static_assert(Subtracts<Point<World>, Vec3>);
static_assert(Adds<Point<World>, Vec3>);
static_assert(!Adds<Point<World>, Point<World>>);  // two places have no sum

static_assert(!std::is_convertible_v<Point<World>, Point<Rig>>);
static_assert(!std::is_convertible_v<Transform<World, Rig>, Transform<Rig, World>>);
static_assert(!std::is_convertible_v<Vec3, Point<World>>);
static_assert(!std::equality_comparable_with<Point<World>, Point<Rig>>);

constexpr double kRounding = 1e-14;  // a handful of double operations on numbers near 1
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

const Transform<World, Rig> kRotated(rotation_from_vector({0.3, -1.1, 0.7}), {0.1, -2.0, 3.0});

std::array<double, 16> with(std::array<double, 16> matrix, std::size_t index, double value) {
  matrix[index] = value;
  return matrix;
}

TEST(Transform, TakesCoordinatesInBToCoordinatesInA) {
  const Transform<World, Rig> quarter_about_z({{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}}, {10, 20, 30});
  EXPECT_EQ((quarter_about_z * Point<Rig>{{1, 2, 3}}).v, (Vec3{8, 21, 33}));
  EXPECT_EQ((quarter_about_z * Direction<Rig>{{1, 2, 3}}).v, (Vec3{-2, 1, 3}));
  EXPECT_EQ(quarter_about_z.origin().v, (Vec3{10, 20, 30}));
}

TEST(Transform, ComposesLikeItsPartsOneAfterTheOther) {
  const Transform<Rig, Marker> second(rotation_from_vector({-0.2, 0.5, 2.0}), {0.3, 0.2, -0.4});
  const Point<Marker> p{{0.7, -0.1, 0.2}};
  EXPECT_LT(((kRotated * second) * p - kRotated * (second * p)).norm(), kRounding);
}

TEST(Transform, InverseUndoesIt) {
  const Transform<World, World> nothing = kRotated * kRotated.inverse();
  EXPECT_LT(rotation_angle_rad(nothing.rotation(), Mat3::identity()), kRounding);
  EXPECT_LT(nothing.translation().norm(), kRounding);
}

TEST(Transform, SurvivesRowMajorToTheBit) {
  const auto back = Transform<World, Rig>::from_row_major(kRotated.row_major());
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(*back, kRotated);
}

TEST(Transform, RefusesMirroredNonFiniteAndNonRigidNumbers) {
  const auto good = kRotated.row_major();
  const auto message = [](const std::array<double, 16>& matrix) {
    const auto result = Transform<World, Rig>::from_row_major(matrix);
    return result.ok() ? std::string("accepted") : result.error().message;
  };
  EXPECT_EQ(message(good), "accepted");
  for (std::size_t i = 0; i < 12; ++i) {
    for (const double bad : {kNan, kInf, -kInf}) {
      EXPECT_NE(message(with(good, i, bad)).find("not finite"), std::string::npos) << i;
    }
  }
  auto mirrored = good;
  for (std::size_t c = 0; c < 3; ++c) {
    mirrored[c] = -mirrored[c];
  }
  EXPECT_NE(message(mirrored).find("mirrors"), std::string::npos);
  auto scaled = good;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      scaled[4 * r + c] *= 1.01;
    }
  }
  EXPECT_NE(message(scaled).find("not rigid"), std::string::npos);
  EXPECT_NE(message(std::array<double, 16>{}).find("not rigid"), std::string::npos);
}

TEST(Transform, OrthonormalizesWhatAFileRoundedAndKeepsWhatIsExact) {
  auto rounded = kRotated.row_major();
  for (double& entry : rounded) {
    entry = std::round(entry * 1e6) * 1e-6;
  }
  const auto result = Transform<World, Rig>::from_row_major(rounded);
  ASSERT_TRUE(result.ok());
  EXPECT_LT(orthonormality_error(result->rotation()), kRounding);
  constexpr double kSixDigits = 2e-6;
  EXPECT_LT(rotation_angle_rad(result->rotation(), kRotated.rotation()), kSixDigits);
  EXPECT_GT(rotation_angle_rad(result->rotation(), kRotated.rotation()), kRounding);
}

TEST(Transform, InterpolatesAtConstantVelocity) {
  const Transform<World, Rig> from(rotation_from_vector({0, 0.2, 0}), {0, 0, 0});
  const Transform<World, Rig> to(rotation_from_vector({0, 0.6, 0}), {1, 2, 3});
  for (const double fraction : {0.0, 0.25, 1.0, 1.5}) {
    const auto pose = interpolated(from, to, fraction);
    const Mat3 expected = rotation_from_vector({0, 0.2 + 0.4 * fraction, 0});
    EXPECT_LT(rotation_angle_rad(pose.rotation(), expected), kRounding) << fraction;
    EXPECT_LT((pose.translation() - fraction * Vec3{1, 2, 3}).norm(), kRounding) << fraction;
  }
}

TEST(StereoCalibration, RelatesTheCamerasThroughTheRig) {
  StereoCalibration calibration;
  calibration.left_from_rig = {rotation_from_vector({0.1, 0, 0}), {0.05, 0, 0}};
  calibration.right_from_rig = {rotation_from_vector({0, 0.1, 0}), {-0.05, 0, 0}};
  const Point<Rig> p{{0.1, 0.2, 0.5}};
  const Point<RightCamera> direct = calibration.right_from_rig * p;
  const Point<RightCamera> through_left =
      calibration.right_from_left() * (calibration.left_from_rig * p);
  EXPECT_LT((direct - through_left).norm(), kRounding);
}

}  // namespace
}  // namespace orthonav
