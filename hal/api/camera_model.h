#pragma once

#include <array>

#include <optional>
#include <span>
#include <vector>

#include "base/result.h"
#include "base/vec.h"

namespace orthonav {

/// Brown-Conrady parameters (Brown 1971, as in OpenCV's calib3d: k1 k2 p1 p2 k3). With k4, k5 or k6
/// it is the rational model of Claus and Fitzgibbon 2005, as there: the radial polynomial is
/// divided by that of these three. Principal point in continuous pixels: the top-left pixel's
/// centre is at (0.5, 0.5).
struct BrownConrady {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;
  double k3 = 0.0;
  double k4 = 0.0;
  double k5 = 0.0;
  double k6 = 0.0;

  [[nodiscard]] bool is_rational() const { return k4 != 0.0 || k5 != 0.0 || k6 != 0.0; }
  /// Unit-plane point to continuous pixel.
  [[nodiscard]] Vec2 distort(Vec2 unit_plane) const;
};

/// A camera as the device describes it: the direction of each pixel's centre on the unit plane
/// (x/z, y/z), and a fast inverse. Camera frame: x right, y down, z forward, as the raw image lies.
/// Immutable and thread-safe.
class CameraModel {
 public:
  CameraModel() = default;
  /// `unit_plane` has width·height entries, row-major, for pixel centres (x+0.5, y+0.5). NaN marks
  /// a pixel without a direction. Refuses wrong sizes, infinities, a table of NaN only, and a table
  /// that folds over (not invertible).
  static Result<CameraModel> from_lookup(int width_px, int height_px, std::vector<Vec2> unit_plane);
  static Result<CameraModel> from_brown_conrady(const BrownConrady& parameters);

  [[nodiscard]] int width_px() const { return width_px_; }
  [[nodiscard]] int height_px() const { return height_px_; }
  /// Bilinear in the table, extrapolated up to one pixel past the outermost centres; nothing
  /// outside the image or where the table holds NaN.
  [[nodiscard]] std::optional<Vec2> unproject(Vec2 pixel_px) const;
  /// The pixel that sees a unit-plane point, inverse of `unproject` within 1e-6 px; nothing when
  /// outside the image.
  [[nodiscard]] std::optional<Vec2> project(Vec2 unit_plane) const;
  /// The same for a point in the camera frame; nothing behind the camera.
  [[nodiscard]] std::optional<Vec2> project(Vec3 in_camera_m) const;
  /// Derivative of the pixel by the unit-plane point, at a pixel: [du/dx du/dy; dv/dx dv/dy].
  [[nodiscard]] std::optional<std::array<double, 4>> jacobian_px(Vec2 pixel_px) const;
  [[nodiscard]] std::span<const Vec2> lookup() const { return lookup_; }

 private:
  int width_px_ = 0;
  int height_px_ = 0;
  std::vector<Vec2> lookup_;
  // Coarse grid over the unit plane holding a starting pixel for Newton's iteration.
  int grid_columns_ = 0;
  int grid_rows_ = 0;
  Vec2 grid_origin_{};
  Vec2 grid_step_{};
  std::vector<Vec2> grid_start_px_;
};

}  // namespace orthonav
