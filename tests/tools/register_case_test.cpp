#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/case/case_file.h"
#include "engine/phantom/phantom.h"
#include "tests/support/digitized_strokes.h"
#include "tests/tools/command_line.h"

namespace orthonav::test::register_case_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// Strokes scatter by 0.3 mm along each axis; wrong poses are off by 5 mm and more.
constexpr double kRight_mm = 1.0;

/// Strokes over a level of a case, registered to a level of that case. Cases are the built-in
/// phantom, available in every checkout, and real bones.
class RegisterCase : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (std::string(GetParam()) == "phantom") {
      case_ = engine::phantom();
    } else {
      folder_of_case_ = shared("anatomy/" + std::string(GetParam()));
      if (folder_of_case_.empty()) {
        GTEST_SKIP() << "needs shared/anatomy";
      }
      case_ = engine::load_case(folder_of_case_).value();
    }
  }
  DigitizedStrokes strokes(const std::string& label, StrokeVariant variant, std::uint64_t seed,
                           double tip_radius_m = 0.0) const {
    StrokeErrorModel error_model = error_model_of(variant);
    error_model.tip_radius_m = tip_radius_m;
    return digitize_strokes(case_.find(label)->mesh, variant, seed, error_model).value();
  }
  std::string file_of(const std::vector<Point<World>>& points) const {
    std::string csv = "x,y,z\n";
    char row[120];
    for (const Point<World>& p : points) {
      std::snprintf(row, sizeof row, "%.5f,%.5f,%.5f\n", p.v.x * 1e3, p.v.y * 1e3, p.v.z * 1e3);
      csv += row;
    }
    return folder_.with("points.csv", csv);
  }
  Called registered(const std::string& label, const std::vector<Point<World>>& points,
                    std::vector<std::string> more = {"--json", "-"}) const {
    std::vector<std::string> arguments{"register", "--level", label, "--points", file_of(points)};
    if (!folder_of_case_.empty()) {
      more.insert(more.end(), {"--case", folder_of_case_ + "/case.json"});
    }
    arguments.insert(arguments.end(), more.begin(), more.end());
    return orthonav(arguments);
  }
  /// The largest error of the matrix of that name at the screws of the level.
  double error_mm(const json& report, const std::string& label,
                  const Transform<World, Vertebra>& truth,
                  const char* matrix = "model_to_points") const {
    double worst = 0.0;
    const json& m = report.at(matrix);
    for (const nav::ScrewPlan& screw : case_.find(label)->screws) {
      for (const Point<Vertebra>& p : {screw.entry, screw.target}) {
        Vec3 mapped;
        for (int r = 0; r < 3; ++r) {
          mapped[r] = m[r][0].get<double>() * p.v.x * 1e3 + m[r][1].get<double>() * p.v.y * 1e3 +
                      m[r][2].get<double>() * p.v.z * 1e3 + m[r][3].get<double>();
        }
        worst = std::max(worst, (mapped - 1e3 * (truth * p).v).norm());
      }
    }
    return worst;
  }
  void expect_next_best_pose(const json& report, const std::string& label,
                             const Transform<World, Vertebra>& truth) const;
  ScratchFolder folder_;
  std::string folder_of_case_;  ///< empty: the phantom
  engine::Case case_;
};

/// Symmetric, no variance below zero, and the sum of the variances is the square of the RMS.
void expect_covariance(const json& covariance, double rms_mm) {
  ASSERT_EQ(covariance.size(), 3U);
  double trace = 0.0;
  for (std::size_t r = 0; r < 3; ++r) {
    ASSERT_EQ(covariance[r].size(), 3U);
    EXPECT_GE(covariance[r][r].get<double>(), 0.0);
    trace += covariance[r][r].get<double>();
    for (std::size_t c = 0; c < r; ++c) {
      EXPECT_NEAR(covariance[r][c].get<double>(), covariance[c][r].get<double>(), 1e-9);
    }
  }
  EXPECT_NEAR(std::sqrt(trace), rms_mm, 1e-6);
}

/// Checks the report of accepted strokes.
void RegisterCase::expect_next_best_pose(const json& report, const std::string& label,
                                         const Transform<World, Vertebra>& truth) const {
  if (!report.contains("runner_up_rmse_mm")) {
    EXPECT_THAT(report["ambiguity"].get<std::string>(), HasSubstr("no other pose"));
    return;
  }
  const double away = error_mm(report, label, truth, "runner_up_model_to_points");
  EXPECT_NEAR(report["runner_up_distance_mm"].get<double>(), away, kRight_mm);
  EXPECT_GT(report["runner_up_margin"].get<double>(), 12.0) << "accepted";
  EXPECT_GT(report["runner_up_angle_deg"].get<double>(), 0.0);
  EXPECT_LE(report["runner_up_angle_deg"].get<double>(), 180.0);
}

