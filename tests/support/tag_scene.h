#pragma once

#include <string>
#include <vector>

#include "hal/api/devices.h"
#include "nav/tracking/marker_detector.h"

namespace orthonav::test {

/// The picture of a tag, straight from the AprilTag library: true is white.
struct TagPicture {
  int cells = 0;         ///< a side, with the white border
  int border_cells = 0;  ///< outside the edge that is the tag's size
  std::vector<bool> white;
};
TagPicture tag_picture(const std::string& family, int id);

/// A tag hanging in front of the cameras.
struct PlacedTag {
  std::string family = "tag36h11";
  int id = 3;
  double size_m = 0.05;
  Transform<Rig, Marker> rig_from_marker;
};

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

/// A flat picture: the tag magnified to `cell_px` a cell with its outer edge's top left corner at
/// (x, y) in continuous pixels, on white.
GreyImage flat_picture(const std::string& family, int id, int width_px, int height_px, Vec2 corner,
                       double cell_px);

/// Kalibr's AprilGrid on white: tags of ids 0, 1, ... with a black border two cells wide, and small
/// black squares between them that touch their corners. The first tag's outer edge begins at
/// (10 cell_px · spacing) from the left and the top; the next is (1 + spacing) edges farther.
GreyImage april_grid_picture(int columns, int rows, double cell_px, double spacing);

}  // namespace orthonav::test
