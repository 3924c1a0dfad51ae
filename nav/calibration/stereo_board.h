#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "nav/calibration/board_fit.h"
#include "nav/statistics/verdict.h"

namespace orthonav::nav {

/// The board in one pair of images.
struct BoardView {
  BoardCorners left_px;
  BoardCorners right_px;
};

struct StereoBoardOptions {
  /// At most this fraction of the views is left out.
  double max_outlier_fraction = 0.25;
};

struct BoardViewResidual {
  bool used = true;
  double left_rms_px = 0.0;
  double right_rms_px = 0.0;
  /// RMS distance of the right corners from the epipolar lines of the left ones.
  double epipolar_rms_px = 0.0;
};

/// Jackknife SDs: each tenth of the views is left out in turn.
struct StereoSigma {
  double baseline_m = 0.0;
  double rotation_rad = 0.0;        ///< 3-D, of the right camera to the left one
  double focal_fraction = 0.0;      ///< the larger of both cameras, relative to the focal length
  double principal_point_px = 0.0;  ///< the larger of both cameras, 2-D
};

struct StereoBoardCalibration {
  BrownConrady left;
  BrownConrady right;
  Transform<RightCamera, LeftCamera> right_from_left;
  double left_rms_px = 0.0;    ///< of the left camera calibrated by itself
  double right_rms_px = 0.0;   ///< of the right one
  double stereo_rms_px = 0.0;  ///< of both together
  /// What the plain lens model left, where the rational one is used; absent if it fitted none.
  std::optional<double> plain_rms_px = {};
  double epipolar_rms_px = 0.0;
  double covered_fraction =
      0.0;  ///< of the image that the corners cover, the smaller of both cameras
  std::optional<StereoSigma> sigma;  ///< with four views at least
  std::size_t used = 0;
  std::vector<BoardViewResidual>
      views;  ///< in the order given; for a view left out, its residual at that time
  Judgement judgement;

  [[nodiscard]] double baseline_m() const { return right_from_left.translation().norm(); }
};

/// Two cameras from pairs of board images: each camera by itself (Zhang 2000), then everything
/// together; views with mistakes are left out one by one. The third radial term is kept only where
/// it is significant (3 SDs) in a camera, and where the model with it can be inverted. Where this
/// would be refused for its residual, the rational model (k4 to k6) is fitted instead, if it leaves
/// less and can be inverted. Refuses bad boards and counts, too few views, and lenses that
/// neither describes.
Result<StereoBoardCalibration> calibrate_stereo(const Chessboard& board, ImageSize size,
                                                std::span<const BoardView> views,
                                                const StereoBoardOptions& options = {});

}  // namespace orthonav::nav
