#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/case/case_file.h"
#include "engine/case/case_writer.h"
#include "engine/case/plan_file.h"
#include "engine/phantom/phantom.h"
#include "engine/scan/transform_file.h"
#include "tests/tools/command_line.h"

namespace orthonav::test::plan_command_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A folder with the phantom's L4 and L5, with their screws or without.
std::string phantom_case(const ScratchFolder& scratch, bool planned) {
  const std::string folder = scratch.file(planned ? "planned" : "bare");
  std::filesystem::create_directories(folder);
  static const engine::Case whole = engine::phantom({"L4", "L5"});
  engine::Case spine = whole;
  for (engine::CaseLevel& level : spine.levels) {
    if (!planned) {
      level.screws.clear();
    }
  }
  EXPECT_TRUE(engine::save_case(folder, spine).ok());
  return folder;
}

TEST(PlanCommand, PlansACaseThatHasNoneAndJudgesItAlike) {
  const ScratchFolder scratch;
  const std::string folder = phantom_case(scratch, false);
  const Called refused = orthonav({"plan", "check", "--case", folder});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("no level has screws (orthonav plan auto places them)"));

  const Called planned = orthonav({"plan", "auto", "--case", folder, "--json"});
  ASSERT_EQ(planned.code, 0) << planned.err;
  const json figures = json::parse(planned.out);
  EXPECT_THAT(figures["scale"].get<std::string>(), HasSubstr("Gertzbein-Robbins, revised"));
  ASSERT_EQ(figures["levels"].size(), 2u);
  const Called checked = orthonav({"plan", "check", "--case", folder, "--json"});
  ASSERT_EQ(checked.code, 0) << checked.err;
  const json judged = json::parse(checked.out);
  for (std::size_t i = 0; i < 2; ++i) {
    const json& screws = figures["levels"][i]["screws"];
    ASSERT_EQ(screws.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
      const json& again = judged["levels"][i]["screws"][k];
      EXPECT_EQ(screws[k]["grade"], "A");
      EXPECT_EQ(screws[k]["listed"], true);
      EXPECT_EQ(again["side"], screws[k]["side"]);
      // The model's file holds floats of millimetres.
      EXPECT_NEAR(again["clearance_mm"].get<double>(), screws[k]["clearance_mm"].get<double>(),
                  1e-3);
      EXPECT_GE(screws[k]["before_far_cortex_mm"].get<double>(), 5.0);
    }
  }
  const Called twice = orthonav({"plan", "auto", "--case", folder});
  EXPECT_EQ(twice.code, 2);
  EXPECT_THAT(twice.err, HasSubstr("L4 has a plan already; --out FOLDER"));
}

TEST(PlanCommand, WritesACaseAnewForLevelsThatAreNamed) {
  const ScratchFolder scratch;
  const std::string folder = phantom_case(scratch, true);
  const std::string out = scratch.file("out");
  const Called called =
      orthonav({"plan", "auto", "--case", folder, "--levels", "L5", "--out", out});
  ASSERT_EQ(called.code, 0) << called.err;
  EXPECT_THAT(called.out, AllOf(HasSubstr("L5 left"), HasSubstr("grade A")));
  EXPECT_THAT(called.out, ::testing::Not(HasSubstr("L4")));
  EXPECT_TRUE(std::filesystem::exists(out + "/L4.plan.json")) << "as it was";
  EXPECT_EQ(orthonav({"plan", "check", "--case", out}).code, 0);
  const Called again = orthonav({"plan", "auto", "--case", folder, "--out", out});
  EXPECT_EQ(again.code, 2);
  EXPECT_THAT(again.err, HasSubstr("case.json: already exists"));
}

