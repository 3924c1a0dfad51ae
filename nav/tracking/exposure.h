#pragma once

#include <cstddef>
#include <optional>

#include "base/time.h"
#include "base/vec.h"

namespace orthonav::nav {

/// The blur and position of a tag in one image: across the edges between its columns and between
/// its rows.
struct BlurSighting {
  std::size_t view = 0;  ///< which tag in which camera
  Timestamp time{};
  Vec2 centre_px{};
  Vec2 column_px{};  ///< from one column to the next
  Vec2 row_px{};
  Vec2 blur_cells{};  ///< SD across columns, across rows
};

/// How long the cameras expose, estimated from the blur of moving tags: the variance of the blur is
/// that of the lens plus v² T² / 12 of the motion, a straight line over v² whose slope is found by
/// least squares with forgetting. Cameras do not report the exposure time, and it changes with the
/// light.
class ExposureEstimator {
 public:
  /// Sightings must come in the order of time. Three consecutive sightings of the same view are
  /// needed.
  void add(const BlurSighting& sighting);
  /// 5 ms until motion has provided an estimate.
  [[nodiscard]] double exposure_s() const;

 private:
  void add(double blur_px2, double speed_px2);

  std::optional<BlurSighting> before_;
  std::optional<BlurSighting> middle_;
  // Sums of x = v²/12 and y, with forgetting.
  double n_ = 0.0, x_ = 0.0, y_ = 0.0, xx_ = 0.0, xy_ = 0.0;
};

}  // namespace orthonav::nav
