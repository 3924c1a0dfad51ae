#include "render/frame/surface_edges.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/shapes.h"
#include "tests/render/test_renderer.h"

namespace orthonav::render {
namespace {

constexpr PixelSize kImage = {200, 120};

std::vector<Float4> seen(const MeshData& mesh, const Matrix4& place) {
  EdgeScratch scratch;
  std::vector<Float4> edges;
  SurfaceEdges(mesh).seen_by(TestRenderer::straight_ahead(), kImage, {0, false, place}, {}, scratch,
                             edges);
  return edges;
}

/// An open square facing +z, 100 mm wide, of two triangles; folded along its diagonal by lifting
/// one corner.
MeshData square(float lifted_m = 0) {
  MeshData mesh;
  mesh.positions = {
      {-0.05f, -0.05f, 0}, {0.05f, -0.05f, 0}, {0.05f, 0.05f, lifted_m}, {-0.05f, 0.05f, 0}};
  mesh.indices = {0, 1, 3, 1, 2, 3};
  mesh.normals = smooth_normals(mesh.positions, mesh.indices);
  return mesh;
}

TEST(SurfaceEdges, OfASphereLieOnItsOutlineWithTheSurfaceToTheLeft) {
  const auto edges = seen(make_sphere(0.05f, 48, 24), placed_at({0, 0, -1}));
  // The outline is a circle of 50.06 mm, 5 mm a pixel, around the middle.
  constexpr float kRadius_px = 10.0f;
  ASSERT_GE(edges.size(), 40u);
  for (const Float4& edge : edges) {
    EXPECT_NEAR(std::hypot(edge.x - 100, edge.y - 60), kRadius_px, 0.8f);
    EXPECT_NEAR(std::hypot(edge.z - 100, edge.w - 60), kRadius_px, 0.8f);
    // Left of a direction, in an image whose y goes down.
    const float left = (edge.w - edge.y) * (100 - edge.x) - (edge.z - edge.x) * (60 - edge.y);
    EXPECT_GT(left, 0);
  }
}

TEST(SurfaceEdges, OfAnOpenSurfaceAreItsBorderAndNoDiagonal) {
  EXPECT_EQ(seen(square(), placed_at({0, 0, -1})).size(), 4u);
}

TEST(SurfaceEdges, OfWhatFacesAwayAreNone) {
  MeshData away = square();
  std::swap(away.indices[1], away.indices[2]);
  std::swap(away.indices[4], away.indices[5]);
  EXPECT_TRUE(seen(away, placed_at({0, 0, -1})).empty());
}

TEST(SurfaceEdges, AreCreasesWhereNormalsDiffer) {
  MeshData smooth = square(0.04f);
  EXPECT_EQ(seen(smooth, placed_at({0, 0, -1})).size(), 4u);
  MeshData creased;
  for (const std::uint32_t index : smooth.indices) {
    creased.positions.push_back(smooth.positions[index]);
    creased.indices.push_back(static_cast<std::uint32_t>(creased.indices.size()));
  }
  creased.normals = smooth_normals(creased.positions, creased.indices);
  EXPECT_EQ(seen(creased, placed_at({0, 0, -1})).size(), 5u);
}

TEST(SurfaceEdges, ThatReachBehindTheEyeAreLeftOut) {
  EXPECT_EQ(seen(make_cylinder({0, 0, 0.1f}, {0, 0, 0.2f}, 0.05f), kIdentity).size(), 0u);
  EXPECT_GT(seen(make_cylinder({0, 0, -1}, {0, 0, -1.1f}, 0.05f), kIdentity).size(), 0u);
}

TEST(SurfaceEdges, OfNothingAreNone) { EXPECT_TRUE(seen({}, kIdentity).empty()); }

}  // namespace
}  // namespace orthonav::render
