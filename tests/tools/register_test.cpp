#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/mesh_builder.h"
#include "tests/tools/register_command.h"

namespace orthonav::test::register_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

/// Registration errors with that noise are well below this; wrong poses are off by 10 mm and more.
constexpr double kRight_m = 0.001;

TEST_P(RegisterCommand, FindsThePoseAndWritesEveryFigure) {
  const std::string out = folder_.file("out.json");
  const Called called = orthonav({"register", "--model", model_, "--points", points_file(1e3),
                                  "--plan", plan_file_, "--json", out});
  ASSERT_EQ(called.code, 0) << called.err;
  EXPECT_THAT(called.out, StartsWith("accepted: "));
  EXPECT_THAT(called.err, IsEmpty());
  const json report = json::parse(content_of(out));
  EXPECT_EQ(report["accepted"], true);
  EXPECT_TRUE(report["reasons"].empty());
  EXPECT_EQ(report["points_unit"], "mm");
  EXPECT_EQ(report["points"], points_m_.size());
  EXPECT_LT(error_m(report, 1e3), kRight_m);
  EXPECT_THAT(report["model_to_points"][3], ElementsAre(0.0, 0.0, 0.0, 1.0));
  EXPECT_NEAR(report["rmse_mm"].get<double>(), kNoise_m * 1e3, 0.1);
  if (report.contains("runner_up_rmse_mm")) {
    EXPECT_GT(report["runner_up_rmse_mm"].get<double>(), 1.25 * report["rmse_mm"].get<double>());
  }
  ASSERT_EQ(report["screws"].size(), 2U);
  double worst_mm = 0.0;
  for (const json& screw : report["screws"]) {
    worst_mm = std::max({worst_mm, screw["predicted_entry_tre_mm"].get<double>(),
                         screw["predicted_target_tre_mm"].get<double>()});
  }
  EXPECT_EQ(report["predicted_tre_mm"].get<double>(), worst_mm);
  EXPECT_GT(worst_mm, 0.02);
  EXPECT_LT(worst_mm, 2.0);
}

/// The screws of the plan as lines of 3D Slicer, in the plan's order and so named.
std::string slicer_lines(const engine::Plan& plan, const std::vector<std::string>& names) {
  json markups = json::array();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const engine::StatedScrew& screw = plan.screws[i];
    json points = json::array();
    for (const Point<Vertebra>& p : {screw.entry, screw.target}) {
      points.push_back({{"position", {p.v.x * 1e3, p.v.y * 1e3, p.v.z * 1e3}}});
    }
    markups.push_back({{"type", "Line"},
                       {"name", names[i]},
                       {"coordinateSystem", "LPS"},
                       {"coordinateUnits", "mm"},
                       {"controlPoints", points}});
  }
  return json{{"markups", markups}}.dump();
}

TEST_P(RegisterCommand, TakesTheSideFromTheBoneNotFromSlicersNameForALine) {
  ASSERT_EQ(plan_.screws[0].side, nav::Side::kLeft);
  ASSERT_EQ(plan_.screws[1].side, nav::Side::kRight);
  std::swap(plan_.screws[0], plan_.screws[1]);
  const std::string points = points_file(1e3);
  const auto called = [&](const std::vector<std::string>& names) {
    return orthonav({"register", "--model", model_, "--points", points, "--plan",
                     folder_.with("L4.mrk.json", slicer_lines(plan_, names))});
  };
  const Called right = called({"L"});
  EXPECT_EQ(right.code, 0) << right.err;
  EXPECT_THAT(right.out, HasSubstr("error to expect at the right screw: "));
  EXPECT_THAT(right.out, Not(HasSubstr("left screw")));
  const Called both = called({"L", "L_1"});
  EXPECT_EQ(both.code, 0) << both.err;
  EXPECT_LT(both.out.find("the right screw"), both.out.find("the left screw"));
  const Called swapped = called({"L4 left", "L4 right"});
  EXPECT_EQ(swapped.code, 2);
  EXPECT_THAT(swapped.err, AllOf(HasSubstr("L4.mrk.json: line \"L4 left\" says left, but its entry "
                                           "lies "),
                                 HasSubstr(" mm to the right of the bone's midline")));
  EXPECT_EQ(std::count(swapped.err.begin(), swapped.err.end(), '\n'), 1) << swapped.err;
}

