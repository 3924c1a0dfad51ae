#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hal/api/devices.h"
#include "nav/tracking/tool.h"

namespace orthonav::test {

struct TruthRow {
  Timestamp time{};
  int id = 0;
  Transform<World, Marker> world_from_marker;
  bool visible = false;
};

/// The recorded sample with its truth, read without hal/replay so that the two check each other.
struct SampleRecording {
  StereoCalibration calibration;
  std::vector<StereoFrame> frames;
  std::vector<TruthRow> truth;
  std::vector<nav::ToolGeometry> tools;

  [[nodiscard]] const TruthRow* find(Timestamp time, int id) const;
};

/// Empty if the sample is absent.
std::optional<SampleRecording> load_sample();

}  // namespace orthonav::test
