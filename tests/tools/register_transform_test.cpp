#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

#include "engine/scan/transform_file.h"
#include "tests/tools/register_command.h"

namespace orthonav::test::register_test {
namespace {

using ::testing::HasSubstr;

/// The points as 3D Slicer saves them, in LPS or in RAS.
std::string fcsv(const std::vector<Vec3>& points_m, bool ras) {
  std::string text = "# Markups fiducial file version = 4.11\n# CoordinateSystem = ";
  text += ras ? "RAS\n" : "LPS\n";
  text += "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n";
  const double sign = ras ? -1e3 : 1e3;
  char row[160];
  for (const Vec3& p : points_m) {
    std::snprintf(row, sizeof row, "1,%.9g,%.9g,%.9g,0,0,0,1,1,1,0,P,,\n", sign * p.x, sign * p.y,
                  1e3 * p.z);
    text += row;
  }
  return text;
}

TEST_P(RegisterCommand, MovesTheModelOntoThePointsInSlicer) {
  // Registration errors with that noise are well below this.
  constexpr double kOntoThem_m = 0.001;
  for (const bool ras : {false, true}) {
    SCOPED_TRACE(ras ? "RAS" : "LPS");
    const std::string points = folder_.with(ras ? "ras.fcsv" : "lps.fcsv", fcsv(points_m_, ras));
    const std::string file = folder_.file(ras ? "pose.h5" : "pose.tfm");
    const Called called =
        orthonav({"register", "--model", model_, "--points", points, "--transform", file});
    ASSERT_EQ(called.code, 0) << called.err;
    const auto stored = engine::load_transform(file);
    ASSERT_TRUE(stored.ok()) << stored.error().message;
    const auto pose = engine::parent_from_node<World, Vertebra>(*stored);
    ASSERT_TRUE(pose.ok()) << pose.error().message;
    for (const engine::StatedScrew& screw : plan_.screws) {
      EXPECT_LT((*pose * screw.entry - truth_ * screw.entry).norm(), kOntoThem_m);
      EXPECT_LT((*pose * screw.target - truth_ * screw.target).norm(), kOntoThem_m);
    }
  }
}

TEST_P(RegisterCommand, WritesNoTransformThatSlicerWouldShowWrongly) {
  const std::string file = folder_.file("pose.tfm");
  const Called unknown =
      orthonav({"register", "--model", model_, "--points", points_file(1e3), "--transform", file});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("points.csv states no axes"));
  const std::string points = folder_.with("lps.fcsv", fcsv(points_m_, false));
  const Called named = orthonav(
      {"register", "--model", model_, "--points", points, "--transform", folder_.file("pose.mat")});
  EXPECT_EQ(named.code, 2);
  EXPECT_THAT(named.err, HasSubstr("pose.mat: must end in .tfm or .h5"));
  // A cloud that is not the bone: the pose is refused, and Slicer does not get it.
  Random random(3);
  for (Vec3& p : points_m_) {
    p = {random.normal(0, 0.02), random.normal(0, 0.02), random.normal(0, 0.02)};
  }
  const std::string cloud = folder_.with("cloud.fcsv", fcsv(points_m_, false));
  const Called refused =
      orthonav({"register", "--model", model_, "--points", cloud, "--transform", file});
  EXPECT_EQ(refused.code, 1) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr("pose.tfm: not written, since the registration is refused"));
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace orthonav::test::register_test
