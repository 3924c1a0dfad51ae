#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hal/api/devices.h"
#include "nav/tracking/tool.h"

namespace orthonav::bench {

/// Rendered stereo pairs of two tools over a draped table, with the truth.
struct Sequence {
  std::string name;
  StereoCalibration calibration;
  std::vector<nav::ToolGeometry> tools;
  std::vector<StereoFrame> frames;
  /// By pair and tool.
  std::vector<std::vector<Transform<Rig, Marker>>> rig_from_marker;
  /// Fraction of each tag's area that is not hidden, in the left and the right image.
  std::vector<std::vector<std::array<double, 2>>> visible;
  /// The smallest variance that an unbiased estimator of a tool's pose can have (m and rad, in the
  /// marker's frame), from the images of this pair and tool alone: the inverse of the Fisher
  /// information, with derivatives from rendering the tool displaced. Row-major 6×6. Empty where
  /// nothing can be rendered again.
  std::function<std::array<double, 36>(std::size_t pair, std::size_t tool)> bound;
};

/// "moving", "still", "fast", "dim" and "occluded": 40 mm tags at 0.45 m, tips 150 mm below, 30
/// pairs a second. The head sways in all of them; calibration and head pose are exact.
[[nodiscard]] std::vector<std::string> sequence_names();
[[nodiscard]] Sequence make_sequence(const std::string& name, int pairs, std::uint64_t seed);

}  // namespace orthonav::bench
