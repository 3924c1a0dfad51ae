#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/tools/command_line.h"
#include "tests/tools/tag_recording.h"

namespace orthonav::test::calibration_argument_test {
namespace {

using ::testing::HasSubstr;

constexpr const char* kTool =
    R"({"tools": [{"name": "pointer", "role": "pointer", "tip_mm": [0, -150, 0],
        "axis": [0, -1, 0], "marker": {"family": "tag36h11", "id": 3, "size_mm": 50}}]})";

/// What `calibrate stereo` writes of a recording.
std::string file_of(const StereoCalibration& cameras) {
  auto rows = cameras.right_from_left().row_major();
  nlohmann::json pose;
  for (std::size_t r = 0; r < 4; ++r) {
    const double unit = r < 3 ? 1e3 : 1.0;
    pose.push_back({rows[4 * r], rows[4 * r + 1], rows[4 * r + 2], unit * rows[4 * r + 3]});
  }
  const nlohmann::json file = {{"format", "orthonav stereo calibration"},
                               {"verdict", "pass"},
                               {"right_from_left_mm", std::move(pose)}};
  return file.dump();
}

/// The place in the last row of the poses.
Vec3 last_place(const std::string& csv) {
  std::istringstream lines(csv);
  std::string row;
  for (std::string line; std::getline(lines, line);) {
    row = line;
  }
  Vec3 p;
  EXPECT_EQ(std::sscanf(row.c_str(), "%*d,%*d,%lf,%lf,%lf", &p.x, &p.y, &p.z), 3) << csv;
  return p;
}

TEST(CalibrationArgument, MakesUpForACameraThatIsNotWhereTheDeviceSays) {
  const ScratchFolder folder;
  const StereoCalibration device = test_calibration();
  StereoCalibration really = device;
  really.right_from_rig =
      Transform<RightCamera, RightCamera>(rotation_from_vector({0, 0.002, 0}), {}) *
      device.right_from_rig;
  PlacedTag tag;
  tag.rig_from_marker = facing({0.02, -0.01, 0.03}, {0.3, -0.2, 0.4});
  record(folder.file("recording"), really, device, {{tag}, {tag}, {tag}});
  const std::string tools = folder.with("tools.json", kTool);
  const auto off_m = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = {"track", folder.file("recording"), "-t", tools, "--csv", "-"};
    all.insert(all.end(), more.begin(), more.end());
    const Called called = orthonav(all);
    EXPECT_EQ(called.code, 0) << called.err;
    const auto world_from_rig = *stereo_frame(device, {tag}, {}).world_from_rig;
    return (last_place(called.out) - (world_from_rig * tag.rig_from_marker).translation()).norm();
  };
  const double as_told_m = off_m({});
  const double as_calibrated_m =
      off_m({"--calibration", folder.with("stereo.json", file_of(really))});
  EXPECT_GT(as_told_m, 0.0003);
  EXPECT_LT(as_calibrated_m, 0.5 * as_told_m);
}

TEST(CalibrationArgument, WinsOverTheRigFilesOfAnOpenxrHeadset) {
  const ScratchFolder folder;
  const std::string rig = folder.with("rig.json", R"({"calibration": "of-the-rig.json",
      "view_from_rig": [[1,0,0,-50], [0,1,0,10], [0,0,1,-30], [0,0,0,1]]})");
  std::vector<std::string> run = {"run", "--headset", "openxr:?rig=" + rig + "+sim:", "--out",
                                  folder.file("out")};
  const Called of_rig = orthonav(run);
  EXPECT_EQ(of_rig.code, 2);
  EXPECT_THAT(of_rig.err, HasSubstr(folder.file("of-the-rig.json")));
  run.insert(run.end(), {"--calibration", folder.file("of-the-flag.json")});
  const Called of_flag = orthonav(run);
  EXPECT_EQ(of_flag.code, 2);
  EXPECT_THAT(of_flag.err, HasSubstr(folder.file("of-the-flag.json")));
}

}  // namespace
}  // namespace orthonav::test::calibration_argument_test
