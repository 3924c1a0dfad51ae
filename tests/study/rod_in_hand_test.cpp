#include "study/rod_in_hand.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace orthonav::engine {
namespace {

TEST(RodInHand, LiesInItsSeatsWhereverItIsHeld) {
  const std::vector<Vec3> seats = {{0, 0, 0}, {0.004, 0, 0.035}, {0, 0.008, 0.07}, {0, 0, 0.1}};
  const Mat3 rotation = rotation_from_vector({0.05, -0.04, 0.08});
  std::vector<Vec3> held;
  std::transform(seats.begin(), seats.end(), std::back_inserter(held), [&](Vec3 seat) {
    return rotation * seat + Vec3{0.001, 0.002, -0.001};
  });
  RodInHand rod = RodInHand::straight(held);
  for (std::size_t i = 1; i + 1 < held.size(); ++i) {
    rod.bend(i, rod_rotation_rad(rod.chord_m(i), held[i + 1] - rod.places_m()[i]));
  }
  const RodLie lie = rod.lay_on(seats);
  EXPECT_LT(lie.largest_m, 1e-4);  // closest points creep along the rod; 0.1 mm is touching
}

TEST(RodInHand, FindsTheWrongBendOfARodWithOtherPlaces) {
  const std::vector<Vec3> seats = {{0, 0, 0}, {0, 0, 0.03}, {0, 0, 0.06}, {0, 0, 0.09}};
  const RodInHand rod =
      RodInHand::along({{0, 0, -0.005}, {0, 0, 0.02}, {0, 0, 0.058}, {0, -0.0035, 0.095}});
  const RodCorrection worst = rod.worst_bend_near(seats);
  EXPECT_EQ(worst.joint, 2U);
  EXPECT_GT(-worst.rotation_rad.x, 0.05);
  EXPECT_NEAR(worst.rotation_rad.y, 0.0, 1e-12);
}

TEST(RodInHand, FindsTheBendThatIsWrongAndItsAngle) {
  const std::vector<Vec3> seats = {{0, 0, 0}, {0, 0, 0.03}, {0, 0, 0.06}, {0, 0, 0.09}};
  RodInHand rod = RodInHand::straight(seats);
  rod.bend(2, {0.1, 0.0, 5.0});  // the turn about the rod itself does nothing
  EXPECT_LT(
      (rod.places_m()[3] - Vec3{0, -0.03 * std::sin(0.1), 0.06 + 0.03 * std::cos(0.1)}).norm(),
      1e-15);
  const RodCorrection worst = rod.worst_bend(seats);
  EXPECT_EQ(worst.joint, 2U);
  EXPECT_LT((worst.rotation_rad - Vec3{-0.1, 0, 0}).norm(), 1e-12);
}

}  // namespace
}  // namespace orthonav::engine
