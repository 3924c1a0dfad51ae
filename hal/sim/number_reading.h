#pragma once

#include <optional>

#include "base/side.h"
#include "hal/sim/deviation.h"
#include "hal/sim/room.h"

namespace orthonav::sim {

/// The directions that a surgeon means by the words beside the target cross, in Room: unit, at
/// right angles to each other. They know the spine that lies before them; the axis is as they see
/// it.
struct SpokenDirections {
  Vec3 inward;
  Vec3 cranial;
  Vec3 medial;  ///< of a screw of that side
};
[[nodiscard]] SpokenDirections spoken_directions(const Transform<Room, Vertebra>& lies, Side side,
                                                 Vec3 outwards);

/// What H13 says at a moment, with its rounding: how far the tip is off the planned axis (Room, m),
/// and the turn that would take out what the aim is off.
struct NumberReading {
  Vec3 tip_offset_m;
  Deviation deviation;
};
/// Nothing where not all four numbers are shown.
[[nodiscard]] std::optional<NumberReading> read_numbers(const Eyes& eyes,
                                                        const SpokenDirections& directions);

}  // namespace orthonav::sim
