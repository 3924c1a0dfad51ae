// The patient's part of the room: bone off its model, soft tissue, breath, and the map's steps.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hal/sim/room/noise.h"
#include "hal/sim/room/spine_motion.h"
#include "hal/sim/room/surface_field.h"
#include "hal/sim/surgeon/stroke_plan.h"
#include "tests/hal/sim/test_rooms.h"

namespace orthonav::sim {
namespace {

TEST(SurfaceField, HasItsSdAndIsAlikeOverItsLength) {
  constexpr double kSd = 0.5;
  constexpr double kLength = 0.007;
  double squares = 0.0;
  double near = 0.0;
  double far = 0.0;
  int n = 0;
  for (int seed = 0; seed < 300; ++seed) {
    const SurfaceField field(Random(static_cast<std::uint64_t>(seed)), kSd, kLength);
    const double here = field.at({0.01, 0.02, 0.03});
    squares += here * here;
    near += here * field.at({0.01 + kLength, 0.02, 0.03});
    far += here * field.at({0.01 + 5.0 * kLength, 0.02, 0.03});
    ++n;
  }
  // 300 independent fields: the variance is known to 8 %, three of these; a correlation to 0.06.
  EXPECT_NEAR(squares / n, kSd * kSd, 0.25 * kSd * kSd);
  EXPECT_NEAR(near / squares, std::exp(-0.5), 0.18);
  EXPECT_NEAR(far / squares, 0.0, 0.18);
}

TEST(BonesOffTheirModels, AreOffByTheMagnitudeAndNotAtAllInAPerfectWorld) {
  const RoomDescription models = synthetic_case().room;
  ErrorModel error_model;
  error_model.model_error_m = 0.0005;
  const RoomDescription bones = with_bones_off_their_models(models, error_model, Random(1));
  double squares = 0.0;
  std::size_t n = 0;
  for (std::size_t level = 0; level < models.levels.size(); ++level) {
    for (std::size_t i = 0; i < models.levels[level].vertices_m.size(); ++i, ++n) {
      squares +=
          (bones.levels[level].vertices_m[i] - models.levels[level].vertices_m[i]).squared_norm();
    }
  }
  // The vertices of a bone are some dozens of independent places.
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(n)), 0.0005, 0.00015);
  const RoomDescription same =
      with_bones_off_their_models(models, ErrorModel::perfect(), Random(1));
  EXPECT_EQ(same.levels[0].vertices_m, models.levels[0].vertices_m);
}

/// A stroke across a furrow 8 mm deep: its walls rise to both sides.
Stroke across_a_furrow(double z_m) {
  Stroke stroke;
  for (int i = -20; i <= 20; ++i) {
    const double x_m = 0.0005 * i;
    stroke.spots.push_back({{x_m, 0.8 * std::abs(x_m), z_m}, {0, 1, 0}});
    stroke.arc_m.push_back(0.0005 * (i + 20));
  }
  return stroke;
}

TEST(SoftTissue, IsAsThickOnAverageAsItShouldAndThickerInValleys) {
  std::vector<StrokeRegion> regions(1);
  for (int line = 0; line < 40; ++line) {
    regions[0].strokes.push_back(across_a_furrow(0.003 * line));
  }
  cover_with_tissue(regions, 0.001, Random(1));
  double sum = 0.0;
  double bottom = 0.0;
  double top = 0.0;
  for (const Stroke& stroke : regions[0].strokes) {
    ASSERT_EQ(stroke.tissue_m.size(), stroke.spots.size());
    for (const double thickness_m : stroke.tissue_m) {
      EXPECT_GE(thickness_m, 0.0);
      sum += thickness_m / static_cast<double>(stroke.tissue_m.size());
    }
    bottom += stroke.tissue_at(0.010);
    top += stroke.tissue_at(0.0);
  }
  EXPECT_NEAR(sum / 40, 0.001, 1e-9);
  EXPECT_GT(bottom, 2.0 * top);
}

TEST(SoftTissue, IsNoneWhereThereIsNone) {
  std::vector<StrokeRegion> regions(1);
  regions[0].strokes.push_back(across_a_furrow(0.0));
  cover_with_tissue(regions, 0.0, Random(1));
  EXPECT_EQ(regions[0].strokes[0].tissue_at(0.010), 0.0);
}

TEST(SoftTissue, GivesWayToWhatPressesOnIt) {
  Stroke stroke = across_a_furrow(0.0);
  stroke.tissue_m.assign(stroke.spots.size(), 0.002);
  const BoneSpot bone = stroke.at(0.004);
  EXPECT_EQ(stroke.on_tissue(0.004, 0.0).point, bone.point);
  EXPECT_EQ(stroke.on_tissue(0.004, 0.25).point, bone.point + 0.25 * 0.002 * bone.normal);
  EXPECT_EQ(stroke.on_tissue(0.004, 1.0).normal, bone.normal);
}

TEST(SpineMotion, GoesItsWholeWayAboutItsMean) {
  ErrorModel error_model;
  error_model.breathing_m = 0.002;
  error_model.breathing_hz = 0.25;
  const SpineMotion spine(Random(3), error_model);
  Vec3 sum;
  double low = 1.0;
  double high = -1.0;
  constexpr int kSteps = 4000;  // 40 s, ten breaths
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 at = spine.at(0.01 * i);
    sum += at;
    const double along = at.dot(Vec3{0.0, 0.9, 0.4}.normalized());
    low = std::min(low, along);
    high = std::max(high, along);
  }
  EXPECT_NEAR(high - low, 0.002, 2e-6);
  EXPECT_LT((sum / kSteps).norm(), 2e-6);
  EXPECT_EQ(SpineMotion(Random(3), ErrorModel::perfect()).at(1.0), Vec3{});
}

TEST(SpineMotion, IsGreatestInTheLowerThoracicSpineAndLessInLumbarLevels) {
  EXPECT_EQ(fraction_of_breath("T11"), 1.0);
  EXPECT_NEAR(fraction_of_breath("L1"), 1.6 / 1.96, 1e-12);
  EXPECT_NEAR(fraction_of_breath("L3"), 1.45 / 1.96, 1e-12);
  EXPECT_NEAR(fraction_of_breath("L5"), 1.3 / 1.96, 1e-12);
  EXPECT_EQ(fraction_of_breath("S1"), 0.5);
  EXPECT_LT(fraction_of_breath("T1"), fraction_of_breath("T9"));
  EXPECT_EQ(fraction_of_breath("bone"), 1.0);
}

TEST(MapDrift, StepsAsOftenAndAsFarAsToldAndLeavesTheWalkAsItWas) {
  constexpr double kLength_s = 6000.0;
  const MapDrift walk(Random(1), 0.0001, 0.0, kLength_s);
  const MapDrift stepping(Random(1), 0.0001, 0.0, kLength_s, {0.002, 2.0});
  int steps = 0;
  double squares = 0.0;
  Vec3 before;
  for (int i = 1; i < static_cast<int>(kLength_s); ++i) {
    const Vec3 apart = stepping.at(i).translation_m - walk.at(i).translation_m;
    if ((apart - before).norm() > 1e-9) {
      ++steps;
      squares += (apart - before).squared_norm();
    }
    before = apart;
  }
  EXPECT_NEAR(steps, 200, 45);  // three SDs of a count
  EXPECT_NEAR(std::sqrt(squares / (3.0 * steps)), 0.002, 0.00025);
}

}  // namespace
}  // namespace orthonav::sim
