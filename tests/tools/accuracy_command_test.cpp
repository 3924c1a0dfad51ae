#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/printed.h"
#include "engine/print/board_file.h"
#include "tests/support/accuracy_track.h"
#include "tests/tools/command_line.h"
#include "tests/tools/tag_recording.h"

namespace orthonav::test::accuracy_command_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr int kRateHz = 10;
constexpr double kTagM = 0.08;
const Vec3 kTip{0.004, -0.06, 0.002};

/// Touch points 52 and 26 mm apart: three tags by two.
engine::Board board() {
  engine::Board board;
  board.kind = engine::BoardKind::kTags;
  board.columns = 3;
  board.rows = 2;
  board.size_m = 0.040;
  board.gap_m = 0.012;
  board.border_cells = 1;
  board.ids = engine::consecutive_ids(board.kind, board.columns, board.rows, 20);
  return board;
}

/// Renders the pointer's tag as two cameras see it during the test, with or without the board, at
/// ten pairs a second.
void record_test(const std::string& folder, bool with_board) {
  AccuracyTrackOptions options;
  options.rate_hz = kRateHz;
  options.position_noise_m = options.rotation_noise_rad = 0.0;
  options.tip_m = kTip;
  options.still_s = 3.0;
  options.turning_s = 6.0;
  std::vector<Vec3> points_m;
  if (with_board) {
    for (const engine::TouchPoint& point : engine::touch_points(board())) {
      points_m.push_back({point.at_m.x, point.at_m.y, 0.0});
    }
  }
  const auto track = accuracy_track(options, points_m);
  // Between the dimple and the board, with the pointer in its first orientation.
  const auto rig_from_world = facing({0.1, 0.06, 0.0}) * track[15].value.inverse();
  std::vector<std::vector<PlacedTag>> pairs;
  // The tag is hidden between places: at ten pairs a second a filter for thirty would not have
  // settled before the touch is over.
  const auto tip_m = [&](std::size_t i) { return (track[i].value * Point<Marker>{kTip}).v; };
  for (std::size_t i = 0; i < track.size(); ++i) {
    pairs.emplace_back();
    if (i > 0 && (tip_m(i) - tip_m(i - 1)).norm() < 1e-6) {
      pairs.back().push_back({"tag36h11", 3, kTagM, rig_from_world * track[i].value});
    }
  }
  record(folder, test_calibration(), pairs, kRateHz);
}

std::string tools_with_tip(double x_mm) {
  std::array<char, 300> text{};
  std::snprintf(text.data(), text.size(), R"({"tools": [
    {"name": "patient", "role": "reference",
     "marker": {"family": "tag36h11", "id": 17, "size_mm": 40}},
    {"name": "pointer", "role": "pointer", "tip_mm": [%g, -60, 2],
     "marker": {"family": "tag36h11", "id": 3, "size_mm": 80}}]})",
                x_mm);
  return text.data();
}

void expect_within_what_the_method_can(const json& report) {
  SCOPED_TRACE(report.dump(1));
  EXPECT_EQ(report["pointer"], "pointer");
  EXPECT_EQ(report["method"], "paper");
  // The published method measures a tag's tilt to half a degree, with the same error as long as the
  // images stay the same, and more if the tag faces the cameras: half a millimetre at a tip 60 mm
  // away, three or four times that at worst.
  EXPECT_LT(report["single_point"]["rms_mm"], 1.0);
  EXPECT_GT(report["single_point"]["rms_mm"], 0.01);
  EXPECT_GT(report["turning"]["largest_tilt_deg"], 20.0);
  EXPECT_LT(report["turning"]["residual_rms_mm"], 1.0);
  for (const double bias_mm : report["turning"]["tip_bias_mm"]) {
    EXPECT_LT(std::abs(bias_mm), 1.0);
  }
  EXPECT_EQ(report["distances"]["distances"], 36);
  EXPECT_EQ(report["distances"]["points"].size(), 9u);
  EXPECT_LT(std::abs(report["distances"]["mean_error_mm"].get<double>()), 1.0);
  EXPECT_LT(report["distances"]["max_error_mm"], 5.0);
}

TEST(AccuracyCommand, MeasuresARenderedTest) {
  const ScratchFolder folder;
  const std::string recording = folder.file("recording");
  record_test(recording, true);
  const std::string in_the_dimple = folder.file("in-the-dimple");
  record_test(in_the_dimple, false);
  ASSERT_TRUE(engine::save_board(folder.file("board.json"), board()));
  const std::string tools = folder.with("tools.json", tools_with_tip(4.0));
  const Called called = orthonav({"accuracy", recording, "--tools", tools, "--method", "paper",
                                  "--board", folder.file("board.json"), "--json"});
  ASSERT_NE(called.code, 2) << called.err;
  const json report = json::parse(called.out);
  EXPECT_EQ(called.code, report["verdict"] == "fail" ? 1 : 0);
  expect_within_what_the_method_can(report);

  // Limits from the command line apply.
  const Called wide = orthonav({"accuracy", in_the_dimple, "--tools", tools, "--method", "paper",
                                "--single-point-mm", "20", "30", "--turning-mm", "20", "30",
                                "--tip-bias-mm", "20", "30"});
  EXPECT_EQ(wide.code, 0) << wide.err;
  EXPECT_THAT(wide.out, StartsWith("accuracy test of pointer, method paper: "));
  EXPECT_THAT(wide.out, HasSubstr("distances: not tested (--board)"));
  EXPECT_THAT(wide.out, HasSubstr("verdict: pass"));

  // A tool file whose tip is elsewhere fails, and the report says where the tip is.
  const Called biased = orthonav(
      {"accuracy", in_the_dimple, "--tools", folder.with("biased.json", tools_with_tip(-4.0)),
       "--pointer", "pointer", "--method", "paper", "--json", folder.file("out.json")});
  EXPECT_EQ(biased.code, 1) << biased.err;
  EXPECT_THAT(biased.out, HasSubstr("sensitivity to orientation: fail"));
  EXPECT_THAT(biased.out, HasSubstr("verdict: fail"));
  const json failed = json::parse(content_of(folder.file("out.json")));
  EXPECT_NEAR(failed["turning"]["tip_bias_mm"][0].get<double>(), 8.0, 1.0);
}

