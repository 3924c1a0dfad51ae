#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/image.h"
#include "nav/tracking/marker_detector.h"

namespace orthonav::bench {

/// Fills the tags of one image.
using Detect = std::function<bool(const GreyImage&, std::vector<nav::MarkerCorners>&)>;

struct NamedDetect {
  std::string name;
  Detect detect;
};

/// OpenCV's ArUco detector with the dictionary of that family, on one thread, once per corner
/// refinement; none if OpenCV does not have the family, or the benchmark was built without ArUco.
[[nodiscard]] std::vector<NamedDetect> aruco_detectors(const std::string& family);

}  // namespace orthonav::bench
