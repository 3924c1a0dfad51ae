#include "engine/scan/scan_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "engine/phantom/phantom.h"
#include "tests/engine/scan/voxelised.h"

namespace orthonav::engine::scan_case_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// L3, L4 and L5 of the phantom in one label map of 2 mm voxels, with the numbers of VerSe.
Volume spine() {
  const Case bones = phantom({"L3", "L4", "L5"});
  nav::TriangleMesh all;
  std::vector<nav::TriangleMesh> meshes;
  for (const CaseLevel& level : bones.levels) {
    nav::TriangleMesh mesh = level.mesh;
    for (Vec3& v : mesh.vertices_m) {
      v = (level.spine_from_vertebra * Point<Vertebra>{v}).v;
    }
    const auto first = static_cast<std::uint32_t>(all.vertices_m.size());
    all.vertices_m.insert(all.vertices_m.end(), mesh.vertices_m.begin(), mesh.vertices_m.end());
    for (auto t : mesh.triangles) {
      all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    meshes.push_back(std::move(mesh));
  }
  const Volume joint = test::voxelised(all, {0.002, 0.002, 0.002});
  Volume out = joint;
  constexpr std::array<float, 3> kValues = {22, 23, 24};
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const nav::SurfaceIndex bone(meshes[m]);
    const nav::Bounds box = nav::bounds_of(meshes[m]);
    for (std::size_t i = 0; i < out.values.size(); ++i) {
      const auto row = static_cast<std::size_t>(out.grid.size[0]);
      const std::size_t slice = row * static_cast<std::size_t>(out.grid.size[1]);
      const Vec3 p =
          out.grid.place_m({double(i % row), double(i % slice / row), double(i / slice)});
      if (p.z >= box.low.z && p.z <= box.high.z && joint.values[i] > 0.0F && bone.contains(p)) {
        out.values[i] = kValues[m];
      }
    }
  }
  return out;
}

const Volume& verse_spine() {
  static const Volume labels = spine();
  return labels;
}

std::vector<std::string> names_of(const ScanLevels& made) {
  std::vector<std::string> out;
  for (const ScanLevel& level : made.levels) {
    out.push_back(level.label);
  }
  return out;
}

/// The same labels with other numbers.
Volume renumbered(float l3, float l4, float l5) {
  Volume out = verse_spine();
  for (float& v : out.values) {
    v = v == 22 ? l3 : v == 23 ? l4 : v == 24 ? l5 : v;
  }
  return out;
}

TEST(ScanCase, MakesEveryVertebraOfAMapWithAStatedConvention) {
  const auto made = scan_levels(verse_spine(), "verse", {});
  ASSERT_TRUE(made.ok()) << made.error().message;
  EXPECT_THAT(names_of(*made), ElementsAre("L3", "L4", "L5"));
  const Case subject = case_of(*made, "spine");
  EXPECT_THAT(subject.check(CaseUse::kPlanning), ::testing::IsEmpty());
  EXPECT_GT(subject.levels[0].centre_in_spine().v.z, subject.levels[1].centre_in_spine().v.z);
  EXPECT_THAT(names_of(*scan_levels(verse_spine(), "verse", {"L4"})), ElementsAre("L4"));
  EXPECT_THAT(names_of(*scan_levels(renumbered(29, 28, 27), "totalsegmentator", {})),
              ElementsAre("L3", "L4", "L5"));
  EXPECT_THAT(names_of(*scan_levels(renumbered(20, 19, 18), "totalsegmentator-v1", {})),
              ElementsAre("L3", "L4", "L5"));
}

TEST(ScanCase, RefusesAMapWhoseConventionIsNotStated) {
  for (const char* convention : {"", "nnunet"}) {
    const auto made = scan_levels(verse_spine(), convention, {});
    ASSERT_FALSE(made.ok());
    EXPECT_THAT(made.error().message,
                HasSubstr("--convention: verse, totalsegmentator, totalsegmentator-v1"));
  }
}

