#include "engine/live/surface_contours.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/live/bone_lines.h"
#include "render/float3.h"
#include "render/shapes.h"

namespace orthonav::engine {
namespace {

using render::Float3;
using std::chrono::milliseconds;

constexpr float kRadius_m = 0.02f;
constexpr Float3 kEye{0.1f, 0.5f, -0.2f};

render::MeshData ball() { return render::make_sphere(kRadius_m, 64, 32); }

void add(render::MeshData& mesh, const render::MeshData& other, Float3 at) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Float3 p : other.positions) {
    mesh.positions.push_back(p + at);
  }
  mesh.normals.insert(mesh.normals.end(), other.normals.begin(), other.normals.end());
  for (const std::uint32_t index : other.indices) {
    mesh.indices.push_back(first + index);
  }
}

float length_of_all(const std::vector<SurfaceContours::Line>& lines) {
  float sum = 0;
  for (const SurfaceContours::Line& line : lines) {
    sum += length_of(line);
  }
  return sum;
}

TEST(SurfaceContours, OfABallAreTheCircleOfTangentLines) {
  const SurfaceContours contours(ball());
  const auto lines = contours.seen_from(kEye);
  ASSERT_EQ(lines.size(), 1u);
  const float away_m = length(kEye);
  const float circle_m = kRadius_m * std::sqrt(1 - (kRadius_m / away_m) * (kRadius_m / away_m));
  // A circle drawn on triangles of 2 mm.
  EXPECT_NEAR(length_of(lines[0]), 6.2832f * circle_m, 0.002f * 6.2832f * circle_m);
  for (const Float3 p : lines[0]) {
    EXPECT_NEAR(length(p), kRadius_m, 5e-5f);
    EXPECT_NEAR(dot(p, kEye) / away_m, kRadius_m * kRadius_m / away_m, 1e-4f);
  }
}

TEST(SurfaceContours, LeaveOutWhatLiesBehind) {
  render::MeshData two = ball();
  const Float3 behind = -0.1f * render::unit_or(kEye, {});
  add(two, render::make_sphere(0.6f * kRadius_m, 64, 32), behind);
  const float alone = length_of_all(SurfaceContours(ball()).seen_from(kEye));
  EXPECT_NEAR(length_of_all(SurfaceContours(two).seen_from(kEye)), alone, 0.01f * alone);
  // The control: from the side both are seen.
  const Float3 aside = 0.5f * render::any_perpendicular(render::unit_or(kEye, {}));
  EXPECT_GT(length_of_all(SurfaceContours(two).seen_from(aside)), 1.5f * alone);
}

TEST(SurfaceContours, AreThinnedWithinWhatIsAsked) {
  SurfaceContours::Line line;
  for (int i = 0; i <= 200; ++i) {
    const float angle_rad = 0.01f * static_cast<float>(i);
    line.push_back({kRadius_m * std::cos(angle_rad), kRadius_m * std::sin(angle_rad), 0});
  }
  const SurfaceContours::Line kept = thinned(line, 2e-4f);
  EXPECT_LT(kept.size(), 12u);
  EXPECT_EQ(kept.front(), line.front());
  EXPECT_EQ(kept.back(), line.back());
  for (std::size_t i = 1; i < kept.size(); ++i) {
    const float sagitta_m = kRadius_m - length(0.5f * (kept[i - 1] + kept[i]));
    EXPECT_LT(sagitta_m, 2.1e-4f);
  }
  const SurfaceContours::Line part(line.begin(), line.begin() + 150);
  const SurfaceContours::Line earlier = thinned(part, 2e-4f);
  for (std::size_t i = 0; i + 1 < earlier.size(); ++i) {
    EXPECT_EQ(earlier[i], kept[i]) << "what was sent stays";
  }
}

class BoneLinesOfABall : public ::testing::Test {
 protected:
  BoneLinesOfABall() {
    item.mesh = std::make_shared<const render::MeshData>(ball());
    item.world_from_model = render::placed_at({0.3f, 0, 0}, 2.0f);
  }
  render::MeshItem item;
  BoneLines lines;
};

TEST_F(BoneLinesOfABall, LieOnItInTheWorld) {
  for (const StraightPiece& piece : lines.pieces(item, kEye, {})) {
    EXPECT_NEAR(length(piece[0] - Float3{0.3f, 0, 0}), 2 * kRadius_m, 1e-4f);
  }
}

TEST_F(BoneLinesOfABall, KeepTheirBudget) {
  EXPECT_GT(lines.pieces(item, kEye, {}).size(), 20u);
  BoneLineOptions few;
  few.most_pieces = 12;
  EXPECT_LE(BoneLines(few).pieces(item, kEye, {}).size(), 12u);
}

TEST_F(BoneLinesOfABall, AreFoundAnewOnlyWhereTheHeadMoved) {
  const auto first = lines.pieces(item, kEye, Timestamp(milliseconds(0)));
  const Float3 nearby = kEye + Float3{0.001f, 0, 0};
  const Float3 aside = kEye + Float3{0.05f, 0, 0};
  EXPECT_EQ(lines.pieces(item, nearby, Timestamp(milliseconds(300))), first);
  EXPECT_EQ(lines.pieces(item, aside, Timestamp(milliseconds(90))), first) << "too soon";
  EXPECT_NE(lines.pieces(item, aside, Timestamp(milliseconds(400))), first);
}

}  // namespace
}  // namespace orthonav::engine
