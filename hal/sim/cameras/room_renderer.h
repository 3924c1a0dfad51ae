#pragma once

#include <memory>
#include <span>

#include "base/image.h"
#include "hal/api/camera_model.h"
#include "hal/sim/error_model.h"
#include "hal/sim/room/room.h"

namespace orthonav::sim {

/// A pinhole view for pictures of the room: tangents of the half angles, eye axes (x right, y up,
/// -z forward).
struct PinholeView {
  Transform<Room, Eye> room_from_eye;
  double tan_left = 0.5;
  double tan_right = 0.5;
  double tan_up = 0.3;
  double tan_down = 0.3;
  /// How much of what is behind the hand it hides. 1: as in reality; less, in pictures that are to
  /// show what the hand does.
  double hand_opacity = 1.0;
};

/// Renders the room as its cameras see it. Deterministic: the image depends only on the arguments.
/// No allocation after the first frame. One thread at a time.
class RoomRenderer {
 public:
  static std::unique_ptr<RoomRenderer> create(RoomDescription room, const ErrorModel& error_model);
  virtual ~RoomRenderer() = default;
  /// One camera's image. `states` are moments spread evenly over the exposure (at least one; the
  /// middle one is mid-exposure), `camera_from_rig` and `camera` the true ones, `noise_seed` seeds
  /// this image's noise.
  virtual void render(std::span<const RoomState> states, const CameraModel& camera,
                      const Transform<LeftCamera, Rig>& camera_from_rig, std::uint64_t noise_seed,
                      GreyImage& image) = 0;
  /// A colour picture of the same room for people: the site as the surgeon's eye sees it.
  virtual void picture(const RoomState& state, const PinholeView& view, RgbaImage& image) = 0;
};

}  // namespace orthonav::sim