TEST_P(RegisterCommand, GivesTheMatrixInThePointsUnit) {
  // The model is in millimetres nevertheless.
  const Called called = orthonav(
      {"register", "--model", model_, "--points", points_file(1.0), "--units", "m", "--json", "-"});
  ASSERT_EQ(called.code, 0) << called.err;
  const json report = json::parse(called.out);  // nothing else on standard output
  EXPECT_EQ(report["points_unit"], "m");
  EXPECT_LT(error_m(report, 1.0), kRight_m);
}

TEST_P(RegisterCommand, TakesAModelInRas) {
  const nav::TriangleMesh rotated =
      test::rotated(mesh_, Mat3::from_columns({-1, 0, 0}, {0, -1, 0}, {0, 0, 1}));
  std::string obj;
  char row[120];
  for (const Vec3& v : rotated.vertices_m) {
    std::snprintf(row, sizeof row, "v %.9g %.9g %.9g\n", v.x * 1e3, v.y * 1e3, v.z * 1e3);
    obj += row;
  }
  for (const auto& t : rotated.triangles) {
    obj += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " +
           std::to_string(t[2] + 1) + "\n";
  }
  const std::string model = folder_.with("ras.obj", obj);
  const Called called = orthonav({"register", "--model", model, "--points", points_file(1e3),
                                  "--frame", "RAS", "--json", "-"});
  ASSERT_EQ(called.code, 0) << called.err;
  const json report = json::parse(called.out);
  EXPECT_EQ(report["model_frame"], "RAS");
  EXPECT_LT(error_m(report, 1e3, -1.0), kRight_m);
}

TEST_P(RegisterCommand, ExpectsLargerErrorsOfAModelThatIsKnownToBeOff) {
  const std::string points = points_file(1e3);
  const auto told = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"register", "--model", model_, "--points",
                                      points,     "--json",  "-"};
    words.insert(words.end(), more.begin(), more.end());
    return json::parse(orthonav(words).out);
  };
  const json exact = told({});
  const json off = told({"--model-sd-mm", "1"});
  EXPECT_GT(off["predicted_tre_mm"].get<double>(), 1.1 * exact["predicted_tre_mm"].get<double>());
  EXPECT_GE(off["tissue_sd_mm"].get<double>(), 1.0999) << "1 is taken as the next larger one";
  const Called paper = orthonav({"register", "--model", model_, "--points", points, "--method",
                                 "paper", "--model-sd-mm", "0.2"});
  EXPECT_EQ(paper.code, 2);
  EXPECT_THAT(paper.err, StartsWith("orthonav: --model-sd-mm: only the method best"));
}

TEST_P(RegisterCommand, TellsOfThePublishedMethodWhatItKnows) {
  const Called called = orthonav({"register", "--model", model_, "--points", points_file(1e3),
                                  "--plan", plan_file_, "--method", "paper", "--json", "-"});
  ASSERT_EQ(called.code, 0) << called.err;
  const json report = json::parse(called.out);
  EXPECT_EQ(report["method"], "paper");
  // These strokes are not in its pattern, so it may be wrong, and does not know.
  EXPECT_EQ(report["accepted"], true);
  EXPECT_THAT(report["ambiguity"].get<std::string>(), StartsWith("judged by eye: "));
  EXPECT_TRUE(report["predicted_tre_mm"].is_null());
  if (report.contains("runner_up_rmse_mm")) {
    EXPECT_GE(report["runner_up_rmse_mm"].get<double>(), report["rmse_mm"].get<double>());
  }
  for (const char* key : {"noise_mm", "inlier_share", "coverage_share", "runner_up_margin"}) {
    EXPECT_FALSE(report.contains(key)) << key << " is not known to it";
  }
}

INSTANTIATE_TEST_SUITE_P(Bones, RegisterCommand, ::testing::Values("phantom", "real"),
                         [](const auto& bone) { return std::string(bone.param); });

}  // namespace
}  // namespace orthonav::test::register_test
