#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "nav/tracking/tool_tracker.h"
#include "tests/support/tag_scene.h"

namespace orthonav::nav::tracking_best_test {

/// A hundredth of the error with corners.
inline constexpr double kTipM = 0.00025;

inline ToolGeometry tool(const std::string& name, int id, double size_m) {
  ToolGeometry made;
  made.name = name;
  made.marker = {"tag36h11", id, size_m};
  made.tip_in_marker = {{0.0, -0.15, 0.0}};
  return made;
}

inline Timestamp at(int pair) { return Timestamp(std::chrono::milliseconds(1000 + 33 * pair)); }

/// The pointer on a curve, the guide still.
inline std::vector<test::PlacedTag> tags_at(int pair) {
  const double t = 0.033 * pair;
  return {{"tag36h11", 3, 0.05,
           test::facing({0.03 * std::sin(2.0 * t), 0.04 + 0.02 * std::cos(3.0 * t), 0.0},
                        {0.3, -0.3 + 0.2 * std::sin(t), 0.2 + t})},
          {"tag36h11", 5, 0.07, test::facing({-0.06, -0.07, 0.03}, {-0.2, 0.3, 1.6})}};
}

struct Tracking {
  StereoCalibration calibration = test::test_calibration();
  std::unique_ptr<ToolTracker> tracker;

  explicit Tracking(const TrackerOptions& options = {},
                    std::vector<ToolGeometry> tools = {tool("pointer", 3, 0.05),
                                                       tool("guide", 5, 0.07)}) {
    auto made = create_photometric_tracker(calibration, std::move(tools), options);
    EXPECT_TRUE(made.ok()) << made.error().message;
    if (made) {
      tracker = std::move(made).value();
    }
  }
  [[nodiscard]] StereoFrame frame(int pair) const {
    StereoFrame made = test::stereo_frame(calibration, tags_at(pair), at(pair));
    made.world_from_rig = Transform<World, Rig>{};
    return made;
  }
};

inline double tip_error_m(const ToolState& state, const test::PlacedTag& truth) {
  const Point<Marker> tip{{0.0, -0.15, 0.0}};
  return (state.rig_from_marker * tip - truth.rig_from_marker * tip).norm();
}

inline void hide(GreyImage& image) { std::fill(image.pixels.begin(), image.pixels.end(), 110); }

}  // namespace orthonav::nav::tracking_best_test
