#pragma once

#include <vector>

#include "base/random.h"
#include "base/vec.h"
#include "hal/sim/error_model.h"
#include "hal/sim/room/room.h"

namespace orthonav::sim {

/// Towards the lamp, in Room; unit.
[[nodiscard]] Vec3 lamp_in_room();
/// Height of a point on a tag's face above the plane of its Marker: the face is bent about an axis
/// in its plane, as paper and foils are. The mean over the tag is zero.
[[nodiscard]] double height_m(const TagFlaws& flaws, double size_m, Vec2 place_m);
/// The grey that gloss adds to a face, as a fraction of a white one's under the lamp: largest where
/// lamp and viewer mirror each other. Both directions unit, in one frame.
[[nodiscard]] double glare(double gloss, Vec3 normal, Vec3 to_lamp, Vec3 to_viewer);
/// Flickering light relative to its mean, averaged over an exposure about a time.
[[nodiscard]] double flicker(const ErrorModel& error_model, double time_s);
/// Whether a drop lies on one of the four corners of a tag.
[[nodiscard]] bool covers_a_corner(const TagFlaws& flaws, double size_m);

/// The room with tags flawed according to the error model: bent, with drops of blood.
[[nodiscard]] RoomDescription with_flawed_tags(RoomDescription room, const ErrorModel& error_model,
                                               const Random& random);

}  // namespace orthonav::sim