TEST(PlanCommand, SaysWhyASideGetsNoScrew) {
  const ScratchFolder scratch;
  const std::string folder = phantom_case(scratch, false);
  const std::string sizes =
      scratch.with("sizes.json", R"({"screws": [{"diameter_mm": 12, "lengths_mm": [40]}]})");
  const Called called = orthonav({"plan", "auto", "--case", folder, "--levels", "L4", "--screws",
                                  sizes, "--thickest-mm", "12", "--clearance-mm", "0"});
  EXPECT_EQ(called.code, 0) << called.err;
  const Called none =
      orthonav({"plan", "auto", "--case", folder, "--levels", "L5", "--screws", sizes});
  EXPECT_EQ(none.code, 1);
  EXPECT_THAT(none.err, HasSubstr("L5 left: no screw: the list of screws has none up to 6.5 mm"));
  EXPECT_FALSE(std::filesystem::exists(folder + "/L5.plan.json"));
}

TEST(PlanCommand, APlanOfAnotherLevelIsRefusedOrDoubted) {
  const ScratchFolder scratch;
  const auto spine = engine::phantom({"L4", "L5"});
  ASSERT_TRUE(engine::save_case(scratch.file("."), spine).ok());
  const auto plan = [&](const char* file, const char* level) {
    EXPECT_TRUE(engine::save_plan(scratch.file(file), "", spine.find(level)->screws).ok());
    return scratch.file(file);
  };
  const auto check = [&](const char* model, const std::string& with) {
    return orthonav({"plan", "check", "--model", scratch.file(model), "--plan", with});
  };
  const Called refused = check("L4.stl", plan("Screws L5.json", "L5"));
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("Screws L5.json: is the plan of L5, but"),
                                 HasSubstr("L4.stl is named after L4")));
  EXPECT_THAT(check("L5.stl", scratch.file("Screws L5.json")).err, IsEmpty());
  EXPECT_THAT(check("L4.stl", plan("mine.json", "L4")).err,
              AllOf(HasSubstr("warning"), HasSubstr("mine.json: states no level, and that it fits"),
                    HasSubstr("does not prove")));
  auto screws = spine.find("L4")->screws;
  for (nav::ScrewPlan& screw : screws) {
    screw.entry.v.y += 0.007;
  }
  ASSERT_TRUE(engine::save_plan(scratch.file("off.json"), "", screws).ok());
  EXPECT_THAT(check("L4.stl", scratch.file("off.json")).err,
              AllOf(HasSubstr("fits "), HasSubstr("badly (left entry"),
                    HasSubstr("off the surface, limit 2.0 mm"), HasSubstr("of another level?")));
}

TEST(PlanCommand, JudgesAPlanBesideItsModel) {
  const ScratchFolder scratch;
  const std::string folder = phantom_case(scratch, true);
  const std::string model = folder + "/L4.stl";
  const std::string plan = folder + "/L4.plan.json";
  const Called good = orthonav({"plan", "check", "--model", model, "--plan", plan});
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_THAT(good.out, AllOf(HasSubstr("L4 left"), HasSubstr("grade A")));
  EXPECT_THAT(good.err, IsEmpty());

  // Moved 6 mm to the side, to the pedicle's wall.
  auto screws = engine::phantom({"L4"}).levels.front().screws;
  for (nav::ScrewPlan& screw : screws) {
    const double out_m = screw.side == nav::Side::kLeft ? 0.006 : -0.006;
    screw.entry.v.x += out_m;
    screw.target.v.x += out_m;
  }
  const std::string wrong = scratch.file("wrong.json");
  ASSERT_TRUE(engine::save_plan(wrong, "L4", screws).ok());
  const Called bad = orthonav({"plan", "check", "--model", model, "--plan", wrong});
  EXPECT_EQ(bad.code, 1);
  EXPECT_THAT(bad.err, HasSubstr("L4 left: breaks through the cortex: clearance -"));
  screws[0].accepted_breach = screws[1].accepted_breach = "in-out-in";
  ASSERT_TRUE(engine::save_plan(wrong, "L4", screws).ok());
  EXPECT_EQ(orthonav({"plan", "check", "--model", model, "--plan", wrong}).code, 0);
}