TEST_P(RegisterCase, CarriesEveryFigureAndHowFarTheNextBestPoseIs) {
  const auto stroked = strokes("L4", StrokeVariant::kSparse, 4);
  const Called called = registered("L4", stroked.tips());
  ASSERT_EQ(called.code, 0) << called.err;
  const json report = json::parse(called.out);
  EXPECT_LT(error_mm(report, "L4", stroked.world_from_vertebra), kRight_mm);
  EXPECT_EQ(report["method"], "best");
  EXPECT_EQ(report["level"], "L4");
  EXPECT_EQ(report["covariance_frame"], "LPS");
  EXPECT_NEAR(report["noise_mm"].get<double>(), 0.3, 0.15) << "as the strokes were made";
  EXPECT_GT(report["inlier_share"].get<double>(), 0.95);
  EXPECT_GT(report["coverage_share"].get<double>(), 0.1);
  EXPECT_LT(report["coverage_share"].get<double>(), 0.9);
  EXPECT_GT(report["effective_points"].get<double>(), 6.0);
  EXPECT_LE(report["effective_points"].get<double>(), report["points"].get<double>());
  EXPECT_THAT(report["ambiguity"].get<std::string>(), StartsWith("unambiguous: "));
  EXPECT_FALSE(report.contains("fits_better"));
  EXPECT_THAT(report["weakest"].get<std::string>(), HasSubstr(" mm at the screws)"));
  EXPECT_THAT(report["advice"].get<std::string>(), StartsWith("digitize the "));
  ASSERT_EQ(report["screws"].size(), 2U);
  double worst = 0.0;
  double worst_95 = 0.0;
  for (const json& screw : report["screws"]) {
    for (const std::string place : {"entry", "target"}) {
      const double rms = screw["predicted_" + place + "_tre_mm"];
      const double within = screw["predicted_" + place + "_tre_95_mm"];
      EXPECT_GT(within, 1.2 * rms) << "95 of 100 of any normal distribution";
      EXPECT_LT(within, 2.0 * rms) << "one that errs along a single line";
      expect_covariance(screw[place + "_covariance_mm2"], rms);
      worst = std::max(worst, rms);
      worst_95 = std::max(worst_95, within);
    }
  }
  EXPECT_EQ(report["predicted_tre_mm"], worst);
  EXPECT_EQ(report["predicted_tre_95_mm"], worst_95);
  EXPECT_LT(worst_95, 2.0) << "accepted";
  expect_next_best_pose(report, "L4", stroked.world_from_vertebra);
}

TEST_P(RegisterCase, RefusesStrokesOfAnotherLevelNamesItAndDrawsTheRefusal) {
  const auto stroked = strokes("L3", StrokeVariant::kFull, 2);
  const std::string page_file = folder_.file("page.html");
  const Called called = registered("L4", stroked.tips(), {"--json", "-", "--report", page_file});
  EXPECT_EQ(called.code, 1);
  EXPECT_THAT(called.err, HasSubstr("level L3"));
  const json report = json::parse(called.out);
  EXPECT_EQ(report["accepted"], false);
  EXPECT_EQ(report["fits_better"], "L3");
  EXPECT_THAT(content_of(page_file),
              AllOf(HasSubstr(">refused</span>"), HasSubstr("The points fit level L3")));
  // Registered to the right level it is accepted.
  EXPECT_EQ(registered("L3", stroked.tips()).code, 0);
}

TEST_P(RegisterCase, SaysWhyNotAndWhatToStrokeNext) {
  // One flank of the spinous process alone, touched by a bad tracker.
  const auto stroked = strokes("L4", StrokeVariant::kNoisy, 3);
  std::vector<Point<World>> flank;
  for (const DigitizedSample& sample : stroked.samples) {
    if (sample.region == BoneRegion::kLeftSpinousSide) {
      flank.push_back(sample.tip);
    }
  }
  ASSERT_GT(flank.size(), 100U);
  const Called called = registered("L4", flank, {});
  ASSERT_EQ(called.code, 1) << called.out;
  EXPECT_THAT(called.out, StartsWith("refused: "));
  EXPECT_THAT(called.err, StartsWith("orthonav: refused: "));
  EXPECT_THAT(called.err, HasSubstr("orthonav: to improve: digitize the "));
}

