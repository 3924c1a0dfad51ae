#include "engine/live/camera_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/temporary_folder.h"

namespace orthonav::engine {
namespace {

using ::testing::HasSubstr;

constexpr const char* kKalibr = R"(cam0:
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.01, 0.02, 0.0001, -0.0002]
  distortion_model: equidistant
  intrinsics: [100.0, 101.0, 39.5, 29.5]
  resolution: [80, 60]
cam1:
  T_cn_cnm1:
  - [1.0, 0.0, 0.0, -0.1]
  - [0.0, 1.0, 0.0, 0.002]
  - [0.0, 0.0, 1.0, 0.0]
  - [0.0, 0.0, 0.0, 1.0]
  camera_model: pinhole
  distortion_coeffs: [0.1, 0.02, 0.0001, -0.0002]
  distortion_model: radtan
  intrinsics: [100.0, 101.0, 39.5, 29.5]
  resolution: [80, 60]
)";

constexpr const char* kOpenCv = R"(%YAML:1.0
---
image_width: 80
image_height: 60
M1: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 100., 0., 39.5, 0., 101., 29.5, 0., 0., 1. ]
D1: !!opencv-matrix
   rows: 1
   cols: 8
   dt: d
   data: [ 0.1, 0.02, 0.0001, -0.0002, 0.01, 0.2, 0.03, 0.005 ]
M2: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 100., 0., 39.5, 0., 101., 29.5, 0., 0., 1. ]
D2: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ 0.1, 0.02, 0.0001, -0.0002, 0. ]
R: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 1., 0., 0., 0., 1., 0., 0., 0., 1. ]
T: !!opencv-matrix
   rows: 3
   cols: 1
   dt: d
   data: [ -0.1, 0.002, 0. ]
)";

std::string camera_info(const char* shift) {
  return std::string(R"(image_width: 80
image_height: 60
camera_name: eye
camera_matrix:
  rows: 3
  cols: 3
  data: [100.0, 0.0, 39.5, 0.0, 101.0, 29.5, 0.0, 0.0, 1.0]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [0.1, 0.02, 0.0001, -0.0002, 0.0]
rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}
projection_matrix: {rows: 3, cols: 4, data: [90, 0, 40, )") +
         shift + ", 0, 90, 30, 0, 0, 0, 1, 0]}\n";
}

std::string with(std::string text, const std::string& what, const std::string& instead) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), instead);
}

class CameraFiles : public ::testing::Test {
 protected:
  Result<CalibrationFile> load(const std::string& content) const {
    return load_cameras(folder_.with("cameras.yaml", content));
  }
  std::string refusal(const std::string& content) const {
    const auto loaded = load(content);
    return loaded ? "loaded" : loaded.error().message;
  }
  /// Where our lens of the same parameters sees this point, in our pixels.
  static void expect_radtan(const CameraModel& camera, double k1) {
    const BrownConrady same{80, 60, 100, 101, 40, 30, k1, 0.02, 0.0001, -0.0002, 0};
    for (const Vec2 at : {Vec2{0, 0}, Vec2{0.3, -0.2}, Vec2{-0.25, 0.1}}) {
      const auto seen = camera.project(at);
      ASSERT_TRUE(seen);
      EXPECT_LT((*seen - same.distort(at)).norm(), 0.01);
    }
  }
  test::TemporaryFolder folder_;
};

TEST_F(CameraFiles, ReadsKalibrsCamchain) {
  const auto file = load(kKalibr);
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_NEAR(file->right_from_left.translation().x, -0.1, 1e-12);
  expect_radtan(file->lenses->right, 0.1);
  // Kannala-Brandt: the angle to the axis, not its tangent, is what the radius grows with.
  const double angle = std::atan(0.3);
  const double a2 = angle * angle;
  const double radius =
      angle * (1 - 0.01 * a2 + 0.02 * a2 * a2 + 0.0001 * a2 * a2 * a2 - 0.0002 * a2 * a2 * a2 * a2);
  const auto seen = file->lenses->left.project(Vec2{0.3, 0});
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->x, 40 + 100 * radius, 0.01);
  EXPECT_NEAR(seen->y, 30, 0.01);
}

TEST_F(CameraFiles, ReadsOpenCvsFileStorageWithItsRationalModel) {
  const auto file = load(kOpenCv);
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_NEAR(file->right_from_left.translation().y, 0.002, 1e-12);
  expect_radtan(file->lenses->right, 0.1);
  const double r2 = 0.3 * 0.3;
  const double factor =
      (1 + r2 * (0.1 + r2 * (0.02 + r2 * 0.01))) / (1 + r2 * (0.2 + r2 * (0.03 + r2 * 0.005)));
  const auto seen = file->lenses->left.project(Vec2{0.3, 0});
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->x, 40 + 100 * (0.3 * factor - 0.0002 * 3 * r2), 0.01);
}

TEST_F(CameraFiles, ReadsTheTwoFilesOfRos) {
  const std::string left = folder_.with("left.yaml", camera_info("0"));
  const std::string right = folder_.with("right.yaml", camera_info("-9"));
  const auto file = load_cameras(left + "," + right);
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_NEAR(file->right_from_left.translation().x, -0.1, 1e-12);
  expect_radtan(file->lenses->left, 0.1);
  EXPECT_THAT(load_cameras(left).error().message, HasSubstr("name both files, LEFT,RIGHT"));
}

TEST_F(CameraFiles, RefusesByNameWhatItDoesNotKnow) {
  EXPECT_THAT(refusal(with(kKalibr, "pinhole", "omni")),
              HasSubstr("cameras.yaml: camera_model is omni, must be pinhole"));
  EXPECT_THAT(refusal(with(kKalibr, "equidistant", "fov")), HasSubstr("distortion_model is fov"));
  EXPECT_THAT(refusal(with(kKalibr, "T_cn_cnm1", "T_other")), HasSubstr("T_cn_cnm1 is missing"));
  EXPECT_THAT(refusal(with(kKalibr, "- [1.0, 0.0", "- [2.0, 0.0")), HasSubstr("T_cn_cnm1"));
  EXPECT_THAT(refusal(with(kKalibr, "-0.1]", "-100.0]")), HasSubstr("is it in metres?"));
  EXPECT_THAT(refusal(with(kKalibr, "[80, 60]", "[80, 0]")), HasSubstr("resolution"));
  EXPECT_THAT(refusal(with(kOpenCv, "M2:", "M3:")), HasSubstr("M2 is missing"));
  EXPECT_THAT(refusal(with(kOpenCv, "image_width", "width")), HasSubstr("image_width is missing"));
  EXPECT_THAT(refusal(with(kOpenCv, "-0.0002, 0. ]", "-0.0002, 0., 1. ]")),
              HasSubstr("D2 has 6 coefficients, must have 4, 5, 8 or 12"));
  EXPECT_THAT(refusal("notes: nothing\n"), HasSubstr("is not a calibration of orthonav"));
  EXPECT_THAT(refusal("\x01 : ["), HasSubstr("cameras.yaml: "));
  EXPECT_THAT(refusal("{}"), HasSubstr("format"));
}

}  // namespace
}  // namespace orthonav::engine
