#pragma once

#include <array>
#include <optional>

#include "base/result.h"
#include "base/transform.h"
#include "base/vec.h"
#include "hal/hl2ss/bytes.h"

namespace orthonav::hl2ss {

struct GazeRay {
  Point<World> origin;
  Direction<World> direction;
};

struct HandJoint {
  Quaternion orientation;
  Point<World> position;
  double radius_m = 0.0;
  std::int32_t accuracy = 0;
};
using Hand = std::array<HandJoint, 26>;

/// State of a wearer's head, eyes and hands; absent: not tracked (the packet repeats old values).
struct SpatialInput {
  /// The head between the eyes, not the rig: its axes are x right, y up, z backward.
  std::optional<Transform<World, Eye>> world_from_head;
  std::optional<GazeRay> eyes;
  std::optional<Hand> left_hand;
  std::optional<Hand> right_hand;
};

/// Refuses a wrong size, and, in values that the packet marks as valid, numbers that are not finite
/// and invalid axes.
Result<SpatialInput> read_spatial_input(Bytes payload);
/// A packet with a valid head only.
[[nodiscard]] std::vector<std::uint8_t> spatial_input_bytes(
    const std::optional<Transform<World, Eye>>& world_from_head);

}  // namespace orthonav::hl2ss
