// Results from the heights of strokes besides the pose.
#include "nav/registration/estimated_heights.h"

#include <gtest/gtest.h>

#include "tests/nav/registration/residual_field_fixture.h"

namespace orthonav::nav::residual_field_test {
namespace {

/// Each stroke at a height of its own, wherever it goes.
TEST_F(ResidualFieldTest, PredictsTheErrorsOfStrokesThatArePressedUnalike) {
  const Compared c = compare({0.0002, 0.0, 0.3, false, 0.0, 0.0005}, 12);
  EXPECT_GT(c.ratio(), 1.0 - kHonest);
  EXPECT_LT(c.ratio(), 2.0) << "honest, not timid";
  EXPECT_LT(c.effective_points, 200.0) << "of 850";
}

TEST_F(ResidualFieldTest, ResampledPointsSayNothingNew) {
  Random random(5);
  const std::vector<Vec3> places = noisy_strokes(random);
  const auto units_of = [&](double jitter_m) {
    std::vector<Vec3> copies;
    for (const Vec3& p : places) {
      copies.push_back(p);
      for (int copy = 0; copy < 3; ++copy) {
        copies.push_back(p + Vec3{random.normal(0, jitter_m), random.normal(0, jitter_m),
                                  random.normal(0, jitter_m)});
      }
    }
    const CentredPoints cloud = test::centred_somewhere(copies, random);
    return residual_units(*fit_to_surface(surface_, cloud.points_m, cloud.truth, {}), 160);
  };
  EXPECT_LE(units_of(0.00001).order.size(), places.size());
  EXPECT_GT(units_of(0.00001).order.size(), places.size() * 9 / 10);
  // The twin: places that are apart are different ones.
  EXPECT_GT(units_of(0.0002).order.size(), 3 * places.size());
}

/// In such an order that no stroke begins within 8 mm of where the last one ended.
std::vector<Vec3> apart(const std::vector<Vec3>& places, std::size_t lanes) {
  const std::size_t a_stroke = places.size() / lanes;
  std::vector<Vec3> out;
  for (std::size_t k = 0; k < lanes; ++k) {
    const auto from = places.begin() + static_cast<std::ptrdiff_t>(7 * k % lanes * a_stroke);
    out.insert(out.end(), from, from + static_cast<std::ptrdiff_t>(a_stroke));
  }
  return out;
}

TEST_F(ResidualFieldTest, EstimatesTheTissueAndFindsWhatStrokesHaveInCommon) {
  for (const double tissue_m : {0.0, 0.001}) {
    Random random(9);
    std::vector<Vec3> places = apart(test::strokes_over(surface_, 16), 16);
    if (tissue_m > 0.0) {
      lift(tissue_m, random, places);
    }
    std::vector<Vec3> noisy = places;
    for (Vec3& p : noisy) {
      p += Vec3{random.normal(0, 0.0002), random.normal(0, 0.0002), random.normal(0, 0.0002)};
    }
    const CentredPoints cloud = test::centred_somewhere(noisy, random);
    SurfaceFitOptions options;
    options.with_standoff = true;
    const auto fit = fit_to_surface(surface_, cloud.points_m, cloud.truth, options);
    ASSERT_TRUE(fit.has_value());
    const auto field = field_of(*fit);
    ASSERT_TRUE(field.has_value());
    const ResidualUnits units = residual_units(*fit, kMaxUnits);
    const double correlation = correlation_across_strokes(*fit, units);
    EXPECT_EQ(correlation > 0.2, tissue_m > 0.0) << correlation;
    const auto heights = estimated_heights(*fit, units, *field);
    ASSERT_GT(heights.size(), 50U);
    double square_m2 = 0.0;
    for (const EstimatedHeight& h : heights) {
      const auto truth = std::min_element(places.begin(), places.end(), [&](Vec3 a, Vec3 b) {
        return (a - h.at.v).squared_norm() < (b - h.at.v).squared_norm();
      });
      const double off_m = h.height_m - surface_.nearest(*truth)->distance_m;
      square_m2 += off_m * off_m / static_cast<double>(heights.size());
    }
    // The tissue's height varies by 0.6 mm where there is any.
    EXPECT_LT(std::sqrt(square_m2), 0.0003) << tissue_m;
  }
}

}  // namespace
}  // namespace orthonav::nav::residual_field_test