TEST_P(RegisterCase, TakesTheBallAtThePointersEndIntoAccount) {
  constexpr double kBall_m = 0.002;
  const auto stroked = strokes("L4", StrokeVariant::kFull, 5, kBall_m);
  const Called with = registered("L4", stroked.tips(), {"--json", "-", "--tip-radius-mm", "2"});
  ASSERT_EQ(with.code, 0) << with.err;
  const json right = json::parse(with.out);
  EXPECT_LT(error_mm(right, "L4", stroked.world_from_vertebra), kRight_mm);
  EXPECT_NEAR(right["lift_mm"].get<double>(), 0.0, 0.1);
  // If the ball's radius is not given, it is found: all points are equally high above the bone.
  const json untold = json::parse(registered("L4", stroked.tips()).out);
  EXPECT_NEAR(untold["lift_mm"].get<double>(), kBall_m * 1e3, 0.1);
  EXPECT_LT(error_mm(untold, "L4", stroked.world_from_vertebra), kRight_mm);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++n;
  }
  return n;
}

TEST_P(RegisterCase, DrawsTheRegistrationOnAPageOfItsOwn) {
  const auto stroked = strokes("L4", StrokeVariant::kOutliers, 6);
  const std::string page_file = folder_.file("page.html");
  const Called called = registered("L4", stroked.tips(), {"--report", page_file});
  ASSERT_EQ(called.code, 0) << called.err;
  const std::string page = content_of(page_file);
  for (const auto& [view, pictures] : {std::pair("from behind", 2U), std::pair("from the left", 1U),
                                       std::pair("from above", 1U)}) {
    EXPECT_EQ(count(page, "role=img aria-label=\"" + std::string(view) + "\""), pictures) << view;
  }
  EXPECT_EQ(count(page, "href=\"data:image/png;base64,iVBOR"), 4U)
      << "the shaded bone, three times and under the estimated heights";
  EXPECT_EQ(count(page, "<ellipse "), 3U * 4U) << "two screws, entry and target, three views";
  EXPECT_EQ(count(page, "class=\"points\""), 3U);
  EXPECT_EQ(count(page, "class=\"off\""), 3U) << "12 % lie off the bone";
  for (const char* piece :
       {"Registration of L4", "passed the numeric checks", "95 % error ellipsoid", "not stroked",
        "left entry", "right target", "points.csv"}) {
    EXPECT_THAT(page, HasSubstr(piece));
  }
  for (const char* piece :
       {"http:", "https:", "<script", "\"nan", " nan", "-nan", "\"inf", " inf"}) {
    EXPECT_EQ(count(page, piece), 0U) << piece;
  }
  EXPECT_EQ(registered("L4", stroked.tips(), {"--report", folder_.file("again.html")}).code, 0);
  EXPECT_TRUE(page == content_of(folder_.file("again.html"))) << "the same bytes";
}

INSTANTIATE_TEST_SUITE_P(Cases, RegisterCase,
                         ::testing::Values("phantom", "visible-human", "shape-mean"),
                         [](const auto& c) {
                           std::string name = c.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(RegisterArguments, RefusesWhatDoesNotGoTogetherInOneLineAndWritesNothing) {
  const ScratchFolder folder;
  const std::string points = folder.with("points.csv", "x,y,z\n1,2,3\n");
  const std::vector<std::string> before = folder.names();
  const std::map<std::string, std::vector<std::string>> cases = {
      {"--model or --level is required", {}},
      {"--case needs --level", {"--case", folder.file("")}},
      {"--model excludes --case and --level", {"--model", "m.stl", "--level", "L4"}},
      {"--plan needs --model", {"--plan", "p.json", "--level", "L4"}},
      {"--frame needs --model", {"--frame", "RAS", "--level", "L4"}},
      {"no level 'T1' (it has: L1, L2, L3, L4, L5)", {"--level", "T1"}},
      {"none", {"--level", "L4", "--case", folder.file("none")}},
      {"only the method best", {"--level", "L4", "--tip-radius-mm", "1", "--method", "paper"}},
      {"--tip-radius-mm", {"--level", "L4", "--tip-radius-mm", "-1"}},
      {"--tip-radius-mm", {"--level", "L4", "--tip-radius-mm", "nan"}},
      {"no/such/page.html", {"--level", "L4", "--report", folder.file("no/such/page.html")}},
      {"1 points", {"--level", "L4", "--report", folder.file("page.html")}},
  };
  for (const auto& [expected, more] : cases) {
    std::vector<std::string> arguments{"register", "--points", points};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Called called = orthonav(arguments);
    EXPECT_EQ(called.code, 2) << expected;
    EXPECT_THAT(called.err, AllOf(StartsWith("orthonav: "), HasSubstr(expected)));
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
    EXPECT_THAT(called.out, IsEmpty());
    EXPECT_THAT(folder.names(), ElementsAreArray(before)) << expected;
  }
}

}  // namespace
}  // namespace orthonav::test::register_case_test
