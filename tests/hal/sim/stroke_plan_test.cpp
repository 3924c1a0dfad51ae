#include "hal/sim/surgeon/stroke_plan.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/hal/sim/test_rooms.h"

namespace orthonav::sim {
namespace {

RoomLevel translated(RoomLevel level, Vec3 by) {
  for (Vec3& vertex : level.vertices_m) {
    vertex += by;
  }
  return level;
}

std::vector<Vec3> spots_of(const std::vector<StrokeRegion>& regions) {
  std::vector<Vec3> spots;
  for (const StrokeRegion& region : regions) {
    for (const Stroke& stroke : region.strokes) {
      for (const BoneSpot& spot : stroke.spots) {
        spots.push_back(spot.point);
      }
    }
  }
  return spots;
}

/// How far the worst of `spots` is from the nearest of `others`.
double farthest_m(const std::vector<Vec3>& spots, const std::vector<Vec3>& others) {
  double worst = 0.0;
  for (const Vec3 spot : spots) {
    double nearest = 1.0;
    for (const Vec3 other : others) {
      nearest = std::min(nearest, (spot - other).norm());
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

double length_m(const std::vector<StrokeRegion>& regions) {
  double sum = 0.0;
  for (const StrokeRegion& region : regions) {
    sum += region.length_m();
  }
  return sum;
}

void expect_the_same_strokes(const RoomLevel& level, Vec3 by) {
  // Rounding may move a line's end by a cell of the map or two.
  constexpr double kCells_m = 0.001;
  const auto here = plan_strokes(level);
  const auto there = plan_strokes(translated(level, by));
  ASSERT_GT(length_m(here), 0.5);
  EXPECT_EQ(there.size(), here.size());
  EXPECT_NEAR(length_m(there), length_m(here), 0.01 * length_m(here));
  std::vector<Vec3> back = spots_of(there);
  for (Vec3& spot : back) {
    spot -= by;
  }
  EXPECT_LT(farthest_m(back, spots_of(here)), kCells_m);
  EXPECT_LT(farthest_m(spots_of(here), back), kCells_m);
}

TEST(StrokePlan, GoesOutToTheEndsOfTransverseProcessesThatLieOpen) {
  const RoomLevel level = synthetic_level("L4", 0.0);
  const auto widest_m = [&](Exposure exposure) {
    double widest = 0.0;
    for (const Vec3& spot : spots_of(plan_strokes(level, exposure))) {
      widest = std::max(widest, std::abs(spot.x));
    }
    return widest;
  };
  double half_m = 0.0;
  for (const Vec3& vertex : level.vertices_m) {
    half_m = std::max(half_m, std::abs(vertex.x));
  }
  EXPECT_LT(widest_m(Exposure::kLaminae), 0.7 * half_m);
  EXPECT_GT(widest_m(Exposure::kTransverseProcesses), 0.85 * half_m);
}

TEST(StrokePlan, DoesNotDependOnTheModelsOrigin) {
  const RoomLevel level = synthetic_level("L4", 0.0);
  expect_the_same_strokes(level, {0.090, 0.0, 0.0});
  expect_the_same_strokes(level, {-0.031, -0.250, 1.200});
}

TEST(StrokePlan, DoesNotDependOnARealModelsOrigin) {
  const auto test_case = visible_human_case({"L4"});
  if (!test_case) {
    GTEST_SKIP() << "needs tests/data/anatomy";
  }
  for (const RoomLevel& level : test_case->room.levels) {
    if (level.label == "L4") {
      expect_the_same_strokes(level, {0.090, -0.120, 0.400});
    }
  }
}

TEST(StrokePlan, CoversBothSidesOfAModelAwayFromItsOrigin) {
  double left = -1.0;
  double right = 1.0;
  const auto regions = plan_strokes(translated(synthetic_level("L4", 0.0), {0.090, 0.0, 0.0}));
  for (const Vec3 spot : spots_of(regions)) {
    left = std::max(left, spot.x - 0.090);
    right = std::min(right, spot.x - 0.090);
  }
  EXPECT_GT(left, 0.020);
  EXPECT_LT(right, -0.020);
}

}  // namespace
}  // namespace orthonav::sim
