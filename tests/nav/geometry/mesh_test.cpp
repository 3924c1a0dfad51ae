#include "nav/geometry/mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "tests/support/mesh_builder.h"

namespace orthonav::nav {
namespace {

using test::box;
using test::vertebra_sized_box;
using ::testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double volume_m3(const TriangleMesh& mesh) {
  double v = 0.0;
  for (const auto& t : mesh.triangles) {
    v += mesh.vertices_m[t[0]].dot(mesh.vertices_m[t[1]].cross(mesh.vertices_m[t[2]])) / 6.0;
  }
  return v;
}

std::string refusal(TriangleMesh mesh) {
  const auto checked = checked_bone(std::move(mesh));
  return checked ? "accepted" : checked.error().message;
}

TEST(CheckedBone, TakesAClosedMeshAsItIs) {
  const TriangleMesh mesh = vertebra_sized_box();
  const auto checked = checked_bone(mesh);
  ASSERT_TRUE(checked.ok());
  EXPECT_EQ(checked->triangles, mesh.triangles);
  EXPECT_EQ(checked->vertices_m, mesh.vertices_m);
}

TEST(CheckedBone, TurnsAnInwardMesh) {
  TriangleMesh mesh = vertebra_sized_box();
  for (auto& t : mesh.triangles) {
    std::swap(t[0], t[1]);
  }
  ASSERT_LT(volume_m3(mesh), 0.0);
  const auto checked = checked_bone(mesh);
  ASSERT_TRUE(checked.ok());
  EXPECT_NEAR(volume_m3(*checked), 0.08 * 0.08 * 0.04, 1e-12);
}

TEST(CheckedBone, RefusesAMeshWithoutFaces) {
  TriangleMesh mesh = vertebra_sized_box();
  mesh.triangles.clear();
  EXPECT_THAT(refusal(mesh), HasSubstr("no faces"));
  EXPECT_THAT(refusal({}), HasSubstr("no faces"));
}

TEST(CheckedBone, RefusesVerticesThatAreNotFinite) {
  for (const double bad : {kNaN, std::numeric_limits<double>::infinity()}) {
    TriangleMesh mesh = vertebra_sized_box();
    mesh.vertices_m[5].y = bad;
    EXPECT_THAT(refusal(mesh), HasSubstr("vertex 5 is not finite"));
  }
}

TEST(CheckedBone, RefusesIndicesOutOfRange) {
  TriangleMesh mesh = vertebra_sized_box();
  mesh.triangles[3][1] = 8;
  EXPECT_THAT(refusal(mesh), HasSubstr("face 3 names vertex 8, but there are only 8"));
}

TEST(CheckedBone, RefusesAFaceWithOneVertexTwice) {
  TriangleMesh mesh = vertebra_sized_box();
  mesh.triangles.push_back({2, 2, 3});
  EXPECT_THAT(refusal(mesh), HasSubstr("face 12 names vertex 2 twice"));
}

TEST(CheckedBone, RefusesAnOpenMesh) {
  TriangleMesh mesh = vertebra_sized_box();
  mesh.triangles.pop_back();
  EXPECT_THAT(refusal(mesh), HasSubstr("mesh is open: 3 edges"));
}

TEST(CheckedBone, RefusesAnEdgeWithMoreThanTwoFaces) {
  TriangleMesh mesh = vertebra_sized_box();
  mesh.vertices_m.push_back({0, 0, 0.05});  // a fin: both of its sides on one edge of the box
  mesh.triangles.push_back({0, 1, 8});
  mesh.triangles.push_back({1, 0, 8});
  EXPECT_THAT(refusal(mesh), HasSubstr("1 edges have more than two faces"));
}

TEST(CheckedBone, RefusesFacesWoundAgainstEachOther) {
  TriangleMesh mesh = vertebra_sized_box();
  std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
  EXPECT_THAT(refusal(mesh), HasSubstr("wound against each other"));
}

TEST(CheckedBone, RefusesAMeshWithoutInside) {
  TriangleMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {0.06, 0, 0}, {0, 0.06, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_THAT(refusal(mesh), HasSubstr("encloses no volume"));
}

TEST(CheckedBone, NamesMetresTakenForMillimetres) {
  TriangleMesh mesh = vertebra_sized_box();
  for (Vec3& v : mesh.vertices_m) {
    v = v * 1e-3;
  }
  EXPECT_THAT(refusal(mesh), HasSubstr("mesh is 0.08 mm across, limit 30-250 mm"));
  EXPECT_THAT(refusal(mesh), HasSubstr("metres taken for millimetres"));
  for (Vec3& v : mesh.vertices_m) {
    v = v * 1e6;
  }
  EXPECT_THAT(refusal(mesh), HasSubstr("millimetres taken for metres"));
}

TEST(CheckedBone, HoldsTheLimitsOfSizeToTheMillimetre) {
  EXPECT_EQ(refusal(box({0, 0, 0}, {0.0301, 0.02, 0.02})), "accepted");
  EXPECT_THAT(refusal(box({0, 0, 0}, {0.0299, 0.02, 0.02})), HasSubstr("29.9 mm across"));
  EXPECT_EQ(refusal(box({0, 0, 0}, {0.2499, 0.1, 0.1})), "accepted");
  EXPECT_THAT(refusal(box({0, 0, 0}, {0.2501, 0.1, 0.1})), HasSubstr("250.1 mm across"));
}

TEST(CheckedBone, MayBeAsLongAsAFemur) {
  const TriangleMesh long_bone = box({0, 0, 0}, {0.5999, 0.1, 0.1});
  EXPECT_TRUE(checked_bone(long_bone, Bone::kAny).ok());
  EXPECT_THAT(refusal(long_bone), HasSubstr("register takes another bone with --any-bone"));
  const auto longer = checked_bone(box({0, 0, 0}, {0.6001, 0.1, 0.1}), Bone::kAny);
  ASSERT_FALSE(longer.ok());
  EXPECT_THAT(longer.error().message, HasSubstr("600.1 mm across, limit 30-600 mm"));
}

TEST(MainPart, IsAnOpenOneOnlyIfItIsTenTimesAsLarge) {
  const auto left = [](double edge_m) {
    TriangleMesh mesh = vertebra_sized_box();  // 256 cm3
    mesh.triangles.pop_back();
    const TriangleMesh closed = box({1, 0, 0}, {1 + edge_m, edge_m, edge_m});
    for (auto t : closed.triangles) {
      for (std::uint32_t& v : t) {
        v += static_cast<std::uint32_t>(mesh.vertices_m.size());
      }
      mesh.triangles.push_back(t);
    }
    mesh.vertices_m.insert(mesh.vertices_m.end(), closed.vertices_m.begin(),
                           closed.vertices_m.end());
    return main_part(mesh).mesh.triangles.size();
  };
  EXPECT_EQ(left(0.035), 12U);  // 43 cm3
  EXPECT_EQ(left(0.015), 11U);  // 3 cm3
}

TEST(Solid, HasTheVolumeAndTheCentroidOfItsInside) {
  const Solid box = solid_of(test::box({0.1, 0.2, 0.3}, {0.14, 0.26, 0.38}));
  EXPECT_NEAR(box.volume_m3, 0.04 * 0.06 * 0.08, 1e-12);
  EXPECT_NEAR((box.centroid_m - Vec3{0.12, 0.23, 0.34}).norm(), 0.0, 1e-12);
  EXPECT_EQ(solid_of({}).volume_m3, 0.0);
}

TEST(Welded, JoinsTheCornersOfALooseMesh) {
  const TriangleMesh whole = vertebra_sized_box();
  TriangleMesh loose;
  for (const auto& t : whole.triangles) {
    const auto base = static_cast<std::uint32_t>(loose.vertices_m.size());
    for (const std::uint32_t v : t) {
      loose.vertices_m.push_back(whole.vertices_m[v]);
    }
    loose.triangles.push_back({base, base + 1, base + 2});
  }
  EXPECT_THAT(refusal(loose), HasSubstr("open"));
  const TriangleMesh joined = welded(loose);
  EXPECT_EQ(joined.vertices_m.size(), 8U);
  EXPECT_EQ(joined.triangles.size(), 12U);
  EXPECT_EQ(refusal(joined), "accepted");
}

TEST(Welded, LeavesOutCollapsedFacesAndKeepsWrongIndicesWrong) {
  TriangleMesh mesh = vertebra_sized_box();
  mesh.vertices_m.push_back(mesh.vertices_m[3]);
  mesh.triangles.push_back({3, 8, 1});
  EXPECT_EQ(welded(mesh).triangles.size(), 12U);
  mesh.triangles.push_back({0, 77, 99});
  EXPECT_THAT(refusal(welded(mesh)), HasSubstr("face 12 names vertex"));
}

}  // namespace
}  // namespace orthonav::nav
