#include "engine/scan/mesh_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/phantom/phantom.h"
#include "tests/engine/scan/voxelised.h"
#include "tests/support/mesh_builder.h"

namespace orthonav::engine::mesh_case_test {
namespace {

using ::testing::HasSubstr;

/// Vertebrae of the phantom where they are in one scan.
std::vector<CaseLevel> meshes(const std::vector<std::string>& labels) {
  std::vector<CaseLevel> out;
  for (CaseLevel& level : phantom(labels).levels) {
    for (Vec3& v : level.mesh.vertices_m) {
      v = (level.spine_from_vertebra * Point<Vertebra>{v}).v;
    }
    out.push_back({level.label, std::move(level.mesh), {}, {}});
  }
  return out;
}

std::string refusal(std::vector<CaseLevel> given) {
  const auto made = mesh_levels(std::move(given));
  return made ? "taken" : made.error().message;
}

TEST(MeshCase, SortsMeshesOfOneScanFromTheHead) {
  auto given = meshes({"L3", "L4"});
  std::swap(given[0], given[1]);
  const auto made = mesh_levels(std::move(given));
  ASSERT_TRUE(made) << made.error().message;
  ASSERT_EQ(made->size(), 2u);
  EXPECT_EQ((*made)[0].level.label, "L3");
  EXPECT_EQ((*made)[1].level.label, "L4");
  for (const MeshLevel& level : *made) {
    EXPECT_TRUE(level.canal);
    EXPECT_GT(level.volume_m3, 30e-6);
    EXPECT_LT(level.volume_m3, 90e-6);
  }
}

TEST(MeshCase, RefusesNamesThatTheBonesContradict) {
  auto swapped = meshes({"L3", "L4"});
  std::swap(swapped[0].label, swapped[1].label);
  EXPECT_THAT(refusal(swapped), HasSubstr("L4 lies above L3: are these meshes of one scan"));
  auto far = meshes({"L3", "L4"});
  far[0].label = "L1";
  EXPECT_THAT(refusal(far), HasSubstr("L1 to L4 measure "));
  auto twice = meshes({"L3", "L4"});
  twice[0].label = "L4";
  EXPECT_THAT(refusal(twice), HasSubstr("L4 is given twice"));
  auto strange = meshes({"L3"});
  strange[0].label = "bone";
  EXPECT_THAT(refusal(strange), HasSubstr("'bone' is not a vertebra"));
}

TEST(MeshCase, RefusesMeshesInFramesOfTheirOwn) {
  std::vector<CaseLevel> own;
  for (CaseLevel& level : phantom({"L3", "L4"}).levels) {
    own.push_back({level.label, level.mesh, {}, {}});
  }
  EXPECT_THAT(refusal(own), HasSubstr("L4 lies in the same place as L3"));
}

TEST(MeshCase, RefusesAxesThatAreTurnedHalfRound) {
  auto turned = meshes({"L3"});
  for (Vec3& v : turned[0].mesh.vertices_m) {
    v = {-v.x, -v.y, v.z};
  }
  EXPECT_THAT(refusal(turned), HasSubstr("L3 faces backward: its axes are RAS and not LPS"));
}

TEST(MeshCase, TellsHalfAVertebraFromAWholeOne) {
  const auto made = mesh_levels({{"L3", test::sphere({}, 0.03, 20), {}, {}}});
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_FALSE(made->front().canal);
}

TEST(MeshCase, LiesOnTheBoneOfItsScan) {
  const auto made = mesh_levels(meshes({"L3"}));
  ASSERT_TRUE(made) << made.error().message;
  Volume scan = test::voxelised(made->front().level.mesh, {0.002, 0.002, 0.002});
  for (float& v : scan.values) {
    v = v > 0.0F ? 300.0F : 20.0F;
  }
  EXPECT_TRUE(check_on_bone(*made, scan));
  Volume aside = scan;
  aside.grid.origin_m.x += 0.06;
  EXPECT_THAT(check_on_bone(*made, aside).error().message, HasSubstr("lie outside of the scan"));
  for (float& v : scan.values) {
    v = 20.0F;
  }
  EXPECT_THAT(check_on_bone(*made, scan).error().message,
              HasSubstr("20 HU on average where the meshes are"));
}

}  // namespace
}  // namespace orthonav::engine::mesh_case_test
