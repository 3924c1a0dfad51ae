#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/case/line_name.h"
#include "engine/case/plan_file.h"
#include "tests/support/test_meshes.h"

// The side of a planned screw follows from the bone; a name only confirms it.
namespace orthonav::engine::screw_side_test {
namespace {

using ::testing::ElementsAre;
using ::testing::Field;

constexpr auto kLeft = nav::Side::kLeft;
constexpr auto kRight = nav::Side::kRight;

/// "left", "right", "both" or nothing.
std::string said_by(const std::string& name) {
  const LineName parsed = parsed_line_name(name);
  return parsed.left && parsed.right ? "both" : parsed.left ? "left" : parsed.right ? "right" : "";
}

TEST(LineName, SaysASideInWholeWordsAlone) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      // 3D Slicer's own names for lines, and what they become when a level is written before.
      {"L", ""},
      {"L_1", ""},
      {"L_12", ""},
      {"l", ""},
      {"Line", ""},
      {"Line_2", ""},
      // A level is no side.
      {"L4", ""},
      {"L4 screw", ""},
      {"L_4", ""},
      {"L L4", ""},
      {"screw L", ""},
      {"", ""},
      {"L4 left", "left"},
      {"LEFT", "left"},
      {"left L4", "left"},
      {"L4_Left-2", "left"},
      {"ScrewLeft", "left"},
      {"L4_L", "left"},
      {"L4-L", "left"},
      {"L4L", "left"},
      {"L4 l_1", "left"},
      {"T12 Lt", "left"},
      {"L4 links", "left"},
      {"L4 right", "right"},
      {"L4-R", "right"},
      {"L4R", "right"},
      {"R", "right"},
      {"R_1", "right"},
      {"rt", "right"},
      {"L4 rechts", "right"},
      // Words that merely contain a side.
      {"leftover", ""},
      {"upright", ""},
      {"L4 cleft", ""},
      {"L4R left", "both"},
      {"left or right", "both"},
  };
  for (const auto& [name, side] : cases) {
    EXPECT_EQ(said_by(name), side) << "\"" << name << "\"";
  }
}

TEST(LineName, NamesTheLevel) {
  EXPECT_EQ(parsed_line_name("l4 left").level, "L4");
  EXPECT_EQ(parsed_line_name("ScrewT12Left").level, "T12");
  EXPECT_EQ(parsed_line_name("L_4").level, "");
  EXPECT_EQ(parsed_line_name("L").level, "");
}

/// How far to the left of the midline a screw enters and ends.
struct Place {
  double entry_mm, target_mm;
};

constexpr double kBoneAt_mm = 130.0;  // as a scanner has it: its midline is not at 0

StatedScrew screw(const std::string& name, Place place) {
  const LineName said = parsed_line_name(name);
  StatedScrew stated;
  stated.where = "L4.mrk.json: line \"" + name + "\"";
  if (said.left || said.right) {
    stated.side = said.left ? kLeft : kRight;
  }
  stated.entry = {{(kBoneAt_mm + place.entry_mm) * 1e-3, 0.03, 0}};
  stated.target = {{(kBoneAt_mm + place.target_mm) * 1e-3, -0.01, 0}};
  return stated;
}

Result<std::vector<nav::ScrewPlan>> on_the_box(const std::vector<StatedScrew>& screws) {
  nav::TriangleMesh bone = box_mesh();
  for (Vec3& v : bone.vertices_m) {
    v.x += kBoneAt_mm * 1e-3;
  }
  Plan plan;
  plan.screws = screws;
  return screws_on(bone, plan);
}

/// "left", "right" or why not.
std::string answer(const std::string& name, Place place) {
  const auto screws = on_the_box({screw(name, place)});
  if (!screws) {
    return screws.error().message;
  }
  return screws->front().side == kLeft ? "left" : "right";
}

