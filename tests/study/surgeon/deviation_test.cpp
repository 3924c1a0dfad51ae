#include "study/surgeon/deviation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "study/surgeon/shown_cross.h"

namespace orthonav::sim::deviation_test {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;
/// A sine and an arc sine over lengths of centimetres.
constexpr double kRounding_rad = 1e-12;
constexpr Vec3 kEntry{0.1, 0.2, -0.3};
constexpr Vec3 kPlanned{0, 1, 0};

/// A tool that leans towards x, its tip beside the entry, and the number shown for it.
struct Tool {
  double lean_rad = 0.0;
  Vec3 beside_m;  ///< across the planned axis
  double number_rad = 0.0;
  [[nodiscard]] Vec3 axis() const { return {std::sin(lean_rad), std::cos(lean_rad), 0}; }
};

ShownFrame frame_of(const Tool& tool) {
  const Vec3 off = tool.beside_m - tool.axis() * tool.beside_m.dot(tool.axis());
  const double half_chord_m = std::sqrt(kCrossReach_m * kCrossReach_m - off.squared_norm());
  const auto dot = [](Vec3 offset) {
    const double held = std::min(1.0, kCrossRim_m / std::max(kCrossRim_m, offset.norm()));
    return Point<World>{kEntry + kCrossScale * held * offset};
  };
  const Vec3 top = tool.beside_m + kCrossReach_m * Vec3{tool.axis().x, 0, 0};
  ShownFrame frame;
  frame.holograms = {
      {.kind = HologramKind::kTriangle,
       .points_in_world = {{kEntry},
                           {kEntry + off + half_chord_m * tool.axis()},
                           {kEntry + kCrossReach_m * kPlanned}}},
      {.kind = HologramKind::kAngle, .reading = tool.number_rad},
      {.kind = HologramKind::kCross, .points_in_world = {{kEntry}, dot(tool.beside_m), dot(top)}}};
  return frame;
}

std::optional<Deviation> read(const ShownFrame& frame) {
  Eyes eyes;
  eyes.see(frame, Transform<Room, World>{Mat3::identity(), {}});
  return read_deviation(eyes);
}

/// The angle at A, which the triangle shows.
double angle_of_triangle_rad(const ShownFrame& frame) {
  const auto& points = frame.holograms[0].points_in_world;
  return angle_between_rad(points[1] - points[0], points[2] - points[0]);
}

TEST(ReadDeviation, IsThatOfTheDirectionsWhereverTheTipStands) {
  // Near, with both dots off the rim, and far, where the direction is the triangle's.
  for (const double lean_deg : {0.5, 2.0, 8.0}) {
    for (const Vec3 beside_m : {Vec3{}, Vec3{0, 0, 0.003}, Vec3{-0.002, 0, 0.001}}) {
      const Tool tool{lean_deg * kDeg, beside_m, lean_deg * kDeg};
      const auto reading = read(frame_of(tool));
      ASSERT_TRUE(reading) << lean_deg;
      // About the axis that takes the tool, which leans towards x, onto y.
      EXPECT_LT((reading->rotation_rad - Vec3{0, 0, lean_deg * kDeg}).norm(), kRounding_rad)
          << lean_deg;
    }
  }
}

TEST(ReadDeviation, IsNotTheAngleOfTheTriangle) {
  const ShownFrame frame = frame_of({0.0, {0.003, 0, 0}, 0.0});
  const auto reading = read(frame);
  ASSERT_TRUE(reading);
  EXPECT_LT(reading->rotation_rad.norm(), kRounding_rad);
  EXPECT_GT(angle_of_triangle_rad(frame), 2.0 * kDeg) << "or this shows nothing";
}

TEST(ReadDeviation, IsNothingWhereDotsAndNumberDisagreeByMoreThanADegree) {
  EXPECT_TRUE(read(frame_of({2.0 * kDeg, {}, 2.99 * kDeg})));
  EXPECT_FALSE(read(frame_of({2.0 * kDeg, {}, 3.01 * kDeg})));
}

TEST(ReadDeviation, IsNothingWhereAPartIsMissingOrNoNumber) {
  const ShownFrame whole = frame_of({2.0 * kDeg, {}, 2.0 * kDeg});
  ASSERT_TRUE(read(whole));
  for (std::size_t i = 0; i < whole.holograms.size(); ++i) {
    ShownFrame frame = whole;
    frame.holograms.erase(frame.holograms.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_FALSE(read(frame)) << i;
  }
  ShownFrame bound = whole;
  bound.holograms[1].reading.reset();
  EXPECT_TRUE(read(bound)) << "the dots say it";
  ShownFrame without_dots = whole;
  without_dots.holograms[2].points_in_world.resize(1);
  EXPECT_FALSE(read(without_dots));
  for (const double lean_deg : {2.0, 8.0}) {
    for (const auto& [hologram, point] : {std::pair{0U, 1U}, {0U, 2U}, {2U, 1U}, {2U, 2U}}) {
      ShownFrame broken = frame_of({lean_deg * kDeg, {}, lean_deg * kDeg});
      broken.holograms[hologram].points_in_world[point].v.x =
          std::numeric_limits<double>::quiet_NaN();
      const auto reading = read(broken);
      EXPECT_TRUE(!reading || reading->rotation_rad.is_finite()) << hologram << " " << point;
    }
  }
}

TEST(ReadTipOffset, HasItsDirectionByTheDotAndItsSizeByTheNumber) {
  const auto read = [](std::optional<double> number_m, bool dots) {
    ShownFrame frame = frame_of({0.0, {0.0012, 0, 0.0005}, 0.0});
    frame.holograms.push_back({.kind = HologramKind::kNumbers, .reading = number_m});
    frame.holograms[2].points_in_world.resize(dots ? 3 : 1);
    Eyes eyes;
    eyes.see(frame, Transform<Room, World>{Mat3::identity(), {}});
    return read_tip_offset(eyes, kPlanned);
  };
  const double away_m = std::hypot(0.0012, 0.0005);
  const Vec3 towards = Vec3{0.0012, 0, 0.0005} / away_m;
  EXPECT_LT((read(0.0014, true).value() - 0.0014 * towards).norm(), kRounding_rad);
  EXPECT_LT((read({}, true).value() - away_m * towards).norm(), kRounding_rad) << "a bound";
  EXPECT_FALSE(read(0.0014, false));
}

}  // namespace
}  // namespace orthonav::sim::deviation_test
