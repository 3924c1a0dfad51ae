#include "nav/registration/residual_field.h"

#include <gtest/gtest.h>

#include "tests/nav/registration/residual_field_fixture.h"

namespace orthonav::nav::residual_field_test {
namespace {

TEST_F(ResidualFieldTest, PredictsTheErrorsOfStrokesWithCorrelatedNoise) {
  const Compared c = compare({}, 10);
  EXPECT_NEAR(c.ratio(), 1.0, kHonest);
  // If all points were taken as independent, the same check would fail.
  EXPECT_LT(c.ratio() * std::sqrt(c.effective_points / 850.0), 1.0 - 2.0 * kHonest);
  EXPECT_LT(c.field_m, 0.00025) << "noise is no tissue";
}

TEST_F(ResidualFieldTest, PredictsTheErrorsOfIndependentNoise) {
  const Compared c = compare({0.0005, 0.0, 0.0, false}, 10);
  EXPECT_NEAR(c.ratio(), 1.0, kHonest);
  EXPECT_GT(c.effective_points, 500.0) << "of 850, each of which tells something else";
  EXPECT_LE(c.effective_points, 850.0);
}

TEST_F(ResidualFieldTest, PredictsTheErrorsOfPointsInNoOrder) {
  const Compared c = compare({0.0003, 0.0004, 0.3, true}, 10);
  EXPECT_GT(c.ratio(), 1.0 - kHonest);
  EXPECT_LT(c.ratio(), 1.5) << "what goes together cannot be told: rather too careful";
  EXPECT_LT(c.effective_points, 400.0) << "neighbours in space count as one";
}

/// Tissue as waves over the bone, which the field's model does not include.
TEST_F(ResidualFieldTest, PredictsTheErrorsOfTissueOfUnevenThickness) {
  const Compared c = compare({0.0002, 0.0, 0.3, false, 0.001}, 12);
  EXPECT_GT(c.ratio(), 1.0 - kHonest);
  EXPECT_LT(c.ratio(), 2.0) << "honest, not timid";
  EXPECT_GT(c.field_m, 0.0003);
  EXPECT_LT(c.effective_points, 120.0) << "of 850: places side by side are under the same tissue";
}

TEST_F(ResidualFieldTest, RepeatedPointsSayNothingNew) {
  Random random(5);
  const std::vector<Vec3> places = noisy_strokes(random);
  std::vector<Vec3> copies;
  for (const Vec3& p : places) {
    copies.insert(copies.end(), 20, p);
  }
  for (int round = 0; round < 2; ++round) {
    copies.insert(copies.end(), places.begin(), places.end());
  }
  const auto sd_m = [&](std::span<const Vec3> points) {
    Random same(6);
    const CentredPoints cloud = test::centred_somewhere(points, same);
    const auto fit = fit_to_surface(surface_, cloud.points_m, cloud.truth, {});
    const auto field = field_of(*fit);
    return PoseUncertainty(fit->pose.centre_m, field->covariance).predicted_tre_m(kTargets[0]);
  };
  EXPECT_NEAR(sd_m(copies) / sd_m(places), 1.0, 0.1);
}

TEST_F(ResidualFieldTest, TellsTheSizeOfTheBone) {
  for (const double size : {0.96, 1.0, 1.04}) {
    Random random(7);
    std::vector<Vec3> places = noisy_strokes(random);
    for (Vec3& p : places) {
      p = size * p;
    }
    const CentredPoints cloud = test::centred_somewhere(places, random);
    SurfaceFitOptions options;
    const auto fit = fit_to_surface(surface_, cloud.points_m, cloud.truth, options);
    const auto field = field_of(*fit);
    ASSERT_TRUE(field.has_value());
    EXPECT_NEAR(field->size, size, 0.012) << size;
    EXPECT_EQ(field->size_log_evidence > 2.5, size != 1.0) << field->size_log_evidence;
  }
}

TEST_F(ResidualFieldTest, AStandoffIsFoundAndNeverNegative) {
  for (const double standoff_m : {0.0, 0.0005, 0.002}) {
    Random random(8);
    std::vector<Vec3> places = noisy_strokes(random);
    for (Vec3& p : places) {
      p += standoff_m * surface_.nearest(p)->normal;
    }
    const CentredPoints cloud = test::centred_somewhere(places, random);
    SurfaceFitOptions options;
    options.with_standoff = true;
    const auto fit = fit_to_surface(surface_, cloud.points_m, cloud.truth, options);
    const auto field = field_of(*fit);
    ASSERT_TRUE(field.has_value());
    EXPECT_GE(field->standoff_m, 0.0);
    EXPECT_NEAR(field->standoff_m, standoff_m, std::max(0.0001, 3.0 * field->standoff_sd_m));
  }
}

/// A fit of noisy places to a surface, from the true pose. It always has a result, since damping
/// holds undetermined motions.
SurfaceFit fit_from_truth(const SurfaceIndex& surface, std::vector<Vec3> places) {
  Random random(4);
  for (Vec3& p : places) {
    p += Vec3{random.normal(0, 0.0002), random.normal(0, 0.0002), random.normal(0, 0.0002)};
  }
  const CentredPoints cloud = test::centred_somewhere(places, random);
  const auto fit = fit_to_surface(surface, cloud.points_m, cloud.truth, {});
  EXPECT_TRUE(fit.has_value());
  return fit.value_or(SurfaceFit{});
}

/// Far more units than the minimum of 12, so that their number is not the reason for a missing
/// result.
constexpr std::size_t kEnoughUnits = 40;
constexpr std::size_t kManyUnits = 1000;

TEST_F(ResidualFieldTest, IsNoneWhenAMotionIsOpen) {
  // On a flat front three motions are open.
  Random random(4);
  std::vector<Vec3> flat;
  for (int i = 0; i < 500; ++i) {
    flat.push_back({random.uniform(-0.02, 0.02), -0.02, random.uniform(-0.01, 0.01)});
  }
  const SurfaceFit on_front = fit_from_truth(surface_, flat);
  EXPECT_GE(residual_units(on_front, kManyUnits).all.size(), kEnoughUnits);
  EXPECT_FALSE(field_of(on_front).has_value());
  // Along a straight crest one is.
  const TriangleMesh straight =
      test::slab_bone([](double x, double) { return 0.012 * std::exp(-x * x / (0.007 * 0.007)); });
  const SurfaceIndex crest(straight);
  const SurfaceFit on_crest = fit_from_truth(crest, test::strokes_over(crest, 10));
  EXPECT_GE(residual_units(on_crest, kManyUnits).all.size(), kEnoughUnits);
  EXPECT_FALSE(field_of(on_crest).has_value());
  // The control: the same strokes over a back on which no motion is undetermined.
  EXPECT_TRUE(field_of(fit_from_truth(surface_, test::strokes_over(surface_, 10))));
}

TEST_F(ResidualFieldTest, IsNoneOfTooFewPoints) {
  // Spread over a back on which no motion is undetermined: only their number is too small.
  const std::vector<Vec3> places = test::strokes_over(surface_, 10);
  const auto spread = [&](std::size_t count) {
    std::vector<Vec3> some;
    for (std::size_t i = 0; i < count; ++i) {
      some.push_back(places[i * places.size() / count]);
    }
    return fit_from_truth(surface_, some);
  };
  EXPECT_FALSE(field_of(spread(11)).has_value());
  EXPECT_TRUE(field_of(spread(100)).has_value());
}

}  // namespace
}  // namespace orthonav::nav::residual_field_test
