#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "hal/api/display.h"
#include "hal/sim/room.h"

namespace orthonav::sim {

/// What a wearer sees of the display. A hologram hangs where the display drew it against the true
/// head: at its world position taken back through the pose the headset believed in.
class Eyes {
 public:
  /// A frame that will light up at its display time, drawn for the believed head pose.
  void show(const ShownFrame& frame, const Transform<World, Rig>& believed_world_from_rig);
  /// When the next frame lights up, if one is waiting.
  [[nodiscard]] std::optional<Timestamp> next_due() const;
  /// That frame lights up with the true head pose of that time.
  void light_up(const Transform<Room, Rig>& true_room_from_rig);

  /// Display time of the frame in view; nothing before the first.
  [[nodiscard]] std::optional<Timestamp> seen_at() const;
  /// A hologram of the frame in view by its number ("H5"); `label` narrows it ("L4 left").
  [[nodiscard]] const ShownHologram* find(std::string_view id, std::string_view label = {}) const;
  /// Where a hologram's point hangs in the room.
  [[nodiscard]] Point<Room> place(Point<World> in_world) const {
    return room_from_world_ * in_world;
  }
  /// The workflow step on the status line ("guide L4 left"), and what follows the bar.
  [[nodiscard]] std::string_view step() const;
  [[nodiscard]] std::string_view detail() const;

 private:
  struct Waiting {
    ShownFrame frame;
    Transform<World, Rig> believed;
  };
  static constexpr std::size_t kMaxWaiting = 16;  // a quarter of a second at 60 Hz
  std::array<Waiting, kMaxWaiting> waiting_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  ShownFrame view_;
  Transform<Room, World> room_from_world_;
  std::string status_;
  bool seen_ = false;
};

}  // namespace orthonav::sim