/// A test as another tracker recorded it: matrices in mm, thirty a second.
std::string tracked_by_another(bool with_times) {
  std::string text = with_times ? "time_s," : "";
  text += "m00,m01,m02,m03_mm,m10,m11,m12,m13_mm,m20,m21,m22,m23_mm\n";
  const AccuracyTrackOptions options;
  for (const nav::TrackedPose& pose : accuracy_track(options, {})) {
    if (with_times) {
      append_printed(text, "%.4f,", seconds(pose.time.time_since_epoch()));
    }
    const auto rows = pose.value.row_major();
    for (std::size_t i = 0; i < 12; ++i) {
      append_printed(text, "%.9f%s", i % 4 == 3 ? 1e3 * rows[i] : rows[i], i < 11 ? "," : "\n");
    }
  }
  return text;
}

TEST(AccuracyCommand, JudgesThePosesOfAnyTracker) {
  const ScratchFolder folder;
  const std::string tools = folder.with("tools.json", R"({"tools": [
    {"name": "stylus", "role": "pointer", "tip_mm": [4, -150, 2]}]})");
  const std::string timed = folder.with("timed.csv", tracked_by_another(true));
  const Called called = orthonav({"accuracy", timed, "--tools", tools, "--json"});
  ASSERT_EQ(called.code, 0) << called.err;
  const json report = json::parse(called.out);
  EXPECT_EQ(report["format"], "table");
  EXPECT_FALSE(report.contains("method"));
  EXPECT_EQ(report["verdict"], "pass");
  // The track's noise: 0.05 mm an axis and 0.2 mrad over 150 mm.
  EXPECT_NEAR(report["single_point"]["rms_mm"].get<double>(), 0.1, 0.05);
  EXPECT_LT(report["turning"]["tip_bias_sigma_mm"], 0.1);

  const std::string untimed = folder.with("untimed.csv", tracked_by_another(false));
  const Called refused = orthonav({"accuracy", untimed, "--tools", tools});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("states no times, which this test needs"));
  const Called rated = orthonav({"accuracy", untimed, "--tools", tools, "--rate-hz", "30"});
  EXPECT_EQ(rated.code, 0) << rated.err;
  EXPECT_THAT(rated.out, StartsWith("accuracy test of stylus, another tracker's poses (table): "));
}

TEST(AccuracyCommand, RefusesBadInputInOneLine) {
  const ScratchFolder folder;
  const std::string short_recording = folder.file("short");
  record(short_recording, test_calibration(), {{{"tag36h11", 3, 0.05, facing()}}});
  const std::string tools = folder.with("tools.json", tools_with_tip(4.0));
  struct Case {
    std::vector<std::string> arguments;
    std::string expected;
  };
  const std::vector<Case> cases = {
      {{short_recording, "--tools", tools},
       "measured poses of the pointer, at least 30 are needed"},
      {{folder.file("none"), "--tools", tools}, "none"},
      {{short_recording}, "--tools is required"},
      {{short_recording, "--tools", tools, "--pointer", "saw"}, "no tool is named 'saw'"},
      {{short_recording, "--tools", tools, "--pointer", "patient"},
       "is a reference, it has no tip"},
      {{short_recording, "--tools", tools, "--method", "magic"}, "magic"},
      {{short_recording, "--tools", tools, "--board", tools}, "format is missing"},
      {{short_recording, "--tools", tools, "--tip-bias-mm", "1"}, "--tip-bias-mm"},
      {{short_recording, "--tools", tools, "--tip-bias-mm", "2", "1"},
       "limits of tip_bias 2 and 1 mm"},
      {{short_recording, "--tools", tools, "--json", folder.file("no/a.json")}, "does not exist"},
  };
  for (const Case& c : cases) {
    std::vector<std::string> arguments = {"accuracy"};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    const Called called = orthonav(arguments);
    EXPECT_EQ(called.code, 2) << c.expected;
    EXPECT_THAT(called.err, AllOf(HasSubstr("orthonav: "), HasSubstr(c.expected)));
    EXPECT_THAT(called.out, IsEmpty());
  }
}

}  // namespace
}  // namespace orthonav::test::accuracy_command_test
