#pragma once

#include <cstddef>
#include <vector>

#include "hal/api/camera_model.h"
#include "nav/tracking/tag_template.h"

namespace orthonav::nav {

/// The rays of a camera, for the model of a view: the unit-plane point of every pixel's centre, one
/// array per coordinate, NaN where a pixel has no direction.
struct RayTable {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> x;
  std::vector<float> y;
  /// Pixels per unit of the unit plane, near the middle of the image.
  double focal_px = 1.0;

  explicit RayTable(const CameraModel& camera);
};

/// A tag's template, prepared for interpolation: near the edges between a cell and its neighbours,
/// grey is a polynomial in the fractions of the blur's footprint that lie over each of them.
class BlurredTag {
 public:
  /// `size_m` is measured from outer edge to outer edge of the border.
  BlurredTag(TagTemplate tag, double size_m);

  [[nodiscard]] const TagTemplate& cells() const { return tag_; }
  [[nodiscard]] double cell_m() const { return cell_m_; }
  void set_size(double size_m) { cell_m_ = tag_.cell_m(size_m); }
  /// The nine coefficients of a cell: 1, left, right, above, below, and the four corners.
  [[nodiscard]] const float* coefficients(int row, int column) const {
    return coefficients_.data() + 12 * static_cast<std::size_t>(row * tag_.cells + column);
  }

 private:
  TagTemplate tag_;
  double cell_m_ = 0.0;
  std::vector<float> coefficients_;
};

}  // namespace orthonav::nav
