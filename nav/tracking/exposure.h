#pragma once

#include <cstddef>
#include <optional>

#include "base/time.h"
#include "base/vec.h"

namespace orthonav::nav {

/// How a tag's blur and place looked in one image: across the edges between its columns and between
/// its rows.
struct BlurSighting {
  std::size_t view = 0;  ///< which tag in which camera
  Timestamp time{};
  Vec2 centre_px{};
  Vec2 column_px{};  ///< from one column to the next
  Vec2 row_px{};
  Vec2 blur_cells{};  ///< SD across columns, across rows
};

/// How long cameras expose, from how far tags are blurred that move: the variance of the blur is
/// that of the lens and v² T² / 12 of the motion, a straight line over v² whose slope is sought by
/// least squares with forgetting. Cameras report no exposure, and it follows the light.
class ExposureEstimator {
 public:
  /// In the order of time. Three in a row of the same view count.
  void add(const BlurSighting& sighting);
  /// 5 ms until motion has told more.
  [[nodiscard]] double exposure_s() const;

 private:
  void add(double blur_px2, double speed_px2);

  std::optional<BlurSighting> before_;
  std::optional<BlurSighting> middle_;
  // Sums of x = v²/12 and y, with forgetting.
  double n_ = 0.0, x_ = 0.0, y_ = 0.0, xx_ = 0.0, xy_ = 0.0;
};

}  // namespace orthonav::nav