TEST(ScrewSide, IsWhereTheScrewLiesAndTheNameConfirmsIt) {
  const std::string file = "L4.mrk.json: ";
  const Place left{20.9, 8}, right{-20.9, -8}, oblique{16, -4}, beside{4.9, 12};
  const Place laminar{-8, 15};
  struct Case {
    std::string name;
    Place place;
    std::string expected;
  };
  const std::vector<Case> cases = {
      {"L", right, "right"},
      {"L_1", right, "right"},
      {"L", left, "left"},
      {"R", right, "right"},
      {"L4 left", left, "left"},
      {"L4_R", right, "right"},
      {"L4", right, "right"},
      {"L4 left", right,
       file + "line \"L4 left\" says left, but its entry lies 20.9 mm to the right of the bone's "
              "midline, must lie to the left"},
      {"R", left,
       file + "line \"R\" says right, but its entry lies 20.9 mm to the left of the bone's "
              "midline, must lie to the right"},
      {"L4 L", right,
       file + "line \"L4 L\" says left, but its entry lies 20.9 mm to the right of the bone's "
              "midline, must lie to the left"},
      // A tip a little past the midline changes nothing.
      {"L", oblique, "left"},
      {"L4 right", oblique,
       file + "line \"L4 right\" says right, but its entry lies 16.0 mm to the left of the bone's "
              "midline, must lie to the right"},
      // Just enough, and just not.
      {"L", {5.1, 12}, "left"},
      {"L", beside,
       file + "line \"L\" must say left or right: its entry lies only 4.9 mm to the left of the "
              "bone's midline, 5.0 mm would tell the side"},
      {"L4 left", beside, "left"},
      {"L4-R", beside, "right"},
      {"L_1", laminar,
       file + "line \"L_1\" must say left or right: it crosses the bone's midline, from 8.0 mm to "
              "the right to 15.0 mm to the left"},
      {"L4 left", laminar, "left"},
      {"L4 right", laminar, "right"},
  };
  for (const Case& c : cases) {
    EXPECT_EQ(answer(c.name, c.place), c.expected) << "\"" << c.name << "\"";
  }
}

TEST(ScrewSide, OfSeveralScrewsIsTakenOneByOne) {
  const auto both = on_the_box({screw("L", {-20, -8}), screw("L_1", {20, 8})});
  ASSERT_TRUE(both.ok()) << both.error().message;
  EXPECT_THAT(*both, ElementsAre(Field(&nav::ScrewPlan::side, kRight),
                                 Field(&nav::ScrewPlan::side, kLeft)));
  const auto twice = on_the_box({screw("L", {20, 8}), screw("L_1", {25, 8})});
  ASSERT_FALSE(twice.ok());
  EXPECT_EQ(twice.error().message,
            "L4.mrk.json: line \"L_1\" is the second one on the left, one is the limit");
}

/// Wrongly interpreted axes swap the sides too, so such a plan must be refused.
TEST(ScrewSide, OfAPlanInOtherAxesIsRefused) {
  StatedScrew rotated = screw("L", {20, 8});
  rotated.entry.v.y *= -1;
  rotated.target.v.y *= -1;
  EXPECT_EQ(on_the_box({rotated}).error().message,
            "L4.mrk.json: line \"L\" entry lies 40.0 mm in front of its target, must lie behind it "
            "(posterior)");
}

TEST(ScrewsOn, SaysWhenAScrewWouldFitInTheOtherAxes) {
  const auto refusal = [](Vec3 entry, Vec3 target, Axes axes) {
    Plan plan{"L4", axes, 1e-3, {}};
    plan.screws.push_back({"p.json: screws[0]", std::nullopt, {entry}, {target}, 0.003});
    const auto screws = screws_on(box_mesh(), plan);
    return screws ? std::string() : screws.error().message;
  };
  EXPECT_EQ(refusal({0.02, -0.03, 0}, {0.01, 0.01, 0}, Axes::kLps),
            "p.json: screws[0] entry lies 40.0 mm in front of its target, must lie behind it "
            "(posterior) (its axes are stated as LPS; as RAS it would fit)");
  EXPECT_EQ(refusal({0.02, -0.03, 0}, {0.01, 0.01, 0}, Axes::kRas),
            "p.json: screws[0] entry lies 40.0 mm in front of its target, must lie behind it "
            "(posterior) (its axes are stated as RAS; as LPS it would fit)");
  EXPECT_EQ(refusal({0.02, 0.09, 0}, {0.01, 0.05, 0}, Axes::kLps),
            "p.json: screws[0] entry lies 60.0 mm off the bone, limit 10.0 mm: is it of another "
            "level?")
      << "it fits in neither";
  EXPECT_EQ(refusal({0.02, 0.03, 0}, {0.01, -0.01, 0}, Axes::kLps), "") << "the twin";
}

}  // namespace
}  // namespace orthonav::engine::screw_side_test
