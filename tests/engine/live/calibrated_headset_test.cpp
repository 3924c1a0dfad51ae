#include "engine/live/calibrated_headset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "tests/support/scripted_pairs.h"
#include "tests/support/telling_headset.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

json lens(double focal_px) {
  return {{"width_px", 640}, {"height_px", 480}, {"fx_px", focal_px}, {"fy_px", focal_px},
          {"cx_px", 320.0},  {"cy_px", 240.0},   {"k1", 0.01},        {"k2", 0.0},
          {"p1", 0.0},       {"p2", 0.0},        {"k3", 0.0}};
}

json calibration() {
  return {{"format", "orthonav stereo calibration"},
          {"left", lens(450)},
          {"right", lens(460)},
          {"right_from_left_mm", {{1, 0, 0, -98.5}, {0, 1, 0, 0.25}, {0, 0, 1, 0}, {0, 0, 0, 1}}},
          {"verdict", "pass"},
          {"reason", ""}};
}

class CalibratedHeadsetTest : public ::testing::Test {
 protected:
  Result<CalibrationFile> load(const json& content) const {
    return load_calibration(folder_.with("stereo.json", content.dump()));
  }
  std::string refusal(const std::function<void(json&)>& spoil) const {
    json content = calibration();
    spoil(content);
    const auto loaded = load(content);
    return loaded ? "loaded" : loaded.error().message;
  }
  test::TemporaryFolder folder_;
};

TEST_F(CalibratedHeadsetTest, HasTheLensesAndTheBaselineOfTheFileAndTheDevicesOwnRig) {
  fake::FakeHeadset device(test::pairs(1));
  const StereoCalibration own = device.cameras()->calibration();
  json content = calibration();
  content["left"]["width_px"] = content["right"]["width_px"] = own.left.width_px();
  content["left"]["height_px"] = content["right"]["height_px"] = own.left.height_px();
  const auto file = load(content);
  ASSERT_TRUE(file.ok()) << file.error().message;
  const auto calibrated = CalibratedHeadset::create(device, *file);
  ASSERT_TRUE(calibrated.ok()) << calibrated.error().message;
  const StereoCalibration& found = (*calibrated)->cameras()->calibration();
  EXPECT_NEAR(found.right_from_left().translation().x, -0.0985, 1e-9);
  EXPECT_NEAR(found.right_from_left().translation().y, 0.00025, 1e-9);
  EXPECT_EQ(found.left_from_rig.row_major(), own.left_from_rig.row_major());
  const auto centre = found.left.project(Vec2{0.1, 0});
  ASSERT_TRUE(centre);
  EXPECT_NEAR(centre->x, 320 + 45, 0.1);
}

TEST_F(CalibratedHeadsetTest, ReadsTheRationalModelInItsOwnPlaceAlone) {
  json content = calibration();
  for (const char* side : {"left", "right"}) {
    json& camera = content[side];
    for (const char* key : {"k1", "k2", "p1", "p2", "k3"}) {
      camera["rational"][key] = camera[key];
      camera.erase(key);
    }
    camera["rational"].update({{"k4", 0.3}, {"k5", 0.0}, {"k6", 0.0}});
  }
  const auto file = load(content);
  ASSERT_TRUE(file.ok()) << file.error().message;
  // 0.5 · (1 + 0.01 · 0.25) / (1 + 0.3 · 0.25)
  EXPECT_NEAR(file->lenses->left.project(Vec2{0.5, 0})->x, 320 + 450 * 0.5 * 1.0025 / 1.075, 0.01);
  content["left"]["rational"].erase("k6");
  EXPECT_THAT(load(content).error().message, HasSubstr("k6"));
}

TEST_F(CalibratedHeadsetTest, KeepsTheDevicesLensesWhereARecordingToldTheBaselineAlone) {
  fake::FakeHeadset device(test::pairs(1));
  json content = calibration();
  content.erase("left");
  content.erase("right");
  const auto file = load(content);
  ASSERT_TRUE(file.ok()) << file.error().message;
  const auto calibrated = CalibratedHeadset::create(device, *file);
  ASSERT_TRUE(calibrated.ok());
  EXPECT_EQ((*calibrated)->cameras()->calibration().left.lookup().size(),
            device.cameras()->calibration().left.lookup().size());
}

TEST_F(CalibratedHeadsetTest, RefusesWhatIsNoCalibrationOrNotThisHeadsets) {
  EXPECT_THAT(refusal([](json& c) { c["format"] = "tools"; }), HasSubstr("format must be"));
  EXPECT_THAT(refusal([](json& c) {
                c["verdict"] = "fail";
                c["reason"] = "too few views";
              }),
              HasSubstr("verdict is fail: too few views"));
  EXPECT_THAT(refusal([](json& c) { c.erase("right"); }), HasSubstr("right"));
  EXPECT_THAT(refusal([](json& c) { c["left"]["fx_px"] = 0; }), HasSubstr("left: "));
  EXPECT_THAT(refusal([](json& c) { c["right_from_left_mm"][0][0] = 2; }),
              HasSubstr("right_from_left_mm"));
  EXPECT_THAT(load_calibration(folder_.file("none")).error().message, HasSubstr("none"));
  fake::FakeHeadset device(test::pairs(1));
  json content = calibration();
  content["left"]["width_px"] = content["right"]["width_px"] = 800;
  const auto file = load(content);
  ASSERT_TRUE(file.ok()) << file.error().message;
  const auto other = CalibratedHeadset::create(device, *file);
  ASSERT_FALSE(other.ok());
  EXPECT_THAT(other.error().message,
              HasSubstr("left: is of images of 800 x 480 px, the headset's"));
}

TEST_F(CalibratedHeadsetTest, PassesOnWhatItsDeviceTells) {
  test::TellingHeadset device;
  const auto file = load(calibration());
  ASSERT_TRUE(file.ok()) << file.error().message;
  const auto calibrated = CalibratedHeadset::create(device, *file);
  ASSERT_TRUE(calibrated.ok()) << calibrated.error().message;
  test::expect_passed_on(device, **calibrated, true);
}

}  // namespace
}  // namespace orthonav::engine