TEST(PlanCommand, TakesACaseToSlicerAndBack) {
  const ScratchFolder scratch;
  const std::string folder = phantom_case(scratch, true);
  const std::string out = scratch.file("slicer");
  const Called called = orthonav({"plan", "export", "--case", folder, "--out", out});
  ASSERT_EQ(called.code, 0) << called.err;
  EXPECT_THAT(called.out, HasSubstr("L4: L4.stl, L4.mrk.json, L4.tfm"));
  const auto clearances = [](const Called& checked) {
    EXPECT_EQ(checked.code, 0) << checked.err;
    const json screws = json::parse(checked.out)["levels"][0]["screws"];
    return std::pair(screws[0]["clearance_mm"].get<double>(),
                     screws[1]["clearance_mm"].get<double>());
  };
  const auto before =
      clearances(orthonav({"plan", "check", "--case", folder, "--levels", "L4", "--json"}));
  const auto after = clearances(orthonav(
      {"plan", "check", "--model", out + "/L4.stl", "--plan", out + "/L4.mrk.json", "--json"}));
  EXPECT_NEAR(before.first, after.first, 1e-3);
  EXPECT_NEAR(before.second, after.second, 1e-3);
  const Called again = orthonav({"plan", "export", "--case", folder, "--out", out});
  EXPECT_EQ(again.code, 2);
  EXPECT_THAT(again.err, HasSubstr("L4.stl: already exists"));
}

TEST(PlanCommand, SaysToSlicerWhereTheLevelsLieAndReadsItBack) {
  constexpr double kKept_m = 1e-9;
  const ScratchFolder scratch;
  const std::string folder = phantom_case(scratch, true);
  const std::string out = scratch.file("slicer");
  const Called called = orthonav({"plan", "export", "--case", folder, "--out", out});
  ASSERT_EQ(called.code, 0) << called.err;
  const engine::Case before = engine::load_case(folder).value();
  const auto differs = [&](const engine::Case& after, std::size_t i) {
    const auto apart =
        before.levels[i].spine_from_vertebra.inverse() * after.levels[i].spine_from_vertebra;
    return apart.translation().norm() + rotation_angle_rad(apart.rotation(), Mat3::identity());
  };
  EXPECT_GT(before.levels[1].spine_from_vertebra.translation().norm(), 0.01) << "a place to lose";
  // As if Slicer had saved one of them as .h5.
  ASSERT_TRUE(
      engine::save_transform(out + "/L5.h5", engine::load_transform(out + "/L5.tfm").value()).ok());
  std::ofstream(out + "/case.json") << R"({"levels": [
      {"label": "L4", "model": "L4.stl", "plan": "L4.mrk.json", "spine_from_model": "L4.tfm"},
      {"label": "L5", "model": "L5.stl", "plan": "L5.mrk.json", "spine_from_model": "L5.h5"}]})";
  EXPECT_EQ(orthonav({"plan", "check", "--case", out}).code, 0);
  const auto after = engine::load_case(out, engine::CaseUse::kOperation, engine::load_transform);
  ASSERT_TRUE(after.ok()) << after.error().message;
  EXPECT_LT(differs(*after, 0), kKept_m);
  EXPECT_LT(differs(*after, 1), kKept_m);
}

TEST(PlanCommand, WritesNoPlanWhereItsFiguresCannotBeWritten) {
  const ScratchFolder scratch;
  const std::string folder = phantom_case(scratch, false);
  const Called called =
      orthonav({"plan", "auto", "--case", folder, "--json", scratch.file("none/figures.json")});
  EXPECT_EQ(called.code, 2);
  EXPECT_THAT(called.err, HasSubstr("none/figures.json"));
  EXPECT_FALSE(std::filesystem::exists(folder + "/L4.plan.json"));
  EXPECT_EQ(orthonav({"plan", "auto", "--case", folder}).code, 0) << "the twin";
}

TEST(PlanCommand, RefusesWhatDoesNotGoTogether) {
  EXPECT_THAT(orthonav({"plan", "check", "--model", "L4.stl"}).err,
              HasSubstr("--model and --plan go together"));
  const Called level = orthonav({"plan", "check", "--levels", "T9"});
  EXPECT_EQ(level.code, 2);
  EXPECT_THAT(level.err, HasSubstr("case 'phantom' has no level 'T9'"));
}

}  // namespace
}  // namespace orthonav::test::plan_command_test
