#pragma once

#include <string>
#include <vector>

#include "hal/sim/room.h"

namespace orthonav::sim {

/// A wire as it was really driven, in its vertebra's frame.
struct DrivenWire {
  std::string level;
  std::string side;  ///< "left" or "right", as the surgeon read it off the display
  Point<Vertebra> entry;
  Vec3 direction;  ///< unit, into the bone
  Timestamp time{};
};

/// A screw head as it really stands.
struct PlacedHead {
  std::string level;
  std::string side;
  Point<Room> position;
};

/// What really happened; filled while the session runs, read by the evaluation afterwards. It never
/// reaches nav or engine.
struct Truth {
  std::vector<DrivenWire> wires;
  std::vector<PlacedHead> heads;
  /// world_from_spine at the end of each level's digitization (drift included), by label.
  struct LevelPose {
    std::string level;
    Timestamp time{};
    Transform<World, Vertebra> world_from_vertebra;
  };
  std::vector<LevelPose> poses;
};

}  // namespace orthonav::sim
