#include "engine/case/plan_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace orthonav::engine::plan_file_test {
namespace {

using orthonav::test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kRounding_m = 1e-12;

std::string screw(const std::string& side, const std::string& rest =
                                               R"("entry": [20, 30, 1], "target": [10, -14, 2],
                                                  "radius": 3)") {
  return R"({"side": ")" + side + "\", " + rest + "}";
}

std::string plan(const std::string& screws,
                 const std::string& head = R"("units": "mm", "frame": "LPS")") {
  return "{" + head + R"(, "screws": [)" + screws + "]}";
}

std::string line(const std::string& name, const std::string& description = "",
                 const std::string& frame = R"("coordinateSystem": "LPS",
                                               "coordinateUnits": "mm")") {
  return R"({"type": "Line", "name": ")" + name + R"(", "description": ")" + description + "\", " +
         frame + R"(, "controlPoints": [
      {"id": "1", "label": "a", "position": [20, 30, 1], "positionStatus": "defined"},
      {"id": "2", "label": "b", "position": [10, -14, 2], "positionStatus": "defined"},
      {"id": "3", "label": "c", "position": [0, 0, 0], "positionStatus": "preview"}]})";
}

std::string markups(const std::string& list) {
  return R"({"@schema": "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/)"
         R"(Markups/Resources/Schema/markups-schema-v1.0.3.json#", "markups": [)" +
         list + "]}";
}

std::string refusal(const std::string& text, const std::string& name = "L4.plan.json") {
  const TemporaryFolder folder;
  const auto loaded = load_plan(folder.with(name, text));
  EXPECT_FALSE(loaded.ok());
  const std::string message = loaded.ok() ? "" : loaded.error().message;
  EXPECT_THAT(message, HasSubstr(name + ": "));
  EXPECT_THAT(message, Not(HasSubstr("\n")));
  return message;
}

Result<Plan> loaded(const std::string& text, const std::string& name = "L4.plan.json") {
  const TemporaryFolder folder;
  return load_plan(folder.with(name, text));
}

TEST(PlanFile, ReadsMillimetresAndLps) {
  const auto read = loaded(plan(screw("left") + "," + screw("right")));
  ASSERT_TRUE(read.ok()) << read.error().message;
  ASSERT_EQ(read->screws.size(), 2u);
  EXPECT_EQ(read->screws[1].side, nav::Side::kRight);
  EXPECT_THAT(read->screws[1].where, HasSubstr("L4.plan.json: screws[1]"));
  EXPECT_LT((read->screws[0].entry.v - Vec3{0.020, 0.030, 0.001}).norm(), kRounding_m);
  EXPECT_LT((read->screws[0].target.v - Vec3{0.010, -0.014, 0.002}).norm(), kRounding_m);
  EXPECT_DOUBLE_EQ(read->screws[0].radius_m, 0.003);
}

TEST(PlanFile, ReadsWhyAScrewMayLeaveTheCortex) {
  const std::string places = R"("entry": [20, 30, 1], "target": [10, -14, 2], "radius": 3)";
  const auto read = loaded(
      plan(screw("left", places + R"(, "accept_breach": "in-out-in")") + "," + screw("right")));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->screws[0].accepted_breach, "in-out-in");
  EXPECT_EQ(read->screws[1].accepted_breach, "");
  const auto drawn =
      loaded(markups(line("L4 left", R"(diameter=5.5\naccept_breach=narrow pedicle\nchecked)")),
             "L4.mrk.json");
  ASSERT_TRUE(drawn.ok()) << drawn.error().message;
  EXPECT_EQ(drawn->screws[0].accepted_breach, "narrow pedicle");
  EXPECT_DOUBLE_EQ(drawn->screws[0].radius_m, 0.00275);
}

TEST(PlanFile, RefusesABreachWithoutAReason) {
  const auto said = [](const std::string& reason) {
    return refusal(plan(screw("left", R"("entry": [20, 30, 1], "target": [10, -14, 2],
                                         "radius": 3, "accept_breach": ")" +
                                          reason + "\"")));
  };
  EXPECT_THAT(said(""), HasSubstr("screws[0].accept_breach must say why"));
  EXPECT_THAT(said("  "), HasSubstr("screws[0].accept_breach must say why"));
  EXPECT_THAT(said("a\\nb"), HasSubstr("screws[0].accept_breach must be one line"));
  EXPECT_THAT(said(std::string(201, 'a')), HasSubstr("is 201 bytes long, limit 200"));
}

