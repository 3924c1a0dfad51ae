#pragma once

#include "hal/fake/scripted.h"
#include "hal/sim/cameras/hololens2.h"

namespace orthonav::test {

inline constexpr Duration kPair = std::chrono::microseconds(33333);
inline constexpr Timestamp kStart = from_ticks_100ns(100'000'000);

inline StereoFrame dark_pair(int i) {
  StereoFrame frame;
  frame.sequence = i;
  frame.time = kStart + (i + 1) * kPair;
  frame.left = GreyImage(640, 480);
  frame.right = GreyImage(640, 480);
  frame.world_from_rig = Transform<World, Rig>{};
  return frame;
}

/// `n` dark pairs, one every 33 ms.
inline fake::Script pairs(int n) {
  fake::Script script;
  script.calibration = sim::hololens2_calibration();
  script.clock_start = kStart;
  script.display_latency = std::chrono::milliseconds(16);
  for (int i = 0; i < n; ++i) {
    script.camera.push_back(dark_pair(i));
    script.head.push_back({kStart + (i + 1) * kPair, {}});
  }
  return script;
}

}  // namespace orthonav::test
