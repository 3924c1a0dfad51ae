#include "render/frame/hidden_edges.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/frame/surface_edges.h"
#include "render/shapes.h"
#include "tests/render/test_renderer.h"

namespace orthonav::render {
namespace {

constexpr PixelSize kPicture = {200, 120};
constexpr float kBall_m = 0.02f;

/// One metre away, with the middle of its image at (100, 65); it covers four pixels around that.
PlacedSurface ball(bool veil) { return {1, veil, placed_at({0, -0.025f, -1})}; }

MeshData two_balls() {
  MeshData both = make_sphere(kBall_m, 16, 8);
  const MeshData other = both;
  const auto first = static_cast<std::uint32_t>(both.positions.size());
  for (std::size_t i = 0; i < other.positions.size(); ++i) {
    both.positions.push_back(other.positions[i] + Float3{0.2f, 0, 0});
    both.normals.push_back(other.normals[i]);
  }
  for (const std::uint32_t index : other.indices) {
    both.indices.push_back(first + index);
  }
  return both;
}

/// A square that faces the eye and whose lower edge runs past the middle of the ball.
std::vector<Float4> edges_of_square(float depth_m, bool veil, const HiddenEdges& hidden) {
  MeshData mesh;
  const float half_m = 0.1f * depth_m;
  const float low_m = -0.025f * depth_m;
  mesh.positions = {
      {-half_m, low_m, 0}, {half_m, low_m, 0}, {half_m, half_m, 0}, {-half_m, half_m, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.indices = {0, 1, 3, 1, 2, 3};
  EdgeScratch scratch;
  std::vector<Float4> edges;
  SurfaceEdges(mesh).seen_by(TestRenderer::straight_ahead(), kPicture,
                             {2, veil, placed_at({0, 0, -depth_m})}, hidden, scratch, edges);
  return edges;
}

HiddenEdges hidden_by(const MeshData& mesh, const PlacedSurface& surface) {
  EdgeScratch scratch;
  HiddenEdges hidden;
  SurfaceEdges(mesh).hide(TestRenderer::straight_ahead(), kPicture, surface, scratch, hidden);
  return hidden;
}

HiddenEdges hidden_by_ball(bool veil) {
  return hidden_by(make_sphere(kBall_m, 48, 24), ball(veil));
}

TEST(HiddenEdges, BehindABallAreLeftOutUpToItsOutline) {
  const auto edges = edges_of_square(1.3f, false, hidden_by_ball(false));
  ASSERT_EQ(edges.size(), 5u);
  int ends_at_outline = 0;
  for (const Float4& edge : edges) {
    for (const float off_px :
         {std::hypot(edge.x - 100, edge.y - 65), std::hypot(edge.z - 100, edge.w - 65)}) {
      EXPECT_GT(off_px, 3.9f);
      ends_at_outline += off_px < 4.1f ? 1 : 0;
    }
  }
  EXPECT_EQ(ends_at_outline, 2);
}

TEST(HiddenEdges, AreNoneInFrontOfABall) {
  EXPECT_EQ(edges_of_square(0.9f, false, hidden_by_ball(false)).size(), 4u);
}

TEST(HiddenEdges, WithinABallAreThoseBehindItsNearSide) {
  // 5 mm in front of its centre: the ball is wider than that place's distance from the centre.
  EXPECT_EQ(edges_of_square(0.995f, false, hidden_by_ball(false)).size(), 5u);
}

TEST(HiddenEdges, OfSolidsAreNotHiddenByVeils) {
  EXPECT_EQ(edges_of_square(1.3f, false, hidden_by_ball(true)).size(), 4u);
  EXPECT_EQ(edges_of_square(1.3f, true, hidden_by_ball(true)).size(), 5u);
  EXPECT_EQ(edges_of_square(1.3f, true, hidden_by_ball(false)).size(), 5u);
}

TEST(HiddenEdges, AreNeverASurfacesOwn) {
  const SurfaceEdges edges_of_ball(make_sphere(kBall_m, 48, 24));
  const auto count = [&](const HiddenEdges& hidden) {
    EdgeScratch scratch;
    std::vector<Float4> edges;
    edges_of_ball.seen_by(TestRenderer::straight_ahead(), kPicture, ball(false), hidden, scratch,
                          edges);
    return edges.size();
  };
  EXPECT_GT(count({}), 20u);
  EXPECT_EQ(count(hidden_by_ball(false)), count({}));
}

TEST(HiddenEdges, AreNoneBehindASurfaceThatIsNotConvex) {
  EXPECT_EQ(edges_of_square(1.3f, false, hidden_by(two_balls(), ball(false))).size(), 4u);
}

TEST(HiddenEdges, AreNoneBehindASurfaceThatReachesBehindTheEye) {
  const PlacedSurface around = {1, false, placed_at({0, 0, -0.01f})};
  const HiddenEdges hidden = hidden_by(make_sphere(kBall_m, 48, 24), around);
  EXPECT_EQ(edges_of_square(1.3f, false, hidden).size(), 4u);
}

}  // namespace
}  // namespace orthonav::render
