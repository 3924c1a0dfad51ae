#pragma once

#include "hal/sim/error_model.h"
#include "hal/sim/room/noise.h"
#include "hal/sim/room/room.h"

namespace orthonav::sim {

/// Where a surgeon wants the head: looking at `gaze` from the unit direction `from_gaze`.
struct HeadGoal {
  Point<Room> gaze;
  Vec3 from_gaze{0.64, 0.77, 0.0};
};

/// The head follows its goal like a slow, critically damped mass, and sways.
class HeadMotion {
 public:
  /// `eyes_in_rig`: the point of the headset that is kept at arm's length, between its cameras.
  HeadMotion(const Random& random, const ErrorModel& error_model, Vec3 eyes_in_rig,
             const HeadGoal& start);
  void advance(double step_s, const HeadGoal& goal);
  /// Includes the sway at that moment.
  [[nodiscard]] Transform<Room, Rig> pose(double time_s) const;
  static constexpr double kDistance_m = 0.47;

 private:
  Vec3 eyes_in_rig_;
  HeadGoal now_;
  Vec3 gaze_speed_;
  Vec3 angular_speed_;
  SmoothNoise3 sway_m_;
  SmoothNoise3 sway_rad_;
};

}  // namespace orthonav::sim
