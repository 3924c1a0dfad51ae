#pragma once

#include <span>

#include "hal/api/wearer.h"
#include "hal/sim/error_model.h"
#include "hal/sim/retained_implants.h"
#include "hal/sim/room/room_layout.h"
#include "hal/sim/surgeon/guidance_profile.h"
#include "hal/sim/surgeon/surgeon_body.h"

namespace orthonav::sim {

/// What a surgeon knows about their own body and the patient's, independently of the display.
struct Bearings {
  Point<Room> eyes;
  /// Motion of each level with the breath, in Room; the hands move with the level they work on. The
  /// data must exist during the tick.
  std::span<const Vec3> levels_moved_m;
};

/// Whoever operates in the room. The room moves the body that they command, and knows neither what
/// they read on the display nor what they make of it. Not thread-safe.
class Surgeon {
 public:
  virtual ~Surgeon() = default;
  /// A frame lights up; `room_from_world` is where its World appears in the room.
  virtual void see(const WornFrame& frame, const Transform<Room, World>& room_from_world) = 0;
  /// Acts until `now`.
  virtual void tick(Timestamp now, const Bearings& bearings) = 0;
  /// Where the tag of the patient reference faces, if the system relies on it: it has to stay in
  /// the cameras' sight.
  virtual void see_reference(Vec3 faces) = 0;
  [[nodiscard]] virtual SurgeonBody& body() = 0;
  /// Whether the surgeon has seen the end of the operation or has given up.
  [[nodiscard]] virtual bool finished() const = 0;
  [[nodiscard]] virtual bool gave_up() const = 0;
};

/// What a surgeon finds in the room. Layout and error model outlive them.
struct Workplace {
  const RoomLayout& layout;
  const ErrorModel& error_model;
  Random random;
  /// Only the display tells how it lies relative to the plan.
  RetainedImplants metal;
  GuidanceProfile guidance;
  bool relies_on_reference;
};

}  // namespace orthonav::sim
