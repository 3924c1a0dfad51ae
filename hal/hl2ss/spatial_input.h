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

/// What a wearer's head, eyes and hands did; absent: not tracked (the packet repeats old values).
struct SpatialInput {
  /// The head between the eyes, not the rig: its axes are x right, y up, z backward.
  std::optional<Transform<World, Eye>> world_from_head;
  std::optional<GazeRay> eyes;
  std::optional<Hand> left_hand;
  std::optional<Hand> right_hand;
};

/// Refuses a wrong size, and numbers that are not finite or axes that are no axes where the packet
/// says that they are valid.
Result<SpatialInput> read_spatial_input(Bytes payload);
/// Head only; everything else is not valid.
[[nodiscard]] std::vector<std::uint8_t> spatial_input_bytes(
    const std::optional<Transform<World, Eye>>& world_from_head);

}  // namespace orthonav::hl2ss
