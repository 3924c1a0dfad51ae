#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/case/tool_file.h"
#include "tests/tools/command_line.h"
#include "tests/tools/tag_recording.h"

namespace orthonav::test::calibrate_axis_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int kPairs = 60;
const Vec3 kAxis = Vec3{0.012, 1.0, -0.008}.normalized();

// A guide with tag 5 turned to and fro about its shaft, by `side_rad` to each side.
std::vector<std::vector<PlacedTag>> spinning(double side_rad) {
  std::vector<std::vector<PlacedTag>> pairs;
  const Vec3 tip_in_rig = (facing() * Point<Marker>{{0, -0.05, 0}}).v;
  for (int i = 0; i < kPairs; ++i) {
    const Mat3 rotation = rotation_from_vector(side_rad * std::sin(0.31 * i) * kAxis);
    pairs.push_back({{"tag36h11", 5, 0.05, {rotation, tip_in_rig - rotation * Vec3{0, -0.05, 0}}}});
  }
  return pairs;
}

class CalibrateAxis : public ::testing::Test {
 protected:
  void SetUp() override {
    tools_ = folder_.with("tools.json", R"({"tools": [
      {"name": "guide", "role": "guide", "axis": [0, 1, 0],
       "marker": {"family": "tag36h11", "id": 5, "size_mm": 50}, "tip_mm": [0, -50, 0]}]})");
  }
  Called axis(const std::string& recording, std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {"calibrate", "axis",   recording, "--tools",
                                    tools_,      "--tool", "guide"};
    all.insert(all.end(), more.begin(), more.end());
    return orthonav(all);
  }
  ScratchFolder folder_;
  std::string tools_;
};

TEST_F(CalibrateAxis, FindsTheAxisAndWritesItIntoTheTools) {
  const std::string recording = folder_.file("recording");
  record(recording, test_calibration(), spinning(0.9));
  const Called called = axis(recording, {"--json", "--out", tools_});
  ASSERT_EQ(called.code, 0) << called.err;
  const auto json = nlohmann::json::parse(called.out);
  const auto tools = engine::load_tools(tools_);
  ASSERT_TRUE(tools.ok()) << tools.error().message;
  const double off_deg = degrees(angle_between_rad(tools->at(0).axis_in_marker.v, kAxis));
  EXPECT_LT(off_deg, 0.1) << "the file was " << json["off_deg"] << "° off";
  EXPECT_LT(off_deg, 3.5 * json["axis_sigma_deg"].get<double>());
  EXPECT_NEAR(json["off_deg"], degrees(angle_between_rad(kAxis, {0, 1, 0})), 0.1);
  EXPECT_EQ(tools->at(0).tip_in_marker.v, (Vec3{0, -0.05, 0}));
  const Called plain = axis(recording);
  EXPECT_THAT(plain.out, HasSubstr("guide: axis "));
}

TEST_F(CalibrateAxis, RefusesInOneLineAndWritesNothing) {
  const std::string still = folder_.file("still");
  record(still, test_calibration(), spinning(0.2));
  const Called called = axis(still, {"--json", "--out", folder_.file("out.json")});
  EXPECT_EQ(called.code, 1) << called.out;
  EXPECT_THAT(called.err, HasSubstr("orthonav: refused: axis calibration: the tool turned by"));
  EXPECT_THAT(folder_.names(), ElementsAre("still", "tools.json"));
  EXPECT_EQ(axis(folder_.file("none")).code, 2);
}

}  // namespace
}  // namespace orthonav::test::calibrate_axis_test
