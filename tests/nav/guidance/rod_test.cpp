#include "nav/guidance/rod.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/random.h"
#include "nav/geometry/spline.h"

namespace orthonav::nav {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLengthTolerance_m = 1e-6;  // what the header promises

/// Five heads along a lordotic curve.
std::vector<Vec3> lordosis() {
  return {{0.021, 0.000, 0.090},
          {0.022, -0.006, 0.058},
          {0.020, -0.008, 0.027},
          {0.023, -0.003, -0.004},
          {0.025, 0.007, -0.030}};
}

/// Straight sums over a million chords: slow, simple, independent of the quadrature.
double length_by_chords_m(const CatmullRom& spline) {
  double sum_m = 0.0;
  constexpr int kChords = 200000;
  for (std::size_t s = 0; s < spline.segments(); ++s) {
    for (int i = 0; i < kChords; ++i) {
      sum_m +=
          (spline.position(s, (i + 1.0) / kChords) - spline.position(s, 1.0 * i / kChords)).norm();
    }
  }
  return sum_m;
}

/// The spline by Barry and Goldman's pyramid (1988), as textbooks give it.
Vec3 pyramid(std::span<const Vec3, 4> p, double t) {
  double u[4] = {0, 0, 0, 0};
  for (int i = 1; i < 4; ++i) {
    u[i] = u[i - 1] + std::sqrt((p[i] - p[i - 1]).norm());
  }
  const double x = u[1] + t * (u[2] - u[1]);
  const auto mix = [&](Vec3 a, Vec3 b, int i, int j) {
    return ((u[j] - x) * a + (x - u[i]) * b) / (u[j] - u[i]);
  };
  const Vec3 a1 = mix(p[0], p[1], 0, 1);
  const Vec3 a2 = mix(p[1], p[2], 1, 2);
  const Vec3 a3 = mix(p[2], p[3], 2, 3);
  return mix(mix(a1, a2, 0, 2), mix(a2, a3, 1, 3), 1, 2);
}

TEST(CatmullRom, PassesThroughItsPoints) {
  const auto points = lordosis();
  const auto spline = CatmullRom::through(points);
  ASSERT_TRUE(spline.ok());
  ASSERT_EQ(spline->segments(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT((spline->position(i, 0.0) - points[i]).norm(), 1e-15);
    EXPECT_LT((spline->position(i, 1.0) - points[i + 1]).norm(), 1e-15);
  }
}

TEST(CatmullRom, IsTheCentripetalSplineOfThePyramid) {
  const auto points = lordosis();
  const auto spline = CatmullRom::through(points);
  ASSERT_TRUE(spline.ok());
  for (std::size_t segment = 1; segment <= 2; ++segment) {
    for (const double t : {0.1, 0.37, 0.5, 0.93}) {
      const Vec3 expected = pyramid(std::span<const Vec3, 4>(&points[segment - 1], 4), t);
      EXPECT_LT((spline->position(segment, t) - expected).norm(), 1e-14);
    }
  }
}

TEST(CatmullRom, HasItsDerivativeAndNoCornerAtThePoints) {
  const auto spline = CatmullRom::through(lordosis());
  ASSERT_TRUE(spline.ok());
  constexpr double kStep = 1e-6;
  for (std::size_t s = 0; s < 4; ++s) {
    for (const double t : {0.2, 0.6}) {
      const Vec3 numeric =
          (spline->position(s, t + kStep) - spline->position(s, t - kStep)) / (2 * kStep);
      EXPECT_LT((spline->derivative(s, t) - numeric).norm(), 1e-9);
    }
  }
  for (std::size_t s = 0; s + 1 < 4; ++s) {
    EXPECT_LT(angle_between_rad(spline->derivative(s, 1.0), spline->derivative(s + 1, 0.0)), 1e-7);
  }
}

TEST(CatmullRom, MeasuresItsLengthToAMicrometre) {
  const auto spline = CatmullRom::through(lordosis());
  ASSERT_TRUE(spline.ok());
  EXPECT_NEAR(spline->length_m(), length_by_chords_m(*spline), kLengthTolerance_m);
  // A hairpin: speed varies a lot within a segment.
  const std::vector<Vec3> hairpin = {{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.002, 0}, {0, 0.002, 0}};
  const auto bent = CatmullRom::through(hairpin);
  ASSERT_TRUE(bent.ok());
  EXPECT_NEAR(bent->length_m(), length_by_chords_m(*bent), kLengthTolerance_m);
}

TEST(CatmullRom, IsAStraightLineThroughTwoPoints) {
  const std::vector<Vec3> two = {{0, 0, 0}, {0.03, 0.04, 0}};
  const auto spline = CatmullRom::through(two);
  ASSERT_TRUE(spline.ok());
  EXPECT_NEAR(spline->length_m(), 0.05, 1e-12);
  EXPECT_LT((spline->position(0, 0.5) - Vec3{0.015, 0.02, 0}).norm(), 1e-15);
}

TEST(CatmullRom, SamplesEvenlyAlongTheArc) {
  const auto spline = CatmullRom::through(lordosis());
  ASSERT_TRUE(spline.ok());
  const auto path = spline->sampled(0.001);
  const double step_m = spline->length_m() / static_cast<double>(path.size() - 1);
  EXPECT_NEAR(step_m, 0.001, 5e-6);
  EXPECT_EQ(path.front(), lordosis().front());
  EXPECT_EQ(path.back(), lordosis().back());
  for (std::size_t i = 1; i < path.size(); ++i) {
    EXPECT_NEAR((path[i] - path[i - 1]).norm(), step_m, 1e-6) << i;  // chord against arc
  }
}

TEST(CatmullRom, RefusesWhatIsNoCurve) {
  const std::vector<Vec3> one = {{0, 0, 0}};
  EXPECT_THAT(CatmullRom::through(one).error().message, HasSubstr("at least 2 points, got 1"));
  EXPECT_FALSE(CatmullRom::through({}).ok());
  const std::vector<Vec3> close = {{0, 0, 0}, {0.00009, 0, 0}};
  EXPECT_THAT(CatmullRom::through(close).error().message, HasSubstr("0.0900 mm apart"));
  const std::vector<Vec3> broken = {{0, 0, 0}, {0, kNaN, 0}};
  EXPECT_THAT(CatmullRom::through(broken).error().message, HasSubstr("point 1 is not finite"));
}

TEST(RodTemplate, OrdersTheHeadsAlongTheRod) {
  const auto heads = lordosis();
  const std::vector<Vec3> mixed = {heads[1], heads[4], heads[0], heads[3], heads[2]};
  const auto rod = rod_template(mixed);
  ASSERT_TRUE(rod.ok());
  std::vector<Vec3> expected = heads;
  EXPECT_EQ(rod->heads_m, expected);
  const std::vector<Vec3> upwards(heads.rbegin(), heads.rend());
  EXPECT_EQ(rod_template(upwards)->heads_m, upwards);  // begins where the surgeon began
}

TEST(RodTemplate, GivesLengthAndBends) {
  // Three heads, 30 and 40 mm apart, with a corner of 20 degrees.
  const double a = 20.0 * std::numbers::pi / 180.0;
  const std::vector<Vec3> heads = {
      {0, 0, 0}, {0.03, 0, 0}, {0.03 + 0.04 * std::cos(a), 0.04 * std::sin(a), 0}};
  const auto rod = rod_template(heads, 0.006);
  ASSERT_TRUE(rod.ok());
  EXPECT_DOUBLE_EQ(rod->diameter_m, 0.006);
  const auto spline = CatmullRom::through(heads);
  EXPECT_NEAR(rod->length_m, length_by_chords_m(*spline), kLengthTolerance_m);
  EXPECT_GT(rod->length_m, 0.07);  // longer than its chords
  ASSERT_EQ(rod->bends.size(), 1U);
  EXPECT_NEAR(rod->bends[0].angle_rad, a, 1e-12);
  EXPECT_EQ(rod->bends[0].position_m, heads[1]);
  EXPECT_NEAR(rod->bends[0].arc_length_m, spline->segment_length_m(0), 1e-12);
  EXPECT_EQ(rod->path_m.front(), heads.front());
  EXPECT_EQ(rod->path_m.back(), heads.back());
}

/// Three heads, 40 mm apart, with a corner in the middle; given in the order 3, 1, 2.
std::vector<Vec3> corner_of(double degrees) {
  const double a = degrees * std::numbers::pi / 180.0;
  return {{0.04 + 0.04 * std::cos(a), 0.04 * std::sin(a), 0}, {0, 0, 0}, {0.04, 0, 0}};
}

TEST(RodTemplate, RefusesABendThatNoRodTakes) {
  EXPECT_TRUE(rod_template(corner_of(59.9)).ok());
  EXPECT_EQ(rod_template(corner_of(60.1)).error().message,
            "rod bends by 60.1° at screw head 3, limit 60°");
}

TEST(RodTemplate, RefusesHeadsOfBothSidesAsPointsThatDoubleBack) {
  std::vector<Vec3> both;
  for (int level = 0; level < 4; ++level) {
    both.push_back({0.025, 0, 0.035 * level});
    both.push_back({-0.025, 0, 0.035 * level + 0.001});
  }
  EXPECT_THAT(rod_template(both).error().message,
              MatchesRegex("rod doubles back by 1[0-9.]+° at screw head [0-9], limit 60°"));
}

TEST(RodTemplate, RefusesTwentyRandomPoints) {
  Random random(5);
  std::vector<Vec3> points;
  for (int i = 0; i < 20; ++i) {
    points.push_back({random.uniform(0, 0.2), random.uniform(0, 0.2), random.uniform(0, 0.2)});
  }
  EXPECT_FALSE(rod_template(points).ok());
}

TEST(RodTemplate, ReachesFromT1ToThePelvisAndNoFarther) {
  const auto straight = [](int heads, double gap_m) {
    std::vector<Vec3> out;
    for (int i = 0; i < heads; ++i) {
      out.push_back({0, 0, gap_m * i});
    }
    return out;
  };
  EXPECT_TRUE(rod_template(straight(20, 0.0315)).ok()) << "598.5 mm";
  EXPECT_EQ(rod_template(straight(20, 0.032)).error().message, "rod is 608 mm long, limit 600 mm");
  EXPECT_TRUE(rod_template(straight(3, 0.1499)).ok());
  EXPECT_EQ(rod_template(straight(3, 0.1501)).error().message,
            "screw heads 1 and 2 are 150.1 mm apart, limit 5-150 mm");
}

TEST(RodTemplate, RefusesWhatIsNoRod) {
  const std::vector<Vec3> good = lordosis();
  EXPECT_THAT(rod_template(std::span(good).first(1)).error().message,
              HasSubstr("at least 2 screw heads, got 1"));
  std::vector<Vec3> twice = good;
  twice[3] = twice[0] + Vec3{0, 0, 0.0049};
  EXPECT_THAT(rod_template(twice).error().message,
              HasSubstr("screw heads 1 and 4 are 4.9 mm apart, limit 5-150 mm"));
  twice[3] = twice[0] + Vec3{0, 0, 0.0051};
  EXPECT_TRUE(rod_template(twice).ok());
  std::vector<Vec3> far = good;
  far[1].z = 40.0;
  EXPECT_THAT(rod_template(far).error().message, HasSubstr("limit 5-150 mm"));
  std::vector<Vec3> broken = good;
  broken[2].x = kNaN;
  EXPECT_THAT(rod_template(broken).error().message, HasSubstr("head 3 is not finite"));
  for (const double diameter_m : {0.0, -0.0055, 5.5, kNaN}) {
    EXPECT_THAT(rod_template(good, diameter_m).error().message, HasSubstr("limit 1-15 mm"));
  }
}

}  // namespace
}  // namespace orthonav::nav
