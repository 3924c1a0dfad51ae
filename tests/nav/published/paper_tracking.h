#pragma once

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "nav/published/corner_tracker.h"
#include "nav/tracking/tool_tracker.h"
#include "tests/support/tag_scene.h"

namespace orthonav::nav::tracking_paper_test {

using test::PlacedTag;

/// The error left by the library's corners of a noise-free picture at 0.4 m: 0.05 px RMS are 0.1 mm
/// in depth of a corner and 0.4° of tilt of a 50 mm tag; three SD.
inline constexpr double kPoseM = 0.0003;
inline constexpr double kPoseRad = 0.02;
inline constexpr int kFrameMs = 33;

inline const StereoCalibration& calibration() {
  static const StereoCalibration made = test::test_calibration();
  return made;
}

inline ToolGeometry tool(const std::string& name, int id, double size_m) {
  ToolGeometry made{name, ToolRole::kPointer, {"tag36h11", id, size_m}, {}, {}};
  made.tip_in_marker = {{0, -0.15, 0}};
  made.axis_in_marker = {{0, 1, 0}};
  return made;
}

inline std::vector<ToolGeometry> two_tools() {
  return {tool("pointer", 3, 0.05), tool("guide", 5, 0.07)};
}

inline std::unique_ptr<ToolTracker> tracker(const TrackerOptions& options = {},
                                            std::vector<ToolGeometry> tools = two_tools()) {
  auto made = published::create_corner_tracker(calibration(), std::move(tools), options);
  if (!made) {
    throw std::runtime_error(made.error().message);
  }
  return std::move(made).value();
}

inline Timestamp at_frame(int k) { return Timestamp(std::chrono::milliseconds(kFrameMs * k)); }

inline PlacedTag pointer_at(int k) {
  return {"tag36h11", 3, 0.05,
          test::facing({0.002 * k, 0.04 + 0.001 * k, 0.0}, {0.3 + 0.01 * k, -0.3, 0.2})};
}

inline PlacedTag guide_at(int k) {
  return {"tag36h11", 5, 0.07, test::facing({-0.05, -0.06, 0.05}, {-0.2, 0.3 + 0.01 * k, 1.6})};
}

inline StereoFrame frame_at(int k, const std::vector<PlacedTag>& tags) {
  StereoFrame frame = test::stereo_frame(calibration(), tags, at_frame(k));
  frame.sequence = k;
  return frame;
}

/// A short stroke of both tools, rendered once.
inline const std::vector<StereoFrame>& stroke() {
  static const std::vector<StereoFrame> frames = [] {
    std::vector<StereoFrame> made;
    for (int k = 0; k < 6; ++k) {
      made.push_back(frame_at(k, {pointer_at(k), guide_at(k)}));
    }
    return made;
  }();
  return frames;
}

inline StereoFrame shown(const StereoFrame& frame, int k) {
  StereoFrame out = frame;
  out.time = at_frame(k);
  return out;
}

inline void blind(GreyImage& image) { std::fill(image.pixels.begin(), image.pixels.end(), 90); }

}  // namespace orthonav::nav::tracking_paper_test
