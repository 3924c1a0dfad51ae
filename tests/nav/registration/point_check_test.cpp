#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "base/random.h"
#include "nav/registration/registration.h"

namespace orthonav::nav {
namespace {

using ::testing::HasSubstr;

/// A cloud as large as a vertebra.
std::vector<Point<World>> cloud(std::size_t count) {
  Random random(5);
  std::vector<Point<World>> points(count);
  for (Point<World>& p : points) {
    p.v = {random.normal(0, 0.02), random.normal(0, 0.01), random.normal(0, 0.01)};
  }
  return points;
}

std::string refusal(const std::vector<Point<World>>& points) {
  constexpr std::size_t kFewest = 100;
  const Status s = validate_points(points, kFewest);
  return s ? "" : s.error().message;
}

TEST(PointCheck, RefusesTooFewPoints) {
  EXPECT_EQ(refusal(cloud(100)), "");
  EXPECT_THAT(refusal({}), HasSubstr("0 points, needs at least 100"));
  EXPECT_THAT(refusal(cloud(99)), HasSubstr("99 points, needs at least 100"));
}

TEST(PointCheck, RefusesPointsThatAreNotFinite) {
  auto points = cloud(200);
  points[17].v.z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(points), HasSubstr("point 18 is not finite"));
  points[17].v.z = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal(points), HasSubstr("point 18 is not finite"));
}

TEST(PointCheck, RefusesPointsInOnePlaceOrOnALine) {
  EXPECT_THAT(refusal(std::vector<Point<World>>(200, Point<World>{{0.1, 0.2, 0.3}})),
              HasSubstr("on a line or in one place"));
  std::vector<Point<World>> line;
  for (int i = 0; i < 200; ++i) {
    line.push_back({{0.0001 * i, 0.0002 * i, 0}});
  }
  EXPECT_THAT(refusal(line), HasSubstr("on a line or in one place"));
}

TEST(PointCheck, RefusesPointsInTheWrongUnit) {
  auto points = cloud(200);
  for (auto& p : points) {
    p.v = p.v * 1000.0;
  }
  EXPECT_THAT(refusal(points), HasSubstr("not in the unit given"));
  for (auto& p : points) {
    p.v = p.v * 1e-6;
  }
  EXPECT_THAT(refusal(points), HasSubstr("in one place"));
}

}  // namespace
}  // namespace orthonav::nav
