#pragma once

#include <string>
#include <vector>

#include "base/side.h"
#include "hal/sim/room/room.h"

namespace orthonav::sim {

/// A wire as it was actually driven, in its vertebra's frame; the last one of each screw.
struct DrivenWire {
  std::string level;
  Side side = Side::kLeft;  ///< as read off the display by the surgeon
  Point<Vertebra> entry;
  Vec3 direction;       ///< unit, into the bone
  Timestamp time{};     ///< when it was in
  Timestamp pierced{};  ///< when its tip went through the cortex
};

/// The actual position of a screw head.
struct PlacedHead {
  std::string level;
  Side side = Side::kLeft;
  Point<Room> position;
};

/// What actually happened; filled while the session runs, read afterwards only by the evaluation
/// (study/evaluation.h). Navigation must not use it.
struct Truth {
  std::vector<DrivenWire> wires;
  std::vector<PlacedHead> heads;
  /// The surgeon lost patience before the last step.
  bool surgeon_gave_up = false;
};

}  // namespace orthonav::sim
