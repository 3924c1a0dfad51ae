#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "base/transform.h"
#include "hal/api/camera_model.h"
#include "nav/calibration/chessboard.h"

namespace orthonav::nav {

// The only use of OpenCV's calib3d. Pixel coordinates here follow our convention: the first pixel's
// centre is at (0.5, 0.5), not at (0, 0) as in OpenCV.

using BoardCorners = std::vector<Vec2>;  ///< px, by rows, as `Chessboard::corner_m`

/// The inner corners to a fraction of a pixel, in the order of `put_in_order`; empty unless the
/// whole board is visible.
[[nodiscard]] std::optional<BoardCorners> find_chessboard(const GreyImage& image,
                                                          const Chessboard& board);

struct ImageSize {
  int width_px = 0;
  int height_px = 0;
  friend bool operator==(ImageSize, ImageSize) = default;
};

/// Which radial terms of a lens are fitted.
enum class LensTerms {
  kTwo,      ///< k1, k2
  kThree,    ///< and k3
  kRational  ///< and k4 to k6
};

struct CameraFit {
  BrownConrady camera;
  double rms_px = 0.0;  ///< of the corners, 2-D
  double k3_sigma = 0.0;
};

/// One camera from views of the board (Zhang 2000). Terms that are not fitted are 0.
Result<CameraFit> fit_camera(const Chessboard& board, ImageSize size,
                             std::span<const BoardCorners> views, LensTerms terms);

struct StereoFit {
  BrownConrady left;
  BrownConrady right;
  Transform<RightCamera, LeftCamera> right_from_left;
  double rms_px = 0.0;                             ///< of the corners of both images, 2-D
  std::vector<std::array<double, 2>> view_rms_px;  ///< left and right
};

/// Both cameras and their relative pose, refined together from these starting values. There must be
/// as many left views as right ones.
Result<StereoFit> fit_stereo(const Chessboard& board, ImageSize size,
                             std::span<const BoardCorners> left,
                             std::span<const BoardCorners> right, const BrownConrady& left_start,
                             const BrownConrady& right_start, LensTerms terms);

}  // namespace orthonav::nav
