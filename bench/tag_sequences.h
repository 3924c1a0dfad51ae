#pragma once

#include <cstdint>
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
  /// Share of each tag's area that is not hidden, in the left and the right image.
  std::vector<std::vector<std::array<double, 2>>> visible;
  /// The same pairs without noise, for the bound.
  std::vector<StereoFrame> clean;
  double shot_variance = 0.0;  ///< a grey value's variance by grey value
  double read_variance = 0.0;
};

/// "moving", "still", "fast", "dim" and "occluded": 40 mm tags at 0.45 m, tips 150 mm below, 30
/// pairs a second. The head sways in all of them; calibration and head pose are exact.
[[nodiscard]] std::vector<std::string> sequence_names();
[[nodiscard]] Sequence make_sequence(const std::string& name, int pairs, std::uint64_t seed);

/// Variance of a tool's pose (m and rad, in the frame of the marker) that no unbiased estimator
/// undercuts, from the pair's two images: the inverse of the Fisher information, its derivatives
/// from rendering the tool displaced. Row-major 6×6.
[[nodiscard]] std::array<double, 36> cramer_rao_bound(const Sequence& sequence, std::size_t pair,
                                                      std::size_t tool);

}  // namespace orthonav::bench
