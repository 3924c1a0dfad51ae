#include "engine/report/depth_picture.h"

#include <gtest/gtest.h>

namespace orthonav::engine {
namespace {

/// Seen along -z, x to the right.
const Viewpoint kFromAbove{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const PageArea kArea{{-10, -10}, {10, 10}};
constexpr Rgb kRed{200, 0, 0};
constexpr Rgb kBlue{0, 0, 200};

/// A square of 2 x half_m about the axis at that height, facing the viewer.
nav::TriangleMesh square(double half_m, double height_m) {
  return {{{-half_m, -half_m, height_m},
           {half_m, -half_m, height_m},
           {half_m, half_m, height_m},
           {-half_m, half_m, height_m}},
          {{{0, 1, 2}}, {{0, 2, 3}}}};
}

std::array<int, 4> pixel(const RgbaImage& image, int x, int y) {
  const auto at = 4 * static_cast<std::size_t>(y * image.width_px + x);
  return {image.pixels[at], image.pixels[at + 1], image.pixels[at + 2], image.pixels[at + 3]};
}

TEST(DepthPicture, ShowsWhatIsNearerWhateverIsDrawnFirst) {
  for (const bool near_first : {true, false}) {
    DepthPicture picture(kFromAbove, kArea, 1.0);
    const nav::TriangleMesh near = square(0.003, 0.005);
    const nav::TriangleMesh far = square(0.007, 0.0);
    picture.draw(near_first ? near : far, {{}, 0, kBlue, near_first ? kRed : kBlue});
    picture.draw(near_first ? far : near, {{}, 0, kBlue, near_first ? kBlue : kRed});
    const RgbaImage image = picture.image();
    ASSERT_EQ(image.width_px, 20);
    ASSERT_EQ(image.height_px, 20);
    EXPECT_GT(pixel(image, 10, 10)[0], 100) << "the near one is red";
    EXPECT_GT(pixel(image, 5, 10)[2], 100) << "the far one shows beside it";
    EXPECT_EQ(pixel(image, 10, 10)[3], 255);
    EXPECT_EQ(pixel(image, 1, 1)[3], 0) << "nothing is there";
  }
}

TEST(DepthPicture, TellsWhatASurfaceHides) {
  DepthPicture picture(kFromAbove, kArea, 4.0);
  picture.draw(square(0.005, 0.0), {{}, 0, kBlue, kRed});
  EXPECT_TRUE(picture.hides({0, 0, -0.003}, 0.002));
  EXPECT_FALSE(picture.hides({0, 0, -0.001}, 0.002)) << "not by more than that";
  EXPECT_FALSE(picture.hides({0, 0, 0.001}, 0.002));
  EXPECT_FALSE(picture.hides({0.008, 0, -0.003}, 0.002)) << "beside it";
  EXPECT_FALSE(picture.hides({1.0, 0, -0.003}, 0.002)) << "off the page";
}

TEST(DepthPicture, ColoursByTheValuesAtTheVertices) {
  const std::vector<double> values = {0, 10, 10, 0};  // rises from left to right
  DepthPicture picture(kFromAbove, kArea, 1.0);
  picture.draw(square(0.008, 0.0), {values, 5.0, kRed, kBlue});
  const RgbaImage image = picture.image();
  EXPECT_GT(pixel(image, 5, 10)[0], 100) << "below the limit";
  EXPECT_EQ(pixel(image, 5, 10)[2], 0);
  EXPECT_GT(pixel(image, 14, 10)[2], 100) << "above";
}

TEST(DepthPicture, PutsUpAboveAndRightToTheRight) {
  DepthPicture picture(kFromAbove, kArea, 1.0);
  nav::TriangleMesh mesh = square(0.002, 0.0);
  for (Vec3& v : mesh.vertices_m) {
    v += Vec3{0.005, 0.006, 0.0};
  }
  picture.draw(mesh, {{}, 0, kRed, kRed});
  EXPECT_EQ(pixel(picture.image(), 15, 4)[3], 255);
  EXPECT_EQ(pixel(picture.image(), 4, 15)[3], 0);
}

TEST(DepthPicture, NeverGrowsBeyondItsLimit) {
  DepthPicture picture(kFromAbove, {{0, 0}, {4000, 100}}, 100.0);
  EXPECT_EQ(picture.image().width_px, 1200);
}

}  // namespace
}  // namespace orthonav::engine
