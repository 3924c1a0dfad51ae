#include "nav/registration/check_points.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/support/mesh_builder.h"

namespace orthonav::nav {
namespace {

using ::testing::HasSubstr;

CheckPoint at(double x_mm, double y_mm, double distance_mm = 0.0) {
  return {Point<World>{{x_mm * 1e-3, y_mm * 1e-3, 0.0}}, distance_mm * 1e-3,
          std::abs(distance_mm) <= 2.0};
}

/// Asks for so many places, 15 mm apart.
bool asks_for(const CheckAdvice& advice, std::size_t places) {
  return advice.kind == CheckAdvice::Kind::kTouchApart && advice.number == places &&
         advice.value_m == 0.015;
}

TEST(CheckPoints, ThreeApartAndOffALinePass) {
  const CheckPoint points[] = {at(0, 0, 0.4), at(20, 0, -1.3), at(10, 14, 0.2)};
  const CheckVerdict verdict = verdict_on(points);
  EXPECT_TRUE(verdict.passed);
  EXPECT_EQ(verdict.advice.kind, CheckAdvice::Kind::kNone);
  EXPECT_NEAR(verdict.worst_m, 0.0013, 1e-12);
}

TEST(CheckPoints, SayHowManyAreMissing) {
  EXPECT_TRUE(asks_for(verdict_on({}).advice, 3));
  const CheckPoint one[] = {at(0, 0)};
  EXPECT_TRUE(asks_for(verdict_on(one).advice, 2));
  const CheckPoint close[] = {at(0, 0), at(14.9, 0)};
  EXPECT_TRUE(asks_for(verdict_on(close).advice, 2));
  const CheckPoint two[] = {at(0, 0), at(15.1, 0)};
  EXPECT_TRUE(asks_for(verdict_on(two).advice, 1));
}

TEST(CheckPoints, EachOfThreeLiesApartFromBothOthers) {
  // A chain: each is 15 mm from its neighbour only.
  const CheckPoint folded[] = {at(0, 0), at(16, 0), at(2, 8)};
  EXPECT_TRUE(asks_for(verdict_on(folded).advice, 1));
  // A fourth makes three with two of them, in whatever order they came.
  const CheckPoint four[] = {at(0, 0), at(2, 8), at(16, 0), at(8, 16)};
  EXPECT_TRUE(verdict_on(four).passed);
}

TEST(CheckPoints, ThreeOnALineAskForOneBesideIt) {
  const CheckPoint line[] = {at(0, 0), at(16, 4.9), at(32, 0)};
  EXPECT_EQ(verdict_on(line).advice.kind, CheckAdvice::Kind::kTouchOffLine);
  EXPECT_DOUBLE_EQ(verdict_on(line).advice.value_m, 0.005);
  const CheckPoint bent[] = {at(0, 0), at(16, 5.1), at(32, 0)};
  EXPECT_TRUE(verdict_on(bent).passed) << "the twin";
}

TEST(CheckPoints, OneTooFarOffSpoilsAll) {
  const CheckPoint points[] = {at(0, 0), at(20, 0), at(10, 14), at(30, 30, -3.1)};
  const CheckVerdict verdict = verdict_on(points);
  EXPECT_FALSE(verdict.passed);
  EXPECT_EQ(verdict.advice.kind, CheckAdvice::Kind::kReject);
  EXPECT_EQ(verdict.advice.number, 4u);
  EXPECT_DOUBLE_EQ(verdict.advice.value_m, 0.0031);
  EXPECT_DOUBLE_EQ(verdict.advice.limit_m, 0.002);
}

class OnABall : public ::testing::Test {
 protected:
  /// 40 mm across, its middle 0.3 m along x.
  std::shared_ptr<const VertebraModel> model =
      VertebraModel::prepare(test::sphere({0, 0, 0}, 0.020, 24)).value();
  Transform<World, Vertebra> pose{rotation_from_vector({0.3, -0.2, 0.5}), {0.3, 0, 0}};
  CheckPoint touch(Vec3 in_vertebra) {
    return check_point(*model, pose, pose * Point<Vertebra>{in_vertebra});
  }
};

TEST_F(OnABall, DistancesHaveASign) {
  // Flat faces lie inside of the ball that their corners are on.
  constexpr double kFacet_m = 0.0004;
  const CheckPoint out = touch({0, 0.0215, 0});
  EXPECT_NEAR(out.distance_m, 0.0015, kFacet_m);
  EXPECT_TRUE(out.within);
  const CheckPoint in = touch({0, 0.0190, 0});
  EXPECT_NEAR(in.distance_m, -0.0010, kFacet_m);
  EXPECT_TRUE(in.within);
  EXPECT_FALSE(touch({0, 0.0230, 0}).within);
  EXPECT_FALSE(touch({0, 0.0170, 0}).within);
}

TEST_F(OnABall, ASideThatNoPointerReachesDoesNotCount) {
  // On the surface, but on the front: only a wrong registration puts a touched place there.
  const CheckPoint front = touch({0, -0.020, 0});
  EXPECT_FALSE(front.within);
  EXPECT_GT(std::abs(front.distance_m), 0.004) << "twice the limit";
}

TEST_F(OnABall, APlaceThatIsNoPlaceIsFarOff) {
  const CheckPoint nowhere =
      check_point(*model, pose, Point<World>{{std::numeric_limits<double>::quiet_NaN(), 0, 0}});
  EXPECT_FALSE(nowhere.within);
  EXPECT_EQ(verdict_on({&nowhere, 1}).advice.kind, CheckAdvice::Kind::kReject);
  EXPECT_EQ(verdict_on({&nowhere, 1}).advice.number, 1u);
}

TEST(CheckPoints, AreProposedOnTheSurfaceWhereItWasStrokedFarApart) {
  const auto model = VertebraModel::prepare(test::box({-0.03, -0.02, -0.025}, {0.03, 0.02, 0.025}));
  ASSERT_TRUE(model.ok()) << model.error().message;
  const Transform<World, Vertebra> pose(rotation_from_vector({0.2, -0.4, 0.1}), {0.3, 0.1, -0.5});
  std::vector<Point<World>> stroked;
  for (int x = -25; x <= 25; x += 5) {
    for (int z = -20; z <= 20; z += 5) {
      stroked.push_back(pose * Point<Vertebra>{{x * 1e-3, 0.0204, z * 1e-3}});
    }
  }
  stroked.push_back(pose * Point<Vertebra>{{0.09, 0.05, 0.0}});  // off the bone
  const auto places = places_to_check(**model, pose, stroked);
  ASSERT_EQ(places.size(), 3u);
  std::vector<CheckPoint> touched;
  for (const Point<World>& place : places) {
    touched.push_back(check_point(**model, pose, place));
    EXPECT_NEAR(touched.back().distance_m, 0.0, 1e-9);
  }
  EXPECT_TRUE(verdict_on(touched).passed) << static_cast<int>(verdict_on(touched).advice.kind);
  touched.pop_back();
  const auto open = still_to_check(places, touched);
  ASSERT_EQ(open.size(), 1u);
  EXPECT_EQ(open[0].v, places[2].v);
}

TEST(CheckPoints, AreNotProposedWhereStrokesAllowNone) {
  const auto model = VertebraModel::prepare(test::box({-0.03, -0.02, -0.025}, {0.03, 0.02, 0.025}));
  ASSERT_TRUE(model.ok());
  const Transform<World, Vertebra> pose;
  EXPECT_TRUE(places_to_check(**model, pose, {}).empty());
  const Point<World> near[] = {Point<World>{{0, 0.02, 0}}, Point<World>{{0.004, 0.02, 0}}};
  EXPECT_EQ(places_to_check(**model, pose, near).size(), 1u);
}

}  // namespace
}  // namespace orthonav::nav
