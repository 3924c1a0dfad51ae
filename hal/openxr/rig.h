#pragma once

#include "base/transform.h"

namespace orthonav::openxr {

/// Where the cameras are.
struct RigOnHead {
  /// True: mounted on the headset, moving with it. False: elsewhere, in a simulation or a
  /// recording.
  bool mounted = false;
  /// The pose of the cameras' rig in the runtime's VIEW space (between the eyes, x right, y up, z
  /// backward). With cameras elsewhere: where the wearer begins. Default: the front cameras of a
  /// HoloLens 2.
  Transform<Eye, Rig> view_from_rig{Mat3::identity(), Vec3{-0.0495, 0.010, -0.030}};
};

}  // namespace orthonav::openxr
