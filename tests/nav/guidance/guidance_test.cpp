#include "nav/guidance/screw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orthonav::nav {
namespace {

constexpr double kRounding_m = 1e-15;
constexpr double kRounding_rad = 1e-14;  // a direction through a rotation and back
constexpr double kDegree = std::numbers::pi / 180.0;

/// A screw straight down from (0.01, 0.02, 0.03), 45 mm long, in a turned and shifted vertebra.
struct Scene {
  ScrewPlan plan{Side::kLeft, {{0.01, 0.02, 0.03}}, {{0.01, -0.025, 0.03}}, 0.003};
  Transform<World, Vertebra> world_from_vertebra{rotation_from_vector({0.3, -0.8, 0.5}),
                                                 {0.4, -1.2, 0.7}};
  Point<World> at(Vec3 in_vertebra) const {
    return world_from_vertebra * Point<Vertebra>{in_vertebra};
  }
  Vec3 rotated(Vec3 in_vertebra) const { return world_from_vertebra.rotation() * in_vertebra; }
};

TEST(Guide, IsAllZeroWhereTheToolStandsAsPlanned) {
  const Scene s;
  const auto g =
      guide(s.world_from_vertebra, s.plan, s.at({0.01, 0.02, 0.03}), s.rotated({0, 1, 0}));
  EXPECT_NEAR(g.angle_rad, 0.0, kRounding_rad);
  EXPECT_NEAR(g.tip_to_entry_m, 0.0, kRounding_m);
  EXPECT_NEAR(g.tip_off_axis_m, 0.0, kRounding_m);
  EXPECT_NEAR(g.depth_m, 0.0, kRounding_m);
  EXPECT_LT((g.b - g.c).norm(), kRounding_m);
}

TEST(Guide, MeasuresTheAngleDownToAMillionthOfADegree) {
  const Scene s;
  for (const double degrees : {1e-6, 0.01, 2.0, 12.4, 90.0, 179.0}) {
    const double a = degrees * kDegree;
    const Vec3 axis = 3.0 * Vec3{std::sin(a), std::cos(a), 0};
    const auto g = guide(s.world_from_vertebra, s.plan, s.at({0, 0, 0}), s.rotated(axis));
    // acos would give 0 or 1.2e-6 degrees for the first.
    EXPECT_NEAR(g.angle_rad / kDegree, degrees, 1e-12 * degrees + 1e-13);
  }
}

TEST(Guide, TellsATheReverseDirectionFromTheRightOne) {
  const Scene s;
  const auto g =
      guide(s.world_from_vertebra, s.plan, s.at({0.01, 0.02, 0.03}), s.rotated({0, -1, 0}));
  EXPECT_NEAR(g.angle_rad, std::numbers::pi, kRounding_rad);
}

TEST(Guide, DrawsTheTriangleOutsideTheBone) {
  const Scene s;
  // Along x through the entry: the tip before it, in it, past it.
  for (const double x : {0.03, 0.01, -0.02}) {
    const auto g =
        guide(s.world_from_vertebra, s.plan, s.at({x, 0.02, 0.03}), s.rotated({0.5, 0, 0}));
    const auto back = s.world_from_vertebra.inverse();
    EXPECT_LT((back * g.a - s.plan.entry).norm(), kRounding_m);
    EXPECT_LT((back * g.b - Point<Vertebra>{{0.09, 0.02, 0.03}}).norm(), kRounding_m) << x;
    EXPECT_LT((back * g.c - Point<Vertebra>{{0.01, 0.10, 0.03}}).norm(), kRounding_m);
    EXPECT_NEAR((g.b - g.a).norm(), kTriangleReach_m, kRounding_m);
    EXPECT_NEAR((g.c - g.a).norm(), kTriangleReach_m, kRounding_m);
  }
}

/// Distance of a point from the axis through the tip.
double off_tool_m(const ScrewGuidance& g, Point<World> at) {
  return (at - g.tip).cross(g.tool_outward).norm();
}

TEST(Guide, ShowsATipBesideTheEntryInTheTriangleOfAParallelTool) {
  const Scene s;
  for (const double aside_m : {0.0, 0.001, 0.003, 0.040}) {
    const auto g = guide(s.world_from_vertebra, s.plan, s.at({0.01 + aside_m, 0.015, 0.03}),
                         s.rotated({0, 1, 0}));
    EXPECT_NEAR(g.angle_rad, 0.0, kRounding_rad) << "the number is that of the directions";
    EXPECT_LT(off_tool_m(g, g.b), kRounding_m);
    EXPECT_NEAR((g.b - g.a).norm(), kTriangleReach_m, kRounding_m);
    // As far from the planned axis as the tip: the chord on the sphere about A.
    const double angle_at_a_rad = std::asin(aside_m / kTriangleReach_m);
    EXPECT_NEAR((g.b - g.c).norm(), 2.0 * kTriangleReach_m * std::sin(0.5 * angle_at_a_rad),
                kRounding_m);
  }
}

TEST(Guide, ClosesTheTriangleOfAToolThatCrossesThePlanThereButNotTheNumber) {
  const Scene s;
  // From 3 mm beside the entry to C.
  const Vec3 tip{0.013, 0.02, 0.03};
  const auto g = guide(s.world_from_vertebra, s.plan, s.at(tip),
                       s.rotated(Vec3{0.01, 0.02 + kTriangleReach_m, 0.03} - tip));
  EXPECT_LT((g.b - g.c).norm(), kRounding_m);
  EXPECT_NEAR(g.angle_rad, std::atan2(0.003, kTriangleReach_m), kRounding_rad);
}

TEST(Guide, KeepsBOnTheToolWhereItPassesTheEntryFartherOffThanTheTriangleReaches) {
  const Scene s;
  for (const double aside_m : {0.079999, 0.080001, 0.3}) {
    const auto g = guide(s.world_from_vertebra, s.plan, s.at({0.01 + aside_m, 0.5, 0.03}),
                         s.rotated({0, 1, 0}));
    EXPECT_LT(off_tool_m(g, g.b), 10 * kRounding_m) << aside_m;
    EXPECT_NEAR((g.b - g.a).norm(), std::max(kTriangleReach_m, aside_m), 10 * kRounding_m);
  }
}

TEST(Guide, SaysHowFarTheTipIsFromAxisAndEntry) {
  const Scene s;
  // 3 mm and 4 mm beside the axis, 12 mm past the entry.
  const auto g =
      guide(s.world_from_vertebra, s.plan, s.at({0.013, 0.008, 0.034}), s.rotated({0, 1, 0}));
  EXPECT_NEAR(g.tip_off_axis_m, 0.005, kRounding_m);
  EXPECT_NEAR(g.depth_m, 0.012, kRounding_m);
  EXPECT_NEAR(g.tip_to_entry_m, 0.013, kRounding_m);
  const auto before =
      guide(s.world_from_vertebra, s.plan, s.at({0.01, 0.025, 0.03}), s.rotated({0, 1, 0}));
  EXPECT_NEAR(before.depth_m, -0.005, kRounding_m);
}

TEST(Guide, SaysWhereTipAndTopStandBesideThePlannedAxis) {
  const Scene s;
  const auto g =
      guide(s.world_from_vertebra, s.plan, s.at({0.012, 0.03, 0.027}), s.rotated({0, 1, 0}));
  EXPECT_LT((g.tip_offset_m - s.rotated({0.002, 0, -0.003})).norm(), 1e-14);
  EXPECT_LT((g.top_offset_m - g.tip_offset_m).norm(), 1e-14) << "parallel to the plan";
  EXPECT_NEAR(g.to_target_m, 0.045 + 0.010, 1e-14);
  const auto tilted =
      guide(s.world_from_vertebra, s.plan, s.at({0.012, 0.03, 0.027}), s.rotated({0.6, 0.8, 0}));
  EXPECT_LT((tilted.top_offset_m - s.rotated({0.002 + 0.6 * kTriangleReach_m, 0, -0.003})).norm(),
            1e-14);
}

}  // namespace
}  // namespace orthonav::nav
