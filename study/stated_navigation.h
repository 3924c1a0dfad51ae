#pragma once

#include "engine/case/operation.h"
#include "engine/session/method.h"
#include "hal/sim/sim_headset.h"

namespace orthonav::engine {

/// The stated error of a published system's navigation.
struct StatedNavigation {
  double target_m = 0.0;   ///< root mean square error of a target, in 3-D
  double angle_rad = 0.0;  ///< SD of the rotation about each axis
};

/// A method that registers every level with these errors drawn from the room's seed, about the
/// middle of its screws, and tracks as `best` does in the measurement model. The room and the
/// operation's models must outlive it.
[[nodiscard]] Method method_of(const StatedNavigation& stated, const sim::SimHeadset& room,
                               const Operation& operation);

}  // namespace orthonav::engine