TEST(ScanCase, RefusesAConventionThatItsBonesContradict) {
  const auto refusal = [](const Volume& labels, const char* convention) {
    const auto made = scan_levels(labels, convention, {});
    return made ? std::string() : made.error().message;
  };
  // L3, L4, L5 of v1 read as VerSe are T13, T12, T11: upside down.
  EXPECT_THAT(refusal(renumbered(20, 19, 18), "verse"), HasSubstr("is it another convention?"));
  // Of v2 read as v1 they are T6, T7, T8: in order, but much too far apart.
  EXPECT_THAT(refusal(renumbered(29, 28, 27), "totalsegmentator-v1"),
              HasSubstr("is it another convention?"));
  EXPECT_THAT(refusal(verse_spine(), "totalsegmentator"), HasSubstr("holds no vertebra"));
}

TEST(ScanCase, TellsTheLevelsOfASegmentationByTheirNames) {
  Volume labels = renumbered(1, 2, 3);
  labels.fields = {{"Segment0_Name", "vertebra L5"}, {"Segment0_LabelValue", "3"},
                   {"Segment1_Name", "L4_vertebra"}, {"Segment1_LabelValue", "2"},
                   {"Segment2_Name", "aorta"},       {"Segment2_LabelValue", "1"},
                   {"Segment3_Name", "L2"},          {"Segment3_LabelValue", "9"}};
  EXPECT_THAT(names_of(*scan_levels(labels, "", {})), ElementsAre("L4", "L5"));
  labels.fields["Segment1_Name"] = "LWK 5";
  const auto twice = scan_levels(labels, "", {});
  ASSERT_FALSE(twice.ok());
  EXPECT_THAT(twice.error().message, HasSubstr("two segments are named L5"));
  labels.fields["Segment1_Name"] = labels.fields["Segment0_Name"] = "bone";
  labels.fields["Segment3_Name"] = "other";
  EXPECT_THAT(scan_levels(labels, "", {}).error().message, HasSubstr("no segment is named after"));
}

TEST(ScanCase, LeavesOutWhatTheScanCutsAndRefusesItWhereItIsAskedFor) {
  Volume cut = verse_spine();
  // Without the lowest slices.
  const int gone = 12;
  const std::size_t slice =
      static_cast<std::size_t>(cut.grid.size[0]) * static_cast<std::size_t>(cut.grid.size[1]);
  cut.values.erase(cut.values.begin(),
                   cut.values.begin() + static_cast<std::ptrdiff_t>(gone * slice));
  cut.grid.size[2] -= gone;
  cut.grid.origin_m = verse_spine().grid.place_m({0, 0, double(gone)});
  const auto made = scan_levels(cut, "verse", {});
  ASSERT_TRUE(made.ok()) << made.error().message;
  EXPECT_THAT(names_of(*made), ElementsAre("L3", "L4"));
  EXPECT_THAT(made->left_out, ElementsAre(HasSubstr("L5 is cut by the border of the scan")));
  const auto asked = scan_levels(cut, "verse", {"L5"});
  ASSERT_FALSE(asked.ok());
  EXPECT_THAT(asked.error().message, HasSubstr("L5 is cut by the border of the scan"));
  EXPECT_THAT(scan_levels(cut, "verse", {"T9"}).error().message,
              HasSubstr("holds no T9 (it has: L3, L4, L5)"));
}

