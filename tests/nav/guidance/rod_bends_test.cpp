#include "nav/guidance/rod_bends.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/angle.h"
#include "tests/nav/guidance/uneven_seats.h"

namespace orthonav::nav::rod_bends_test {
namespace {

using ::testing::HasSubstr;

// Remaining error of a reachable seat, since the fit weighs seats at 0.05 mm against angles at 20°.
constexpr double kReached_m = 2e-6;
// An angle that a lever of 20 mm turns into 2 µm.
constexpr double kSameBend_rad = 1e-4;
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

double rad(double degrees) { return degrees * kRadiansPerDegree; }

/// Points at places along a rod's axis, all on its straights, after a rigid motion.
std::vector<Vec3> seats_on(const std::vector<RodArc>& arcs, const std::vector<double>& places_m) {
  const Mat3 rotation = rotation_from_vector({0.4, -0.9, 1.7});
  const auto straights = rod_straights(arcs, 1.0);
  std::vector<Vec3> seats;
  for (const double at_m : places_m) {
    for (const RodStraight& s : straights) {
      if (at_m >= s.begin_m && at_m <= s.end_m) {
        seats.push_back(rotation * (s.from_m + (at_m - s.begin_m) * s.direction) + Vec3{1, -2, 3});
      }
    }
  }
  return seats;
}

std::string refusal_of(std::span<const Vec3> seats, const RodBending& bending = {}) {
  const auto told = rod_instructions(seats, bending);
  return told.ok() ? "" : told.error().message;
}

TEST(RodShape, IsACircleWhereItIsBentEvenly) {
  // Four bends of 15° side by side: 60° of a circle of 20 mm / 15°.
  const double radius_m = 0.020 / rad(15.0);
  std::vector<RodArc> arcs;
  for (int i = 0; i < 4; ++i) {
    arcs.push_back({0.010 + 0.020 * i, 0.020, rad(15.0), 0.0});
  }
  const RodStraight end = rod_straights(arcs, 0.080).back();
  EXPECT_LT(
      (end.from_m - Vec3{radius_m * (1.0 - std::cos(rad(60))), 0, radius_m * std::sin(rad(60))})
          .norm(),
      1e-12);
  for (const Vec3& at_m : rod_axis(arcs, 0.080)) {
    EXPECT_NEAR((at_m - Vec3{radius_m, 0, 0}).norm(), radius_m, 1e-12);
  }
}

TEST(RodShape, RollsAsARightHandAboutTheRod) {
  const std::vector<RodArc> arcs = {{0.05, 0.02, rad(30), rad(90)}};
  const Vec3 direction = rod_straights(arcs, 0.1).back().direction;
  EXPECT_LT((direction - Vec3{0, std::sin(rad(30)), std::cos(rad(30))}).norm(), 1e-12);
}

TEST(RodInstructions, GiveAPlanarRodBackAsItWasBent) {
  // Back and forth: the second bend goes to the other side.
  const std::vector<RodArc> bent = {{0.055, 0.020, rad(14), 0.0}, {0.120, 0.020, rad(9), rad(180)}};
  const auto told =
      rod_instructions(seats_on(bent, {0.005, 0.035, 0.075, 0.100, 0.140, 0.170}), {});
  ASSERT_TRUE(told.ok()) << told.error().message;
  ASSERT_EQ(told->bends.size(), 2U);
  EXPECT_LT(told->fit.worst_off_m, kReached_m);
  EXPECT_NEAR(told->bends[0].arc.angle_rad, rad(14), kSameBend_rad);
  EXPECT_NEAR(told->bends[1].arc.angle_rad, rad(9), kSameBend_rad);
  EXPECT_NEAR(std::abs(told->bends[1].arc.roll_rad), rad(180), rad(0.1));
  for (const RodInstruction& bend : told->bends) {
    EXPECT_GT(bend.set_rad, bend.arc.angle_rad + rad(4));
  }
}

/// Four seats on a circle, 10° apart: two straights through two seats each, which meet at 20° in
/// the middle.
TEST(RodInstructions, TakeOneBendForFourSeatsOnACircle) {
  std::vector<Vec3> seats;
  for (int i = 0; i < 4; ++i) {
    seats.push_back({0, -0.206 * std::cos(rad(10.0 * i)), 0.206 * std::sin(rad(10.0 * i))});
  }
  const auto told = rod_instructions(seats, {});
  ASSERT_TRUE(told.ok()) << told.error().message;
  ASSERT_EQ(told->bends.size(), 1U);
  EXPECT_NEAR(told->bends[0].arc.angle_rad, rad(20), kSameBend_rad);
  EXPECT_NEAR(told->bends[0].arc.centre_m, 0.5 * told->cut_length_m(), kReached_m * 10);
  EXPECT_EQ(told->bends[0].gap, 1U);
}

TEST(RodInstructions, FindTwoBendsInDifferentPlanes) {
  // Two seats on every straight determine everything.
  const std::vector<RodArc> bent = {{0.055, 0.020, rad(14), 0.0}, {0.120, 0.020, rad(9), rad(70)}};
  const auto told =
      rod_instructions(seats_on(bent, {0.005, 0.035, 0.075, 0.100, 0.140, 0.170}), {});
  ASSERT_TRUE(told.ok()) << told.error().message;
  ASSERT_EQ(told->bends.size(), 2U);
  EXPECT_NEAR(told->bends[0].arc.angle_rad, rad(14), kSameBend_rad);
  EXPECT_NEAR(told->bends[1].arc.angle_rad, rad(9), kSameBend_rad);
  EXPECT_DOUBLE_EQ(told->bends[0].arc.roll_rad, 0.0);
  EXPECT_NEAR(told->bends[1].arc.roll_rad, rad(70), rad(0.1));
  EXPECT_NEAR(told->bends[0].arc.centre_m, 0.055, kReached_m * 10);
  EXPECT_NEAR(told->bends[1].arc.centre_m, 0.120, kReached_m * 10);
  EXPECT_NEAR(told->cut_length_m(), 0.175, kReached_m);
}

TEST(RodInstructions, StraightSeatsNeedNoBend) {
  const std::vector<Vec3> seats = {{0, 0, 0}, {0, 0, 0.04}, {0, 0, 0.07}};
  const auto told = rod_instructions(seats, {});
  ASSERT_TRUE(told.ok()) << told.error().message;
  EXPECT_TRUE(told->bends.empty());
  EXPECT_NEAR(told->cut_length_m(), 0.080, kReached_m);
}

/// Checks what the header promises, over rods of many shapes.
TEST(RodInstructions, KeepTheirPromisesOnUnevenSpines) {
  const RodBending bending;
  int followed = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto seats = uneven_seats(seed, 3 + static_cast<int>(seed % 4));
    const auto told = rod_instructions(seats, bending);
    if (!told) {
      continue;
    }
    ++followed;
    EXPECT_LE(told->bends.size(), seats.size() - 1);
    EXPECT_LE(told->fit.worst_off_m, bending.tolerance_m);
    EXPECT_LE(told->reach_m, bending.reach_m + 1e-6);
    const auto& on_rod = told->fit.seats;
    EXPECT_NEAR(on_rod.front().at_m, bending.overhang_m, kReached_m);
    EXPECT_NEAR(told->cut_length_m() - on_rod.back().at_m, bending.overhang_m, kReached_m);
    for (std::size_t k = 0; k < told->bends.size(); ++k) {
      const RodInstruction& bend = told->bends[k];
      const double half_m = 0.5 * (bending.bender.width_m + bending.tulip_m) - told->reach_m - 1e-6;
      EXPECT_GE(bend.arc.centre_m - half_m, on_rod[bend.gap].at_m);
      EXPECT_LE(bend.arc.centre_m + half_m, on_rod[bend.gap + 1].at_m);
      EXPECT_GE(bending.bender.width_m / bend.set_rad, 0.0275 - 1e-6);
      if (k > 0) {
        EXPECT_GE(bend.arc.centre_m - told->bends[k - 1].arc.centre_m, bending.bender.width_m);
      }
    }
  }
  EXPECT_GE(followed, 30) << "spines that no rod of one bend a gap fits are the exception";
}

/// Checks the distances for the rod made by the instructions in another way: by the chain of chords
/// in space.
TEST(RodInstructions, PredictTheRodThatTheyMake) {
  const auto seats = uneven_seats(2, 5);
  const auto told = rod_instructions(seats, {});
  ASSERT_TRUE(told.ok()) << told.error().message;
  const auto chain = rod_axis(told->fit.arcs, told->cut_length_m());
  for (std::size_t i = 0; i < seats.size(); ++i) {
    double nearest_m = 1.0;
    for (std::size_t c = 1; c < chain.size(); ++c) {
      const Vec3 from = told->fit.seats_from_rod * chain[c - 1] + told->fit.rod_in_seats_m;
      const Vec3 to = told->fit.seats_from_rod * chain[c] + told->fit.rod_in_seats_m;
      const double t =
          std::clamp((seats[i] - from).dot(to - from) / (to - from).squared_norm(), 0.0, 1.0);
      nearest_m = std::min(nearest_m, (seats[i] - from - t * (to - from)).norm());
    }
    EXPECT_NEAR(nearest_m, told->fit.seats[i].off_m, 1e-9) << i;
  }
}

TEST(RodInstructions, RefuseARadiusTooTight) {
  // 45° between two straights, each determined by two seats.
  const std::vector<RodArc> bent = {{0.055, 0.020, rad(45), 0.0}};
  const auto seats = seats_on(bent, {0.005, 0.035, 0.075, 0.105});
  RodBending strict;
  strict.reach_m = 0.0;
  EXPECT_THAT(
      refusal_of(seats, strict),
      ::testing::MatchesRegex("bend between seats 2 and 3: bend of 4[0-9.]+° has a radius of "
                              "2[0-9.]+ mm on the bender, limit 27.5 mm"));
  RodBending longer = strict;
  longer.material.elongation = 0.14;
  EXPECT_EQ(refusal_of(seats, longer), "");
}

TEST(RodInstructions, RefuseWhereNoBendFitsBetweenTheTulips) {
  const std::vector<Vec3> seats = {{0, 0, 0}, {0, 0.0015, 0.025}, {0, 0, 0.05}, {0, 0.0015, 0.075}};
  EXPECT_THAT(
      refusal_of(seats),
      HasSubstr("limit 0.30 mm; no bend fits between seats 1 and 2: 25.0 mm apart, at least "
                "26.2 mm"));
  RodBending narrow;
  narrow.bender.width_m = 0.012;
  EXPECT_EQ(refusal_of(seats, narrow), "");
}

TEST(RodInstructions, RefuseWhatIsNoRod) {
  EXPECT_EQ(refusal_of(std::vector<Vec3>{{0, 0, 0}}), "rod to bend needs at least 2 seats, got 1");
  EXPECT_EQ(refusal_of({}), "rod to bend needs at least 2 seats, got 0");
  EXPECT_EQ(refusal_of(std::vector<Vec3>{{0, 0, 0}, {0, kNotANumber, 0.04}}),
            "seat 2 of the rod is not finite");
  EXPECT_EQ(refusal_of(std::vector<Vec3>{{0, 0, 0}, {0, 0, 0.04}, {0, 0, 0.0445}}),
            "seats 2 and 3 of the rod meet: 4.5 mm apart, at least 5 mm");
  const std::vector<Vec3> seats = {{0, 0, 0}, {0, 0, 0.04}};
  RodBending bending;
  bending.tulip_m = 0.031;
  EXPECT_EQ(refusal_of(seats, bending), "width of a tulip is 31.00 mm, limit 0-30 mm");
  bending = {};
  bending.tolerance_m = kNotANumber;
  EXPECT_EQ(refusal_of(seats, bending), "tolerance at the seats is not finite");
  bending = {};
  bending.overhang_m = -0.001;
  EXPECT_EQ(refusal_of(seats, bending), "overhang of the rod is -1.00 mm, limit 0-50 mm");
  bending = {};
  bending.diameter_m = 0.0;
  EXPECT_EQ(refusal_of(seats, bending), "rod diameter is 0.0 mm, limit 1-15 mm");
}

}  // namespace
}  // namespace orthonav::nav::rod_bends_test
