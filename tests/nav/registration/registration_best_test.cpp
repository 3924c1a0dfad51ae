// Registration `best` on strokes that it should accept: its errors, and its predictions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "tests/nav/registration/register_best.h"
#include "tests/support/anatomy.h"
#include "tests/support/stroke_truths.h"

namespace orthonav::nav::registration_best_test {
namespace {

using test::digitize_strokes;
using test::StrokeVariant;
using test::Tissue;
using ::testing::IsEmpty;

TEST_F(RegisterBest, AcceptsFullStrokesAndSaysHowSureItIs) {
  const auto r = register_by_pose_search(*l4().model, full_.tips(), options(l4(), {"L3", "L5"}));
  ASSERT_TRUE(r.ok()) << r.error().message;
  EXPECT_TRUE(r->accepted);
  EXPECT_THAT(r->reasons, IsEmpty());
  EXPECT_LT(error_m(l4(), r->world_from_vertebra, full_.world_from_vertebra), 0.0005);
  EXPECT_EQ(r->points, full_.samples.size());
  EXPECT_GT(r->log_likelihood_ratio, registration_limits().log_likelihood_ratio);
  EXPECT_GT(r->inlier_fraction, 0.9);
  EXPECT_GT(r->coverage_fraction, 0.3);
  EXPECT_THAT(r->fits_better, IsEmpty());
  EXPECT_LT(r->correlation_across_strokes, 0.2) << "bare bone: strokes have nothing in common";
  EXPECT_FALSE(r->heights.empty());
  EXPECT_GT(r->predicted_tre_m, 0.00002);
  EXPECT_LT(r->predicted_tre_m, 0.0005);
  EXPECT_GT(r->tre_95_m, r->predicted_tre_m);
  ASSERT_TRUE(r->weakest.has_value());
  EXPECT_GT(r->weakest->error_m, 0.0);
  EXPECT_TRUE(r->stroke_next.has_value());
  EXPECT_GE(r->runner_up_rmse_m, r->rmse_m);
}

/// Tissue of uneven thickness: accepted registrations are right; refused ones say why and where to
/// scrape.
TEST_F(RegisterBest, IsNeverSilentlyWrongOverSoftTissue) {
  int refused = 0;
  int scrape = 0;
  for (const Tissue tissue : orthonav::test::kTissues) {
    for (const double mean_m : {0.001, 0.002}) {
      auto strokes = digitize_strokes(l4().from.mesh, StrokeVariant::kFull, 31).value();
      apply_truths({tissue, mean_m, 0.0, 1}, l4().from.mesh, 7, strokes);
      const auto r = registered(strokes.tips());
      ASSERT_TRUE(r.ok()) << r.error().message;
      refused += r->accepted ? 0 : 1;
      if (r->accepted) {
        EXPECT_LT(error_m(l4(), r->world_from_vertebra, strokes.world_from_vertebra), kSilent_m)
            << name_of(tissue) << " " << mean_m;
      }
      for (const RefusalReason& reason : r->reasons) {
        scrape += reason.kind == RefusalReason::Kind::kSoftTissue && reason.scrape ? 1 : 0;
      }
    }
  }
  EXPECT_LE(refused, 7) << "of 10: tissue of 1 mm can be seen through";
  EXPECT_GT(scrape, 0);
}

TEST_F(RegisterBest, AStandoffOfHalfAMillimetreIsSolved) {
  auto strokes = full_;
  apply_truths({Tissue::kUniform, 0.0005, 0.0, 1}, l4().from.mesh, 7, strokes);
  const auto r = registered(strokes.tips());
  ASSERT_TRUE(r.ok()) << r.error().message;
  EXPECT_TRUE(r->accepted);
  EXPECT_NEAR(r->standoff_m, 0.0005, 0.0001);
  EXPECT_LT(error_m(l4(), r->world_from_vertebra, strokes.world_from_vertebra), 0.0003);
}

TEST_F(RegisterBest, WhatShiftsAllPointsAlikeIsPartOfTheErrorToExpect) {
  auto o = options(l4());
  const auto without = register_by_pose_search(*l4().model, full_.tips(), o);
  o.common = {0.0002, 0.0002, 0.0001};
  const auto with = register_by_pose_search(*l4().model, full_.tips(), o);
  ASSERT_TRUE(without.ok() && with.ok());
  const Point<Vertebra> entry = o.targets.front();
  EXPECT_NEAR(std::pow(with->uncertainty->predicted_tre_m(entry), 2),
              std::pow(without->uncertainty->predicted_tre_m(entry), 2) + 3.0 * 0.0003 * 0.0003,
              1e-12);
  EXPECT_EQ(with->predicted_tre_m, without->predicted_tre_m) << "what the limits are about";
  EXPECT_TRUE(with->accepted);
}

TEST_F(RegisterBest, IsNeverSilentlyWrongHoweverItWasStroked) {
  std::uint64_t seed = 20;
  int accepted = 0;
  for (const StrokeVariant variant : orthonav::test::kStrokeVariants) {
    for (int i = 0; i < 2; ++i, ++seed) {
      const auto strokes = digitize_strokes(l4().from.mesh, variant, seed).value();
      const auto r = registered(strokes.tips());
      ASSERT_TRUE(r.ok()) << r.error().message;
      EXPECT_NEAR(r->world_from_vertebra.rotation().determinant(), 1.0, 1e-9);
      accepted += r->accepted ? 1 : 0;
      EXPECT_EQ(r->accepted, r->reasons.empty());
      if (r->accepted) {
        EXPECT_LT(error_m(l4(), r->world_from_vertebra, strokes.world_from_vertebra), kSilent_m)
            << name_of(variant) << " seed " << seed;
      }
    }
  }
  EXPECT_GE(accepted, 8) << "of 10: who refuses all is never wrong either";
}

TEST_F(RegisterBest, SaysTheSameTwice) {
  const auto a = registered(full_.tips()).value();
  const auto b = registered(full_.tips()).value();
  EXPECT_EQ(a.world_from_vertebra.row_major(), b.world_from_vertebra.row_major());
  EXPECT_EQ(a.log_likelihood_ratio, b.log_likelihood_ratio);
  EXPECT_EQ(a.predicted_tre_m, b.predicted_tre_m);
  EXPECT_EQ(a.weakest, b.weakest);
  EXPECT_EQ(a.stroke_next, b.stroke_next);
}

/// The rotations that are searched lie in the frame of the points: another frame comes to the
/// optimum from another side, and the last step, of less than 10 um, leaves that much between them.
constexpr double kLastStep_m = 1e-5;

TEST_F(RegisterBest, FindsTheSamePoseInAnyFrame) {
  const auto first = registered(full_.tips()).value();
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Random random(seed);
    const Transform<World, World> other(
        test::random_rotation(random),
        {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)});
    Points points;
    for (const Point<World>& p : full_.tips()) {
      points.push_back(other * p);
    }
    const auto r = registered(points).value();
    EXPECT_TRUE(r.accepted);
    EXPECT_LT(error_m(l4(), r.world_from_vertebra, other * first.world_from_vertebra), kLastStep_m);
    EXPECT_NEAR(r.predicted_tre_m / first.predicted_tre_m, 1.0, 0.02);
  }
}

TEST_F(RegisterBest, IsNotMisledByClumpsAndStrays) {
  // The tip rested for a minute in one place.
  Points rested = full_.tips();
  rested.insert(rested.end(), 1800, rested.back());
  // One sample in a hundred is somewhere else altogether.
  Points strays = full_.tips();
  for (std::size_t i = 0; i < strays.size(); i += 100) {
    strays[i].v += Vec3{0.1, -0.2, 0.3};
  }
  for (const Points& points : {rested, strays}) {
    const auto r = registered(points);
    ASSERT_TRUE(r.ok()) << r.error().message;
    EXPECT_LT(error_m(l4(), r->world_from_vertebra, full_.world_from_vertebra), 0.0005);
  }
}

}  // namespace
}  // namespace orthonav::nav::registration_best_test
