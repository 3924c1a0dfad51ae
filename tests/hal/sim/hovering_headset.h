#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <utility>

#include "hal/sim/sim_headset.h"
#include "tests/hal/sim/test_rooms.h"

namespace orthonav::sim::sim_headset_test {

/// Nobody operates: the tools hover in front of the head. Nothing is rendered.
inline SimOptions hovering(std::uint64_t seed = 1) {
  SimOptions options;
  options.seed = seed;
  options.render = false;
  return options;
}

inline std::unique_ptr<SimHeadset> opened(const SimOptions& options, RoomDescription room = {}) {
  if (room.tools.empty()) {
    room.tools = test_tools();
  }
  auto headset = SimHeadset::open(std::move(room), options);
  EXPECT_TRUE(headset.ok()) << headset.error().message;
  return std::move(headset).value();
}

inline StereoFrame next_frame(SimHeadset& headset) {
  StereoFrame frame;
  const auto next = headset.cameras()->next(frame);
  EXPECT_TRUE(next.ok()) << next.error().message;
  EXPECT_EQ(*next, Next::kFrame);
  return frame;
}

}  // namespace orthonav::sim::sim_headset_test
