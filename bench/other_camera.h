#pragma once

#include <vector>

#include "hal/api/camera_model.h"

namespace orthonav::bench {

/// A pinhole camera with radial and tangential distortion, written independently of hal/api.
struct Lens {
  int width_px = 0;
  int height_px = 0;
  double f_px = 0.0;
  Vec2 centre_px;  ///< the top left pixel's centre is at (0.5, 0.5)
  double k1 = 0.0, k2 = 0.0;
  double p1 = 0.0, p2 = 0.0;

  [[nodiscard]] Vec2 pixel(Vec2 unit_plane) const;
  /// The inverse, exact to 1e-12.
  [[nodiscard]] Vec2 unit_plane(Vec2 pixel_px) const;
};

/// Rays at the corners of all pixels; within a pixel they are bilinear to 1e-4 px.
class RayGrid {
 public:
  explicit RayGrid(const Lens& lens);
  [[nodiscard]] const Lens& lens() const { return lens_; }
  /// The grid's node at a pixel's top left corner.
  [[nodiscard]] Vec2 node(int x, int y) const {
    return nodes_[static_cast<std::size_t>(y * (lens_.width_px + 1) + x)];
  }
  /// The ray of a pixel's middle.
  [[nodiscard]] Vec2 middle(int x, int y) const {
    return 0.25 * (node(x, y) + node(x + 1, y) + node(x, y + 1) + node(x + 1, y + 1));
  }

 private:
  Lens lens_;
  std::vector<Vec2> nodes_;
};

/// The look-up table that a device with this lens would report.
[[nodiscard]] CameraModel reported(const Lens& lens);

}  // namespace orthonav::bench