TEST(PlanFile, ReadsMetresAndRas) {
  const auto read = loaded(plan(screw("left", R"("entry": [0.020, 0.030, 0.001],
                                "target": [0.010, -0.014, 0.002], "radius": 0.003)"),
                                R"("units": "m", "frame": "RAS")"));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->axes, Axes::kRas);
  EXPECT_LT((read->screws[0].entry.v - Vec3{-0.020, -0.030, 0.001}).norm(), kRounding_m);
  EXPECT_DOUBLE_EQ(read->screws[0].radius_m, 0.003);
}

TEST(PlanFile, RefusesPlansWithoutUnitOrFrame) {
  EXPECT_THAT(refusal(plan(screw("left"), R"("frame": "LPS")")), HasSubstr("units is missing"));
  EXPECT_THAT(refusal(plan(screw("left"), R"("units": "mm")")), HasSubstr("frame is missing"));
  EXPECT_THAT(refusal(plan(screw("left"), R"("units": "inch", "frame": "LPS")")),
              HasSubstr("units is \"inch\", must be mm or m"));
  EXPECT_THAT(refusal(plan(screw("left"), R"("units": "mm", "frame": "LAS")")),
              HasSubstr("frame is \"LAS\", must be LPS or RAS"));
}

TEST(PlanFile, RefusesScrewsThatCannotBe) {
  EXPECT_THAT(refusal(plan("")), HasSubstr("has no screws"));
  EXPECT_THAT(refusal(plan(screw("middle"))), HasSubstr("screws[0].side is \"middle\""));
  EXPECT_THAT(refusal(plan(screw("left", R"("entry": [20, 30, 1], "radius": 3)"))),
              HasSubstr("screws[0].target is missing"));
  EXPECT_THAT(refusal(plan(screw("left", R"("entry": [1, 1, 1], "target": [1, 1, 1],
                                           "radius": 3)"))),
              HasSubstr("0.0 mm from entry to target"));
  EXPECT_THAT(refusal(plan(screw("left", R"("entry": [20, 30, 1], "target": [10, -14, 2],
                                           "radius": 30)"))),
              HasSubstr("radius 30.0 mm"));
  EXPECT_THAT(refusal(plan(screw("left", R"("entry": [20, 30, 1], "target": [10, -14, 2],
                                           "radius": 0)"))),
              HasSubstr("screws[0].radius must be greater than 0"));
  EXPECT_THAT(refusal(plan(screw("left"), R"("units": "m", "frame": "LPS")")),
              HasSubstr("must be 10.0 mm to 120.0 mm"))
      << "millimetres declared as metres";
}

TEST(PlanFile, TakesScrewsUpToTheLimitsOfLength) {
  const auto of_length = [](double mm) {
    return plan(screw("left", R"("entry": [0, )" + std::to_string(mm) +
                                  R"(, 0], "target": [0, 0, 0], "radius": 3)"));
  };
  EXPECT_TRUE(loaded(of_length(10.01)).ok());
  EXPECT_FALSE(loaded(of_length(9.99)).ok());
  EXPECT_TRUE(loaded(of_length(119.9)).ok());
  EXPECT_FALSE(loaded(of_length(120.1)).ok());
}

TEST(PlanFile, ReadsLinesOfSlicer) {
  const auto read =
      loaded(markups(line("L4 left", "diameter=5.5") + "," + line("L4 right")), "L4.mrk.json");
  ASSERT_TRUE(read.ok()) << read.error().message;
  ASSERT_EQ(read->screws.size(), 2u);
  EXPECT_EQ(read->level, "L4");
  EXPECT_EQ(read->screws[0].side, nav::Side::kLeft);
  EXPECT_EQ(read->screws[1].side, nav::Side::kRight);
  EXPECT_NEAR(read->screws[0].radius_m, 0.00275, kRounding_m);
  EXPECT_DOUBLE_EQ(read->screws[1].radius_m, 0.0) << "none was stated";
  EXPECT_LT((read->screws[0].entry.v - Vec3{0.020, 0.030, 0.001}).norm(), kRounding_m);
}

TEST(PlanFile, ReadsUnitsThatSlicerWritesAsACode) {
  const auto read = loaded(markups(line("L4_L diameter=6", "",
                                        R"("coordinateSystem": "RAS",
                                           "coordinateUnits": ["mm", "UCUM", "millimeter"])")),
                           "L4.mrk.json");
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->screws[0].side, nav::Side::kLeft);
  EXPECT_NEAR(read->screws[0].radius_m, 0.003, kRounding_m);
  EXPECT_LT((read->screws[0].entry.v - Vec3{-0.020, -0.030, 0.001}).norm(), kRounding_m);
}

TEST(PlanFile, ReadsSideAndDiameterHoweverTheyAreWritten) {
  const std::string name = "plan.mrk.json";
  const auto right = loaded(markups(line("T12 RIGHT", "screw, Diameter = 6.5 mm")), name);
  ASSERT_TRUE(right.ok()) << right.error().message;
  EXPECT_EQ(right->level, "T12");
  EXPECT_EQ(right->screws[0].side, nav::Side::kRight);
  EXPECT_NEAR(right->screws[0].radius_m, 0.00325, kRounding_m);
  const auto left = loaded(markups(line("Line-2 (L4; left)", "diameter: 6")), name);
  ASSERT_TRUE(left.ok()) << left.error().message;
  EXPECT_EQ(left->level, "L4");
  EXPECT_EQ(left->screws[0].side, nav::Side::kLeft);
  EXPECT_NEAR(left->screws[0].radius_m, 0.003, kRounding_m);
  for (const char* said : {"diameter=6,5", "diameter: 6.5", "Durchmesser 6,5 mm", "Ø6.5", "ø 6,5",
                           "6.5x45", "6,5 x 45", "screw 6.5 × 45 mm", "diameter=6.5, 6.5x45"}) {
    const auto stated = loaded(markups(line("L4 left", said)), name);
    ASSERT_TRUE(stated.ok()) << said << stated.error().message;
    EXPECT_NEAR(stated->screws[0].radius_m, 0.00325, kRounding_m) << said;
  }
  EXPECT_EQ(loaded(markups(line("L4 left", "seen at 10x400")), name)->screws[0].radius_m, 0.0);
  EXPECT_THAT(refusal(markups(line("L4 left", "diameter=thick")), name),
              HasSubstr("names a diameter without a number"));
  EXPECT_THAT(refusal(markups(line("L4 left 6.5x45", "diameter=5.5")), name),
              HasSubstr("states two diameters, 5.5 and 6.5"));
  const auto long_name = loaded(markups(line(std::string(300000, 'x') + " left")), name);
  EXPECT_TRUE(long_name.ok()) << "a name of any length";
}

TEST(PlanFile, RefusesMarkupsThatLeaveSomethingOpen) {
  const std::string name = "L4.mrk.json";
  EXPECT_THAT(refusal(markups(line("L4 left", "", R"("coordinateUnits": "mm")")), name),
              HasSubstr("coordinateSystem is missing"));
  EXPECT_THAT(refusal(markups(line("L4 left", "", R"("coordinateSystem": "LPS")")), name),
              HasSubstr("coordinateUnits is missing"));
  EXPECT_THAT(refusal(markups(line("L3 left") + "," + line("L4 right")), name),
              HasSubstr("screws of L3 and L4"));
  EXPECT_THAT(refusal(markups(line("L4R left")), name),
              HasSubstr("line \"L4R left\" says both left and right"));
  EXPECT_THAT(refusal(markups(line(R"(L4R\nleft)")), name), HasSubstr("says both"))
      << "in one line";
  EXPECT_THAT(refusal(markups(""), name), HasSubstr("markups is empty"));
  EXPECT_THAT(refusal(markups(R"({"type": "Line", "name": "left", "coordinateSystem": "LPS",
                                  "coordinateUnits": "mm", "controlPoints": []})"),
                      name),
              HasSubstr("has 0 defined points, must be 2"));
}

TEST(PlanFile, WritesWhatItReadsBack) {
  const TemporaryFolder folder;
  const std::vector<nav::ScrewPlan> written = {
      {nav::Side::kRight, {{-0.02, 0.03, 0.004}}, {{-0.01, -0.012, 0.005}}, 0.00275}};
  ASSERT_TRUE(save_plan(folder.file("L2.plan.json"), "L2", written).ok());
  const auto back = load_plan(folder.file("L2.plan.json"));
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back->level, "L2");
  ASSERT_EQ(back->screws.size(), 1u);
  EXPECT_EQ(back->screws[0].side, nav::Side::kRight);
  EXPECT_LT((back->screws[0].entry - written[0].entry).norm(), kRounding_m);
  EXPECT_NEAR(back->screws[0].radius_m, 0.00275, kRounding_m);
}

TEST(PlanFile, SaysThatALegacyMarkupsFileHoldsNoLines) {
  const TemporaryFolder folder;
  const auto plan = load_plan(
      folder.with("L4.FCSV", "# CoordinateSystem = LPS\nf,1,2,3,0,0,0,1,1,1,0,L4 left,,\n"));
  ASSERT_FALSE(plan.ok());
  EXPECT_THAT(plan.error().message, HasSubstr("L4.FCSV: an .fcsv file holds no lines"));
}

}  // namespace
}  // namespace orthonav::engine::plan_file_test
