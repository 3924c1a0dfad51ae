#pragma once

#include "base/time.h"
#include "base/transform.h"

namespace orthonav {

/// Where the wearer of a display looks, as its eye tracker saw it: measured, never guessed.
struct Gaze {
  Point<World> origin;  ///< between the eyes
  Direction<World> direction;
  Timestamp time{};  ///< when the eyes were seen, by the headset's clock
};

}  // namespace orthonav
