#pragma once

#include <string>
#include <vector>

#include "hal/api/devices.h"
#include "nav/tracking/marker_detector.h"

namespace orthonav::test {

/// A tag hanging in front of the cameras.
struct PlacedTag {
  std::string family = "tag36h11";
  int id = 3;
  double size_m = 0.05;
  Transform<Rig, Marker> rig_from_marker;
};

/// What is seen beside the tags.
constexpr std::uint8_t kSceneGrey = 110;

/// Two ideal cameras like a HoloLens 2's (on their side, 0.1 m apart), and their pictures of tags
/// on mid grey, 64 rays a pixel, blurred like a lens does. No OpenCV, no simulator: a second
/// opinion on both.
StereoCalibration test_calibration();
GreyImage picture(const CameraModel& camera, const Transform<Rig, Marker>& rig_from_camera,
                  const std::vector<PlacedTag>& tags);
StereoFrame stereo_frame(const StereoCalibration& calibration, const std::vector<PlacedTag>& tags,
                         Timestamp time);

/// Where a tag's corners are seen, in the order of `MarkerCorners`.
std::array<Vec2, 4> left_corners(const StereoCalibration& calibration, const PlacedTag& tag);
std::array<Vec2, 4> right_corners(const StereoCalibration& calibration, const PlacedTag& tag);

/// In front of both cameras at a comfortable distance, turned as given, its face to the cameras.
Transform<Rig, Marker> facing(Vec3 offset_m = {}, Vec3 rotation_rad = {});

}  // namespace orthonav::test
