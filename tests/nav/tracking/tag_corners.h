#pragma once

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "nav/tracking/marker_detector.h"

namespace orthonav::nav::detector_test {

inline MarkerDetector detector(DetectorOptions options = {}) {
  auto made = MarkerDetector::create(options);
  if (!made) {
    throw std::runtime_error(made.error().message);
  }
  return std::move(made).value();
}

inline double worst_px(const std::array<Vec2, 4>& a, const std::array<Vec2, 4>& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    worst = std::max(worst, (a[i] - b[i]).norm());
  }
  return worst;
}

}  // namespace orthonav::nav::detector_test
