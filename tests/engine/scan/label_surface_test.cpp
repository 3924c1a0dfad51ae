#include "engine/scan/label_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/phantom/phantom.h"
#include "tests/engine/scan/voxelised.h"
#include "tests/support/mesh_builder.h"

namespace orthonav::engine::label_surface_test {
namespace {

using ::testing::HasSubstr;

const nav::TriangleMesh& phantom_l3() {
  static const nav::TriangleMesh mesh = phantom({"L3"}).levels.front().mesh;
  return mesh;
}

/// Distances of the vertices of one mesh from the surface of another, ascending.
std::vector<double> distances_m(const nav::TriangleMesh& from, const nav::TriangleMesh& to) {
  const nav::SurfaceIndex surface(to);
  std::vector<double> out;
  for (const Vec3& v : from.vertices_m) {
    out.push_back(surface.nearest(v)->distance_m);
  }
  std::sort(out.begin(), out.end());
  return out;
}

LabelSurface surface_of_voxels(Vec3 spacing_m) {
  const Volume labels = test::voxelised(phantom_l3(), spacing_m);
  const auto part = label_part(labels, {"L3", 0, 1}, kSurfaceMargin);
  EXPECT_TRUE(part.ok());
  auto surface = label_surface(*part);
  EXPECT_TRUE(surface.ok()) << surface.error().message;
  return std::move(*surface);
}

TEST(LabelSurface, KeepsToTheLabelAndToTheTruth) {
  struct Case {
    Vec3 spacing_m;
    double voxel_m;
    double truth_p95_m;  ///< measured, and a tenth
  };
  for (const Case& c :
       {Case{{0.001, 0.001, 0.001}, 0.001, 0.00040}, Case{{0.001, 0.001, 0.002}, 0.002, 0.00070},
        Case{{0.003, 0.003, 0.003}, 0.003, 0.00140}}) {
    const LabelSurface made = surface_of_voxels(c.spacing_m);
    EXPECT_LE(made.deviation.p95_m, 0.5 * c.voxel_m) << "half a voxel";
    EXPECT_LE(made.deviation.median_m, made.deviation.p95_m);
    const auto off_m = distances_m(made.mesh, phantom_l3());
    EXPECT_LE(off_m[off_m.size() * 95 / 100], c.truth_p95_m) << c.voxel_m;
    // Half of the stairs' own error, a quarter of a voxel in the median.
    EXPECT_LE(off_m[off_m.size() / 2], 0.17 * c.voxel_m) << c.voxel_m;
  }
}

TEST(LabelSurface, IsSmootherThanTheStairs) {
  // The phantom's ball-like body: normals of neighbouring faces of the mesh turn little.
  const LabelSurface made = surface_of_voxels({0.002, 0.002, 0.002});
  const nav::SurfaceIndex truth(phantom_l3());
  double mean = 0.0;
  for (const auto& t : made.mesh.triangles) {
    const Vec3 a = made.mesh.vertices_m[t[0]];
    const Vec3 b = made.mesh.vertices_m[t[1]];
    const Vec3 c = made.mesh.vertices_m[t[2]];
    mean += (b - a).cross(c - a).normalized().dot(truth.nearest((a + b + c) / 3.0)->normal);
  }
  mean /= static_cast<double>(made.mesh.triangles.size());
  // Of stairs, 0.7 to 0.8.
  EXPECT_GT(mean, 0.95);
}

TEST(LabelSurface, LiesWhereAnObliqueScanSaysInAnyHandedness) {
  Volume labels = test::voxelised(test::sphere({}, 0.02, 40), {0.001, 0.001, 0.0015});
  const Mat3 rotation = rotation_from_vector({0.3, -0.2, 0.5});
  const Vec3 middle_index = labels.grid.index_of({});
  // The first index runs backwards: a left-handed grid, as in many NIfTI files.
  labels.grid.directions =
      rotation * Mat3::from_columns(Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1});
  labels.grid.origin_m = {0.3, -0.2, 1.0};
  const Vec3 middle_m = labels.grid.place_m(middle_index);
  const auto part = label_part(labels, {"L3", 0, 1}, kSurfaceMargin);
  ASSERT_TRUE(part.ok());
  const auto surface = label_surface(*part);
  ASSERT_TRUE(surface.ok()) << surface.error().message;
  for (const Vec3& v : surface->mesh.vertices_m) {
    EXPECT_NEAR((v - middle_m).norm(), 0.02, 0.0005);
  }
  EXPECT_TRUE(nav::SurfaceIndex(surface->mesh).contains(middle_m)) << "outward-oriented";
}

TEST(LabelPart, TakesTheLargestPartAndFillsItsCavities) {
  Volume labels;
  labels.grid.size = {30, 30, 30};
  labels.grid.spacing_m = {0.001, 0.001, 0.001};
  labels.values.assign(labels.grid.voxels(), 0.0F);
  const auto fill = [&](int low, int high, float value) {
    for (int k = low; k < high; ++k) {
      for (int j = low; j < high; ++j) {
        for (int i = low; i < high; ++i) {
          labels.values[labels.grid.at(i, j, k)] = value;
        }
      }
    }
  };
  fill(5, 15, 7.0F);
  fill(9, 11, 0.0F);   // a cavity
  fill(15, 17, 7.0F);  // touches by a corner alone
  const auto part = label_part(labels, {"L3", 0, 7}, 2);
  ASSERT_TRUE(part.ok());
  EXPECT_EQ(part->voxels, 1000u - 8u + 8u);
  EXPECT_EQ(part->dropped, 8u);
  EXPECT_EQ(part->at_border, 0u);
  EXPECT_EQ(std::count(part->inside.begin(), part->inside.end(), 1), 1000) << "filled";
  fill(0, 3, 8.0F);
  const auto small = label_part(labels, {"L2", 0, 8}, 2);
  ASSERT_FALSE(small.ok());
  EXPECT_THAT(small.error().message, HasSubstr("L2 has 27 voxels, must have 100"));
  fill(0, 5, 8.0F);
  EXPECT_GT(label_part(labels, {"L2", 0, 8}, 2)->at_border, 0u);
}

}  // namespace
}  // namespace orthonav::engine::label_surface_test
