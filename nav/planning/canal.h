#pragma once

#include <optional>

#include "nav/geometry/mesh.h"

namespace orthonav::nav {

/// How a vertebra is oriented in its model, judged by its canal. A model's axes are the patient's
/// (LPS), but a vertebra from a scan is tilted in them by the lordosis.
struct CanalFrame {
  Vec3 centre_m;           ///< in the canal, on its axis
  Vec3 left;               ///< unit, the patient's left as nearly as `up` allows
  Vec3 behind;             ///< unit; left x behind = up
  Vec3 up;                 ///< unit, along the canal towards the head
  double to_body_m = 0.0;  ///< from the centre forward to the back of the body
};

/// The widest straight passage through the ring of bone around the canal. Points that have bone in
/// front, behind, to the left and to the right are taken as the canal; of the axes through their
/// middle that lean by up to 45° in the sagittal and 20° in the coronal plane, the one that stays
/// farthest from bone over 20 mm is chosen. Empty if there is no such passage: not a vertebra, half
/// of one, or one whose axes are not LPS; and if most of the bone lies behind it: RAS taken for
/// LPS.
[[nodiscard]] std::optional<CanalFrame> find_canal(const TriangleMesh& mesh,
                                                   const SurfaceIndex& surface);

}  // namespace orthonav::nav
