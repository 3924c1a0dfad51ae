#include "engine/live/calibrated_headset.h"

#include "base/units.h"
#include "engine/io/json_document.h"
#include "engine/io/json_pose.h"

namespace orthonav::engine {
namespace {

BrownConrady lens_from(const JsonNode& node) {
  const bool rational = node.has("rational");
  const JsonNode lens = rational ? node.child("rational") : node;
  const auto below = [&](const char* key) { return rational ? lens.number(key) : 0.0; };
  return {node.integer("width_px"),
          node.integer("height_px"),
          node.number("fx_px"),
          node.number("fy_px"),
          node.number("cx_px"),
          node.number("cy_px"),
          lens.number("k1"),
          lens.number("k2"),
          lens.number("p1"),
          lens.number("p2"),
          lens.number("k3"),
          below("k4"),
          below("k5"),
          below("k6")};
}

Result<CameraModel> model_from(const BrownConrady& lens, const std::string& where) {
  auto model = CameraModel::from_brown_conrady(lens);
  if (!model) {
    return Error{where + ": " + model.error().message};
  }
  return model;
}

std::string size_text(const CameraModel& camera) {
  return std::to_string(camera.width_px()) + " x " + std::to_string(camera.height_px());
}

Status check_size(const std::string& where, const CameraModel& own, const CameraModel& device) {
  if (own.width_px() == device.width_px() && own.height_px() == device.height_px()) {
    return {};
  }
  return Error{where + ": is of images of " + size_text(own) + " px, the headset's have " +
               size_text(device)};
}

}  // namespace

Result<CalibrationFile> load_calibration(const std::string& path) {
  const auto document = JsonDocument::read(path);
  if (!document) {
    return document.error();
  }
  const JsonNode root = document->root();
  if (root.text("format") != "orthonav stereo calibration") {
    root.refuse("format", "must be \"orthonav stereo calibration\", of orthonav calibrate stereo");
  }
  if (root.text("verdict") == "fail") {
    root.refuse("verdict", "is fail: " + root.text_or("reason", "no reason") + "; calibrate again");
  }
  const bool has_lenses = root.has("left") || root.has("right");
  BrownConrady left;
  BrownConrady right;
  if (has_lenses) {
    left = lens_from(root.child("left"));
    right = lens_from(root.child("right"));
  }
  constexpr const char* kPose = "right_from_left_mm";
  const auto rows = pose_rows(root, kPose, kMetresPerMm);
  CalibrationFile file{path, {}, rigid_pose<RightCamera, LeftCamera>(root, kPose, rows)};
  if (const Status read = document->status(); !read) {
    return read.error();
  }
  if (has_lenses) {
    auto left_model = model_from(left, path + ": left");
    auto right_model = left_model ? model_from(right, path + ": right") : left_model;
    if (!right_model) {
      return right_model.error();
    }
    file.lenses = {std::move(*left_model), std::move(*right_model)};
  }
  return file;
}

Result<std::unique_ptr<CalibratedHeadset>> CalibratedHeadset::create(Headset& headset,
                                                                     const CalibrationFile& file) {
  if (headset.cameras() == nullptr) {
    return Error{file.name + ": " + headset.name() + " has no cameras to calibrate"};
  }
  StereoCalibration calibration = headset.cameras()->calibration();
  if (file.lenses) {
    const Status left = check_size(file.name + ": left", file.lenses->left, calibration.left);
    const Status both =
        left ? check_size(file.name + ": right", file.lenses->right, calibration.right) : left;
    if (!both) {
      return both.error();
    }
    calibration.left = file.lenses->left;
    calibration.right = file.lenses->right;
  }
  calibration.right_from_rig = file.right_from_left * calibration.left_from_rig;
  return std::unique_ptr<CalibratedHeadset>(new CalibratedHeadset(headset, std::move(calibration)));
}

}  // namespace orthonav::engine
