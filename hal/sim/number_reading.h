#pragma once

#include <optional>

#include "base/side.h"
#include "hal/sim/deviation.h"
#include "hal/sim/room.h"

namespace orthonav::sim {

/// The directions that the words beside the target cross mean to a surgeon, in Room: unit, at right
/// angles to each other. The surgeon knows how the spine lies; the axis is the one perceived.
struct SpokenDirections {
  Vec3 inward;
  Vec3 cranial;
  Vec3 medial;  ///< of a screw of that side
};
[[nodiscard]] SpokenDirections spoken_directions(const Transform<Room, Vertebra>& lies, Side side,
                                                 Vec3 outwards);

/// The reading of H13 at a moment, with its rounding: the offset of the tip from the planned axis
/// (Room, m), and the turn that would correct the aim.
struct NumberReading {
  Vec3 tip_offset_m;
  Deviation deviation;
};
/// Nothing unless all four numbers are shown.
[[nodiscard]] std::optional<NumberReading> read_numbers(const Eyes& eyes,
                                                        const SpokenDirections& directions);

}  // namespace orthonav::sim
