#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "base/angle.h"
#include "engine/evaluation/shaft_fit.h"
#include "engine/evaluation/shaft_search.h"
#include "engine/evaluation/tip_fit.h"
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

/// Those in a scan of this metal, with touching tips fitted together.
std::vector<Shaft> tips_in(const std::vector<test::MetalPiece>& metal, double slice_m) {
  const Volume volume = scan_of(metal, slice_m);
  std::vector<Shaft> out = shafts_in(volume);
  fit_touching_tips(ScanField(volume), out);
  return out;
}

/// The one of them whose rear is nearest to a place.
const Shaft& from(const std::vector<Shaft>& shafts, Vec3 rear) {
  return *std::min_element(shafts.begin(), shafts.end(), [&](const Shaft& a, const Shaft& b) {
    return (a.rear().v - rear).norm() < (b.rear().v - rear).norm();
  });
}

TEST(Shaft, EndsWhereItTrulyDoesThoughTipsTouch) {
  const Vec3 left{0.016, 0.020, 0.0};
  const Vec3 right{-0.016, 0.020, 0.002};
  // Tip to tip, and one tip at the side of the other shaft: the search runs from one into the
  // other.
  for (const auto& [left_tip, right_tip] :
       {std::pair{Vec3{0.0024, -0.024, 0.0}, Vec3{-0.0024, -0.024, 0.0}},
        std::pair{Vec3{-0.004, -0.028, 0.0}, Vec3{-0.003, -0.014, 0.0}}}) {
    for (const double slice_m : {0.0007, 0.002}) {
      const auto found = tips_in({{left, left_tip, 0.003}, {right, right_tip, 0.003}}, slice_m);
      ASSERT_EQ(found.size(), 2u);
      for (const auto& [rear, tip] : {std::pair{left, left_tip}, std::pair{right, right_tip}}) {
        const Shaft& shaft = from(found, rear);
        EXPECT_TRUE(shaft.touched && shaft.tip_seen) << slice_m;
        EXPECT_LT((shaft.tip().v - tip).norm(), 0.0005) << slice_m;
      }
    }
  }
}

TEST(Shaft, SaysThatATipWithinAnotherShaftIsNotSeen) {
  const Vec3 through{0.0, 0.025, 0.0};
  const Vec3 end{0.0, -0.028, 0.0};
  const Vec3 aside{0.018, 0.020, 0.0};
  const Vec3 hidden{0.0, -0.006, 0.0};
  const auto found = tips_in({{through, end, 0.0035}, {aside, hidden, 0.002}}, 0.001);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_TRUE(from(found, through).tip_seen);
  EXPECT_LT((from(found, through).tip().v - end).norm(), 0.0005);
  const Shaft& shaft = from(found, aside);
  EXPECT_FALSE(shaft.tip_seen);
  EXPECT_LT(shaft.line.s_of(shaft.tip().v), shaft.line.s_of(hidden) + 0.0005) << "surely metal";
}

TEST(Shaft, SaysThatATipInCementIsNotSeen) {
  const Vec3 rear{0.004, 0.016, -0.003};
  const Vec3 tip{-0.003, -0.022, 0.004};
  for (const double around_hu : {2300.0, 900.0, 0.0}) {
    const Vec3 direction = (tip - rear).normalized();
    Volume volume = scan_of({{rear, tip, 0.003}, {rear - 0.012 * direction, rear, 0.006}}, 0.001);
    for (std::size_t i = 0; i < volume.values.size(); ++i) {
      const auto row = static_cast<std::size_t>(volume.grid.size[0]);
      const auto plane = row * static_cast<std::size_t>(volume.grid.size[1]);
      const Vec3 place =
          volume.grid.place_m({double(i % row), double(i % plane / row), double(i / plane)});
      if ((place - tip).norm() < 0.007) {
        volume.values[i] = std::max(volume.values[i], static_cast<float>(around_hu));
      }
    }
    auto found = shafts_in(volume);
    fit_touching_tips(ScanField(volume), found);
    ASSERT_EQ(found.size(), 1u) << around_hu;
    EXPECT_EQ(found[0].tip_seen, around_hu < 1800.0) << around_hu << ": or dense bone, the twin";
    if (found[0].tip_seen) {
      EXPECT_LT((found[0].tip().v - tip).norm(), 0.001) << around_hu;
    }
  }
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
