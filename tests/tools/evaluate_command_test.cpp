#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/case/case_writer.h"
#include "engine/evaluation/scan_field.h"
#include "engine/scan/transform_file.h"
#include "tests/engine/evaluation/operated_phantom.h"
#include "tests/support/nrrd_scan.h"
#include "tests/tools/command_line.h"

namespace orthonav::test::evaluate_command_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// The phantom's L4 as a case folder and its scan after the operation; the right screw is missing.
class EvaluateCommand : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = new ScratchFolder;
    const engine::Case subject = engine::phantom({"L4"});
    std::filesystem::create_directory(scratch_->file("case"));
    ASSERT_TRUE(engine::save_case(scratch_->file("case"), subject).ok());
    OperatedSpine spine = operated(subject, {}, Random(3));
    ASSERT_TRUE(write_nrrd(scratch_->file("both.nrrd"), quick_scan(spine)));
    ASSERT_TRUE(write_nrrd(scratch_->file("coarse.nrrd"), quick_scan(spine, 1.0, 0.003)));
    spine.metal.resize(2);
    ASSERT_TRUE(write_nrrd(scratch_->file("one.nrrd"), quick_scan(spine)));
    spine.metal.clear();
    ASSERT_TRUE(write_nrrd(scratch_->file("none.nrrd"), quick_scan(spine)));
  }
  static void TearDownTestSuite() { delete scratch_; }
  static Called evaluated(const std::string& scan, std::vector<std::string> more = {}) {
    std::vector<std::string> all = {"evaluate", "--case", scratch_->file("case"), "--volume",
                                    scratch_->file(scan)};
    all.insert(all.end(), more.begin(), more.end());
    return orthonav(all);
  }
  static ScratchFolder* scratch_;
};
ScratchFolder* EvaluateCommand::scratch_ = nullptr;

TEST_F(EvaluateCommand, SaysWhatBecameOfEachScrew) {
  const std::string page = scratch_->file("page.html");
  const std::string figures = scratch_->file("figures.json");
  const Called called = evaluated("both.nrrd", {"--json", figures, "--report", page});
  ASSERT_EQ(called.code, 0) << called.err << called.out;
  EXPECT_THAT(called.out, AllOf(HasSubstr("L4   left "), HasSubstr("L4   right"),
                                HasSubstr("a bent wire's axis is its chord"),
                                HasSubstr("Gertzbein-Robbins, revised")));
  const json out = json::parse(content_of(figures));
  ASSERT_EQ(out["screws"].size(), 2u);
  for (const json& screw : out["screws"]) {
    EXPECT_EQ(screw["found"], true);
    for (const char* key :
         {"angle_error_deg", "angle_error_95_deg", "entry_error_mm", "entry_error_axis_mm",
          "target_error_mm", "depth_error_mm", "diameter_mm", "clearance_mm", "clearance_95_mm"}) {
      EXPECT_TRUE(screw.contains(key) && screw[key].is_number()) << key;
    }
    EXPECT_TRUE(screw["grade"].is_string());
    EXPECT_FALSE(screw["likely_grades"].empty());
    EXPECT_EQ(screw["tip_seen"], true);
  }
  EXPECT_TRUE(out["unassigned"].empty());
  const std::string html = content_of(page);
  EXPECT_THAT(html, AllOf(HasSubstr("data:image/png;base64,"), HasSubstr("class=placed"),
                          HasSubstr("class=plan"), HasSubstr("class=bone"),
                          HasSubstr("the point of the axis nearest to the planned entry"),
                          Not(HasSubstr("http"))));
  // The model shown in the browser: one bone, two planned and two placed screws.
  const std::string opening = "<script id=spine-data type=\"application/json\">";
  const std::size_t start = html.find(opening);
  ASSERT_NE(start, std::string::npos);
  const json scene = json::parse(
      html.substr(start + opening.size(), html.find("</script>", start) - start - opening.size()));
  EXPECT_EQ(scene["bones"].size(), 1u);
  EXPECT_EQ(scene["planned"].size(), 2u);
  ASSERT_EQ(scene["placed"].size(), 2u);
  EXPECT_EQ(scene["placed"][0].size(), 7u);
  EXPECT_GT(scene["reach"], 30.0) << "millimetres";
}