TEST(ScanCase, TellsHalfAVertebraFromAWholeOne) {
  Volume half = verse_spine();
  // Without what lies behind the bodies of L4: the origin of its frame is the body's middle.
  const nav::TriangleMesh whole = scan_levels(half, "verse", {"L4"})->levels[0].surface.mesh;
  const nav::Bounds box = nav::bounds_of(whole);
  for (std::size_t i = 0; i < half.values.size(); ++i) {
    const auto row = static_cast<std::size_t>(half.grid.size[0]);
    const double j = double(i / row % static_cast<std::size_t>(half.grid.size[1]));
    if (half.grid.place_m({0, j, 0}).y > box.low.y + 0.045) {
      half.values[i] = 0.0F;
    }
  }
  EXPECT_TRUE(scan_levels(verse_spine(), "verse", {"L4"})->levels[0].canal);
  const auto made = scan_levels(half, "verse", {"L4"});
  ASSERT_TRUE(made.ok()) << made.error().message;
  EXPECT_FALSE(made->levels[0].canal);
}

/// A scan in which the vertebrae have 400 HU.
Volume scan_with(float other_hu) {
  Volume scan = verse_spine();
  for (float& v : scan.values) {
    v = v > 0.0F ? 400.0F : other_hu;
  }
  return scan;
}

TEST(ScanCase, ThresholdTakesConnectedPartsWithoutNames) {
  const Volume scan = scan_with(-50.0F);
  const auto made = threshold_levels(scan, 200.0);
  ASSERT_TRUE(made.ok()) << made.error().message;
  EXPECT_EQ(made->levels[0].label, "part1");
  EXPECT_FALSE(threshold_levels(scan, 500.0).ok());
}

TEST(ScanCase, RefusesLabelsBesideTheBoneOfTheScan) {
  Volume scan = scan_with(-50.0F);
  EXPECT_TRUE(check_on_bone(verse_spine(), "verse", scan).ok());
  Volume moved = verse_spine();
  moved.grid.origin_m.x += 0.5;
  EXPECT_THAT(check_on_bone(moved, "verse", scan).error().message,
              HasSubstr("lie outside of the scan"));
  for (float& v : scan.values) {
    v = 40.0F;  // muscle
  }
  EXPECT_THAT(
      check_on_bone(verse_spine(), "verse", scan).error().message,
      HasSubstr("has 40 HU on average where the labels are, bone has 50 or more; are their axes"));
  scan.layers = 3;
  EXPECT_EQ(check_on_bone(verse_spine(), "verse", scan).error().message,
            "the scan has 3 values a voxel, a CT has 1");
}

TEST(ScanCase, JudgesTheVertebraeAloneWhereAMapHoldsMore) {
  // Everything except vertebrae is lung.
  Volume labels = verse_spine();
  for (float& v : labels.values) {
    v = v > 0.0F ? v : 60.0F;
  }
  Volume scan = scan_with(-800.0F);
  const Status status = check_on_bone(labels, "verse", scan);
  EXPECT_TRUE(status.ok()) << status.error().message;
  std::fill(scan.values.begin(), scan.values.end(), -800.0F);
  EXPECT_FALSE(check_on_bone(labels, "verse", scan).ok()) << "the twin";
}

TEST(ScanCase, JudgesTheVertebraeOfEveryLayerOfASegmentation) {
  Volume labels = verse_spine();
  labels.layers = 2;
  labels.values.clear();
  for (const float v : verse_spine().values) {
    labels.values.push_back(v > 0.0F ? 0.0F : 1.0F);
    labels.values.push_back(v);
  }
  labels.fields = {
      {"Segment0_Name", "lung"}, {"Segment0_LabelValue", "1"},  {"Segment0_Layer", "0"},
      {"Segment1_Name", "L3"},   {"Segment1_LabelValue", "22"}, {"Segment1_Layer", "1"},
      {"Segment2_Name", "L4"},   {"Segment2_LabelValue", "23"}, {"Segment2_Layer", "1"}};
  Volume scan = scan_with(-800.0F);
  const Status status = check_on_bone(labels, "", scan);
  EXPECT_TRUE(status.ok()) << status.error().message;
  std::fill(scan.values.begin(), scan.values.end(), -800.0F);
  EXPECT_FALSE(check_on_bone(labels, "", scan).ok()) << "the twin";
}

}  // namespace
}  // namespace orthonav::engine::scan_case_test
