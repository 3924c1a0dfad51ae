#include "engine/io/point_cloud.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/io/ply_file.h"
#include "engine/io/range_picture.h"

namespace orthonav::engine {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

PointCloud filled(double cell_m, const std::vector<Vec3>& points_m) {
  PointCloud cloud(cell_m);
  for (const Vec3 p : points_m) {
    cloud.add(p);
  }
  return cloud;
}

TEST(PointCloud, KeepsTheFirstPointOfEachCube) {
  const std::vector<Vec3> points = {{0.001, 0.001, 0.001},
                                    {0.009, 0.009, 0.009},
                                    {-0.001, 0.001, 0.001},
                                    {0.011, 0.001, 0.001},
                                    {0.002, 0.002, 0.002}};
  const PointCloud cloud = filled(0.01, points);
  ASSERT_EQ(cloud.points_m().size(), 3u) << "a cube ends at zero as at every other edge";
  EXPECT_EQ(cloud.points_m()[0][0], 0.001F);
  EXPECT_EQ(cloud.points_m()[1][0], -0.001F);
  EXPECT_EQ(cloud.points_m()[2][0], 0.011F);
  EXPECT_EQ(filled(0.0, points).points_m().size(), points.size());
}

TEST(PlyText, IsReadBackAsItWas) {
  const PointCloud cloud = filled(0.0, {{1.5, -2.25, 0.125}, {1e-3, 0.0, 7.5}});
  const std::string text = ply_text(cloud.points_m(), "made by a test");
  EXPECT_THAT(text, HasSubstr("\ncomment made by a test\n"));
  const auto points = ply_points(text, "test.ply");
  ASSERT_TRUE(points.ok()) << points.error().message;
  EXPECT_THAT(*points, ElementsAre(Vec3{1.5, -2.25, 0.125}, Vec3{1e-3F, 0.0, 7.5}));
  const auto none = ply_points(ply_text({}, "empty"), "none.ply");
  ASSERT_TRUE(none.ok());
  EXPECT_THAT(*none, IsEmpty());
}

TEST(RangePicture, IsWhiteNearDarkFarAndBlackWhereNothingWasMeasured) {
  DepthImage range(20, 20, 700);
  range.at(0, 0) = 0;
  for (int y = 0; y < 20; ++y) {
    range.at(5, y) = 500;
    range.at(6, y) = 900;
  }
  range.at(6, 19) = 60000;  // a stray pixel
  const RangePicture picture = picture_of_ranges(range);
  EXPECT_EQ(picture.white_mm, 500);
  EXPECT_EQ(picture.dark_mm, 900);
  const auto grey = [&](int x, int y) {
    return static_cast<int>(picture.image.pixels[static_cast<std::size_t>(4 * (20 * y + x))]);
  };
  EXPECT_EQ(grey(0, 0), 0);
  EXPECT_EQ(grey(5, 3), 255);
  EXPECT_EQ(grey(6, 3), 40);
  EXPECT_EQ(grey(6, 19), 40) << "clipped";
  EXPECT_NEAR(grey(1, 1), 148, 1);
  EXPECT_EQ(picture_of_ranges(DepthImage(2, 2)).image.pixels,
            (std::vector<std::uint8_t>{0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255}));
}

}  // namespace
}  // namespace orthonav::engine