TEST_F(EvaluateCommand, SaysWhatCoarseSlicesCantTell) {
  const std::string page = scratch_->file("coarse.html");
  const std::string figures = scratch_->file("coarse.json");
  const Called coarse = evaluated("coarse.nrrd", {"--report", page, "--json", figures});
  constexpr const char* kLine =
      "slices 3.0 mm apart, tried up to 2.0 mm: across them a tip is known to +-1.5 mm, and a "
      "breach below 1.5 mm may not be seen";
  EXPECT_THAT(coarse.out, HasSubstr(kLine)) << coarse.err;
  EXPECT_THAT(content_of(page), HasSubstr(kLine));
  EXPECT_EQ(json::parse(content_of(figures))["slices_mm"], 3.0);
  EXPECT_THAT(evaluated("both.nrrd").out, Not(HasSubstr("mm apart")));
}

TEST_F(EvaluateCommand, ShowsSlicerWhereEachVertebraLies) {
  const std::string out = scratch_->file("out");
  const Called called = evaluated("both.nrrd", {"--json", "-", "--out", out});
  ASSERT_EQ(called.code, 0) << called.err;
  const auto stored = engine::load_transform(out + "/L4.tfm");
  ASSERT_TRUE(stored.ok()) << stored.error().message;
  const auto scan_from_model = engine::parent_from_node<engine::Scan, Vertebra>(*stored);
  ASSERT_TRUE(scan_from_model.ok()) << scan_from_model.error().message;
  const json rows = json::parse(called.out)["levels"][0]["scan_from_model"];
  const auto written = scan_from_model->row_major();
  for (std::size_t i = 0; i < 16; ++i) {
    const double to_mm = i % 4 == 3 && i < 12 ? 1e3 : 1.0;
    EXPECT_NEAR(to_mm * written[i], rows[i / 4][i % 4].get<double>(), 1e-6) << i;
  }
  const Called again = evaluated("both.nrrd", {"--out", out});
  EXPECT_EQ(again.code, 2);
  EXPECT_THAT(again.err, HasSubstr("L4.tfm: already exists"));
}

TEST_F(EvaluateCommand, AnswersNoWhereAScrewIsMissing) {
  const Called called = evaluated("one.nrrd", {"--json", "-"});
  EXPECT_EQ(called.code, 1) << called.err;
  const json out = json::parse(called.out);
  EXPECT_EQ(out["screws"][0]["found"], true);
  EXPECT_EQ(out["screws"][1]["found"], false);
  EXPECT_FALSE(out["screws"][1].contains("grade"));
}

TEST_F(EvaluateCommand, RefusesInOneLineAndLeavesNothing) {
  const auto refusal = [](const Called& called) {
    EXPECT_EQ(called.code, 2);
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
    return called.err;
  };
  const std::string page = scratch_->file("no.html");
  const std::string out = scratch_->file("transforms");
  EXPECT_THAT(refusal(evaluated("none.nrrd", {"--report", page, "--out", out})),
              HasSubstr("no metal in the scan"));
  EXPECT_FALSE(std::filesystem::exists(page));
  EXPECT_FALSE(std::filesystem::exists(out));
  EXPECT_THAT(refusal(evaluated("absent.nrrd")), HasSubstr("absent.nrrd"));
  EXPECT_THAT(refusal(evaluated("both.nrrd", {"--json", scratch_->file("none/out.json")})),
              HasSubstr("none/out.json"));
  std::filesystem::create_directory(scratch_->file("bare"));
  engine::Case bare = engine::phantom({"L4"});
  bare.levels[0].screws.clear();
  ASSERT_TRUE(engine::save_case(scratch_->file("bare"), bare).ok());
  EXPECT_THAT(refusal(orthonav({"evaluate", "--case", scratch_->file("bare"), "--volume",
                                scratch_->file("both.nrrd")})),
              HasSubstr("no level has screws"));
}

}  // namespace
}  // namespace orthonav::test::evaluate_command_test
