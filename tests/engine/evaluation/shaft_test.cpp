#include <gtest/gtest.h>

#include "base/angle.h"
#include "engine/evaluation/shaft_fit.h"
#include "engine/evaluation/shaft_search.h"
#include "tests/support/voxelised_scan.h"

namespace orthonav::engine::shaft_test {
namespace {

/// A box of soft tissue with this metal in it, scanned.
Volume scan_of(const std::vector<test::MetalPiece>& metal, double slice_m) {
  test::FineBody body;
  nav::TriangleMesh box;  // only for its bounds; none of it is bone
  box.vertices_m = {{-0.02, -0.035, -0.02}, {0.02, 0.035, 0.02}, {0.02, -0.035, 0.02}};
  test::BodySettings settings;
  settings.step_m = 0.0004;
  body = test::fine_body({{box, {}}}, metal, settings);
  test::ScannerSettings scanner;
  scanner.spacing_m = {0.0007, 0.0007, slice_m};
  return test::scanned(body, scanner);
}

std::vector<Shaft> shafts_in(const Volume& volume) {
  const ScanField scan(volume);
  const MetalPieces metal = straight_metal(scan);
  std::vector<Shaft> out;
  for (const Shaft& shaft : metal.shafts) {
    if (const auto fitted = fitted_shaft(scan, shaft, {})) {
      out.push_back(*fitted);
    }
  }
  return out;
}

TEST(Shaft, OfAScrewIsFoundToAPartOfAVoxel) {
  const Vec3 rear{0.004, 0.022, -0.003};
  const Vec3 tip{-0.003, -0.022, 0.004};
  for (const double slice_m : {0.0007, 0.002}) {
    const auto found = shafts_in(scan_of({{rear, tip, 0.003}}, slice_m));
    ASSERT_EQ(found.size(), 1u) << slice_m;
    const Shaft& shaft = found[0];
    EXPECT_LT(angle_between_rad(shaft.line.direction, tip - rear) * kDegreesPerRadian, 0.2);
    EXPECT_LT((tip - shaft.line.at(shaft.line.s_of(tip))).norm(), 0.0002);
    EXPECT_LT((rear - shaft.line.at(shaft.line.s_of(rear))).norm(), 0.0002);
    EXPECT_LT((shaft.tip().v - tip).norm(), 0.0006) << "front is -y";
    EXPECT_NEAR(shaft.radius_m, 0.003, 0.0002);
    EXPECT_FALSE(shaft.headed);
  }
}

TEST(Shaft, HasAHeadWhereThickerMetalFollows) {
  const Vec3 neck{0.004, 0.012, -0.003};
  const Vec3 tip{-0.003, -0.030, 0.004};
  const Vec3 direction = (tip - neck).normalized();
  const auto found =
      shafts_in(scan_of({{neck, tip, 0.003}, {neck - 0.014 * direction, neck, 0.006}}, 0.001));
  ASSERT_EQ(found.size(), 1u) << "the head is not a shaft";
  EXPECT_TRUE(found[0].headed);
  EXPECT_LT((found[0].rear().v - neck).norm(), 0.002);
  EXPECT_LT((found[0].tip().v - tip).norm(), 0.0006);
}

TEST(Shaft, OfABentWireFollowsItsBow) {
  // A circle's arc, 1.5 mm off its chord of 60 mm at the middle.
  constexpr double kBow_m = 0.0015;
  constexpr double kHalf_m = 0.030;
  const auto at = [&](double q) {
    return Vec3{0.002 + kBow_m * (1.0 - q * q), -kHalf_m * q, 0.003 * q};
  };
  std::vector<test::MetalPiece> wire;
  for (int i = -20; i < 20; ++i) {
    wire.push_back({at(i / 20.0), at((i + 1) / 20.0), 0.0009, 14000.0});
    wire.push_back({at(i / 20.0), at(i / 20.0), 0.0009, 14000.0});
  }
  const auto found = shafts_in(scan_of(wire, 0.001));
  ASSERT_EQ(found.size(), 1u);
  for (const double q : {-0.9, 0.0, 0.9}) {
    EXPECT_LT(found[0].line.off_m(at(q)), 0.0002) << q;
  }
  const Vec3 chord = at(0.9) - at(-0.9);
  const auto line_at = [&](double q) { return found[0].line.at(found[0].line.s_of(at(q))); };
  EXPECT_LT(angle_between_rad(line_at(0.9) - line_at(-0.9), chord) * kDegreesPerRadian, 0.2);
  EXPECT_NEAR(std::hypot(found[0].line.bow_across_m, found[0].line.bow_athwart_m), kBow_m, 0.0003);
}

TEST(Shaft, OfTwoScrewsThatTouchAreTwo) {
  const Vec3 tip{0.0, -0.025, 0.0};
  const auto found = shafts_in(scan_of({{{0.014, 0.020, 0.0}, tip + Vec3{0.003, 0, 0}, 0.003},
                                        {{-0.014, 0.020, 0.0}, tip - Vec3{0.003, 0, 0}, 0.003}},
                                       0.001));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_TRUE(tip_touches(found[0], found[1]) || tip_touches(found[1], found[0]));
}

TEST(Shaft, OfTwoScrewsApartTouchesNone) {
  const auto found = shafts_in(scan_of({{{0.014, 0.020, 0.0}, {0.006, -0.025, 0.0}, 0.003},
                                        {{-0.014, 0.020, 0.0}, {-0.006, -0.025, 0.0}, 0.003}},
                                       0.001));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_FALSE(tip_touches(found[0], found[1]) || tip_touches(found[1], found[0]))
      << "6 mm lie between them";
}

}  // namespace
}  // namespace orthonav::engine::shaft_test
