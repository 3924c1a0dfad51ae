#include "tests/support/stroke_truths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/phantom/phantom.h"

namespace orthonav::test {
namespace {

class StrokeTruthsTest : public ::testing::Test {
 protected:
  [[nodiscard]] DigitizedStrokes strokes() const {
    return digitize_strokes(mesh_, StrokeVariant::kFull, 1).value();
  }
  const nav::TriangleMesh mesh_ = engine::phantom({"L4"}).levels.at(0).mesh;
};

TEST_F(StrokeTruthsTest, LiftTheTipByTheThicknessThatTheySay) {
  const DigitizedStrokes bare = strokes();
  for (const Tissue tissue : kTissues) {
    DigitizedStrokes lifted = bare;
    apply_truths({.tissue = tissue, .mean_tissue_m = 0.001}, mesh_, 3, lifted);
    double mean_m = 0.0;
    double square_m2 = 0.0;
    for (std::size_t i = 0; i < bare.samples.size(); ++i) {
      const Vec3 off = lifted.samples[i].true_tip - bare.samples[i].true_tip;
      const double height_m = off.dot(bare.samples[i].normal);
      EXPECT_GE(height_m, 0.0);
      EXPECT_NEAR(off.norm(), height_m, 1e-12);
      mean_m += height_m / static_cast<double>(bare.samples.size());
      square_m2 += height_m * height_m / static_cast<double>(bare.samples.size());
    }
    EXPECT_NEAR(mean_m, 0.001, 0.0001) << name_of(tissue);
    const double sd_m = std::sqrt(std::max(0.0, square_m2 - mean_m * mean_m));
    EXPECT_NEAR(sd_m, tissue == Tissue::kUniform ? 0.0 : 0.0005, 0.0001) << name_of(tissue);
    DigitizedStrokes again = bare;
    apply_truths({.tissue = tissue, .mean_tissue_m = 0.001}, mesh_, 3, again);
    EXPECT_EQ(again.tips().back().v.x, lifted.tips().back().v.x) << name_of(tissue);
  }
}

TEST_F(StrokeTruthsTest, ShiftAllPointsAlikeAndRepeatThem) {
  const DigitizedStrokes bare = strokes();
  DigitizedStrokes moved = bare;
  apply_truths({.common_sd_m = 0.0002, .copies = 3}, mesh_, 3, moved);
  ASSERT_EQ(moved.samples.size(), 3 * bare.samples.size());
  const Vec3 common = moved.tips()[0] - bare.tips()[0];
  EXPECT_GT(common.norm(), 0.0);
  EXPECT_LT((moved.tips().back() - bare.tips().back() - common).norm(), 1e-12);
}

TEST_F(StrokeTruthsTest, ResampleReorderAndMirrorThem) {
  const DigitizedStrokes bare = strokes();
  const std::size_t count = bare.samples.size();
  DigitizedStrokes twice = bare;
  apply_truths({.copies = 2, .copy_jitter_m = 0.00002}, mesh_, 3, twice);
  ASSERT_EQ(twice.samples.size(), 2 * count);
  double square_m2 = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(twice.tips()[2 * i].v.x, bare.tips()[i].v.x);
    square_m2 +=
        (twice.tips()[2 * i + 1] - bare.tips()[i]).squared_norm() / static_cast<double>(count);
  }
  EXPECT_NEAR(std::sqrt(square_m2 / 3.0), 0.00002, 0.000002);
  DigitizedStrokes other = bare;
  apply_truths({.shuffled = true, .left_handed = true}, mesh_, 3, other);
  ASSERT_EQ(other.samples.size(), count);
  const auto is_first = [&](const DigitizedSample& s) {
    return s.tip.v.x == -bare.tips()[0].v.x && s.tip.v.y == bare.tips()[0].v.y;
  };
  const auto first = std::find_if(other.samples.begin(), other.samples.end(), is_first);
  EXPECT_NE(first, other.samples.begin());
  EXPECT_NE(first, other.samples.end());
}

TEST_F(StrokeTruthsTest, AModelIsSegmentedScaledAndMirrored) {
  const nav::TriangleMesh rough = segmented(mesh_, 0.0005, 1);
  double square_m2 = 0.0;
  for (std::size_t i = 0; i < mesh_.vertices_m.size(); ++i) {
    square_m2 += (rough.vertices_m[i] - mesh_.vertices_m[i]).squared_norm() /
                 static_cast<double>(mesh_.vertices_m.size());
  }
  EXPECT_NEAR(std::sqrt(square_m2), 0.0005, 1e-6);
  EXPECT_TRUE(nav::checked_bone(scaled(mesh_, 0.97)).ok());
  const nav::TriangleMesh other = mirrored(mesh_);
  EXPECT_TRUE(nav::checked_bone(other).ok());
  EXPECT_EQ(other.vertices_m[5].x, -mesh_.vertices_m[5].x);
}

}  // namespace
}  // namespace orthonav::test
