// Flaws of a tag besides its size: bent, glossy, under flickering light, with blood on it.
#include "hal/sim/room/tag_flaws.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/hal/sim/test_rooms.h"

namespace orthonav::sim::tag_flaws_test {
namespace {

RoomDescription flawed(const ErrorModel& model, std::uint64_t seed) {
  return with_flawed_tags(synthetic_case().room, model, Random(seed));
}

TEST(TagFlaws, BowHasItsSdAndIsNoneInAPerfectWorld) {
  ErrorModel model;
  model.tag_bow_m = 0.0002;
  double squares = 0.0;
  int n = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    for (const TagFlaws& flaws : flawed(model, seed).tag_flaws) {
      squares += flaws.bow_m * flaws.bow_m;
      ++n;
    }
  }
  EXPECT_NEAR(std::sqrt(squares / n), 0.0002, 0.00002);
  for (const TagFlaws& flaws : flawed(ErrorModel::perfect(), 1).tag_flaws) {
    EXPECT_EQ(flaws.bow_m, 0.0);
    EXPECT_TRUE(flaws.drops.empty());
  }
}

TEST(TagFlaws, ABentTagIsAsHighAtItsEdgesAsItIsBentAndFlatOnAverage) {
  const TagFlaws flaws{0.0003, 0.4, {}};
  const Vec2 across{std::cos(0.4), std::sin(0.4)};
  const double middle_m = height_m(flaws, 0.04, {0, 0});
  EXPECT_NEAR(height_m(flaws, 0.04, 0.02 * across) - middle_m, 0.0003, 1e-12);
  EXPECT_NEAR(height_m(flaws, 0.04, 0.02 * Vec2{-across.y, across.x}) - middle_m, 0.0, 1e-12);
  double sum = 0.0;
  for (int i = 0; i < 100; ++i) {
    for (int k = 0; k < 100; ++k) {
      sum += height_m(flaws, 0.04, {0.0004 * (i - 49.5), 0.0004 * (k - 49.5)});
    }
  }
  EXPECT_NEAR(sum / 1e4, 0.0, 1e-7);
}

TEST(TagFlaws, GlareIsWholeInTheMirrorAndGoneAside) {
  const Vec3 lamp{0, 1, 0};
  const Vec3 viewer = Vec3{1, 1, 0}.normalized();
  const Vec3 mirrors = (lamp + viewer).normalized();
  EXPECT_NEAR(glare(0.3, mirrors, lamp, viewer), 0.3, 1e-12);
  EXPECT_LT(glare(0.3, lamp, lamp, viewer), 0.001);
  EXPECT_EQ(glare(0.3, -1.0 * mirrors, lamp, viewer), 0.0);
}

TEST(TagFlaws, LightFlickersAboutItsMean) {
  ErrorModel model = ErrorModel::perfect();
  EXPECT_EQ(flicker(model, 0.0123), 1.0);
  model.light_flicker = 0.05;
  EXPECT_NEAR(flicker(model, 0.0025), 1.05, 1e-9);
  EXPECT_NEAR(flicker(model, 0.0075), 0.95, 1e-9);
  model.exposure_s = 0.010;  // a whole period
  EXPECT_NEAR(flicker(model, 0.0025), 1.0, 1e-9);
}

TEST(TagFlaws, DropsFallAsOftenAsTheyShouldAndCoverCornersWhereTheyLieOnThem) {
  ErrorModel model = ErrorModel::perfect();
  model.drops_per_tag = 1.5;
  model.drop_m = 0.004;
  std::size_t drops = 0;
  std::size_t tags = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    for (const TagFlaws& flaws : flawed(model, seed).tag_flaws) {
      drops += flaws.drops.size();
      ++tags;
    }
  }
  EXPECT_NEAR(static_cast<double>(drops) / static_cast<double>(tags), 1.5, 0.2);
  EXPECT_TRUE(covers_a_corner({0.0, 0.0, {{{0.019, -0.021}, 0.002}}}, 0.04));
  EXPECT_FALSE(covers_a_corner({0.0, 0.0, {{{0.0, -0.021}, 0.002}}}, 0.04));
}

}  // namespace
}  // namespace orthonav::sim::tag_flaws_test
