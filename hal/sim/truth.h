#pragma once

#include <string>
#include <vector>

#include "base/side.h"
#include "hal/sim/room.h"

namespace orthonav::sim {

/// A wire as it was actually driven, in its vertebra's frame; of each screw the last.
struct DrivenWire {
  std::string level;
  Side side = Side::kLeft;  ///< as the surgeon read it off the display
  Point<Vertebra> entry;
  Vec3 direction;       ///< unit, into the bone
  Timestamp time{};     ///< when it was in
  Timestamp pierced{};  ///< when its tip went through the cortex
};

/// A screw head where it actually stands.
struct PlacedHead {
  std::string level;
  Side side = Side::kLeft;
  Point<Room> position;
};

/// What actually happened; filled while the session runs, read afterwards by the evaluation alone
/// (engine/study/evaluation.h). Nothing that navigates may know it.
struct Truth {
  std::vector<DrivenWire> wires;
  std::vector<PlacedHead> heads;
  /// The surgeon lost patience before the last step.
  bool surgeon_gave_up = false;
};

}  // namespace orthonav::sim
