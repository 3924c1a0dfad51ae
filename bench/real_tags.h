#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hal/api/devices.h"
#include "nav/tracking/marker_detector.h"
#include "nav/tracking/tag_pose.h"

namespace orthonav::bench {

struct Board;  // x along the ids of a row, y up as the upright tags are seen, z out of its face

/// A board of equal tags in rows.
struct TagBoard {
  std::string family;
  double tag_m = 0.0;  ///< outer edge of the border
  int columns = 0;
  int rows = 0;
  double pitch_m = 0.0;
  bool rows_go_up = true;

  [[nodiscard]] int tags() const { return columns * rows; }
  [[nodiscard]] Vec3 centre_m(int id) const {
    const double up = rows_go_up ? 1.0 : -1.0;
    return {pitch_m * (id % columns), up * pitch_m * (id / columns), 0.0};
  }
  void scale(double factor) {
    tag_m *= factor;
    pitch_m *= factor;
  }
};

/// Pictures of a board: of two cameras, or of one, and then the right ones are grey and see nothing
/// of it.
struct BoardPictures {
  TagBoard board;
  StereoCalibration calibration;
  bool stereo = false;
  std::vector<StereoFrame> frames;
};

/// The second camera of a set that has one: it looks elsewhere.
[[nodiscard]] StereoCalibration calibration_of_one(const CameraModel& camera);

/// The tags of the board in a picture, by their id; those seen twice are left out.
using TagsSeen = std::map<int, nav::TagCorners>;
using FindTags = std::function<TagsSeen(const GreyImage&)>;

/// A way to find corners.
struct CornerMethod {
  std::string name;
  FindTags find;
};
/// `none`, `library` and `edges` as `orthonav detect --refine`, and OpenCV's ArUco with each of its
/// refinements where the benchmark was built with it.
[[nodiscard]] std::vector<CornerMethod> corner_methods(const std::string& family);

/// Where a method puts each tag, by its id, in every frame.
using TagPoses = std::map<int, Transform<Rig, Marker>>;
struct MethodPoses {
  std::string name;
  std::vector<TagPoses> frames;
};

/// The corners in both pictures.
struct FrameCorners {
  TagsSeen left;
  TagsSeen right;
};
[[nodiscard]] std::vector<FrameCorners> corners_in(const BoardPictures& set, const FindTags& find);

/// Each tag by its own corners: triangulated, or, of one camera, OpenCV's IPPE and refinement, the
/// one of the two poses that leaves less.
[[nodiscard]] std::vector<TagPoses> poses_by_corners(const BoardPictures& set,
                                                     const std::vector<FrameCorners>& corners);
/// Each tag as `best` measures it, found by these corners.
[[nodiscard]] std::vector<TagPoses> poses_by_best(const BoardPictures& set,
                                                  const std::vector<FrameCorners>& corners);

/// The board in a frame by least squares over the corners in both pictures, without one tag's
/// (-1: all). Nothing with fewer than four tags.
[[nodiscard]] std::optional<Transform<Rig, Board>> board_pose(const BoardPictures& set,
                                                              const FrameCorners& corners,
                                                              int without = -1);
/// RMS of what that leaves, 2-D.
[[nodiscard]] double board_rms_px(const BoardPictures& set, const FrameCorners& corners,
                                  const Transform<Rig, Board>& pose);
/// The whole board as one tool of `best`, near this pose.
[[nodiscard]] std::optional<Transform<Rig, Board>> board_by_best(const BoardPictures& set,
                                                                 const StereoFrame& frame,
                                                                 const Transform<Rig, Board>& near);

}  // namespace orthonav::bench
