#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "hal/api/display.h"
#include "hal/sim/room/room.h"

namespace orthonav::sim {

/// What a wearer sees of the display. A hologram appears where the display drew it relative to the
/// true head: at its world position, converted with the head pose that the headset assumed.
class Eyes {
 public:
  /// A frame that will light up at its display time, drawn for the assumed head pose.
  void show(const ShownFrame& frame, const Transform<World, Rig>& believed_world_from_rig);
  /// When the next frame lights up, if one is waiting.
  [[nodiscard]] std::optional<Timestamp> next_due() const;
  /// That frame lights up with the true head pose of that time.
  void light_up(const Transform<Room, Rig>& true_room_from_rig);

  /// Display time of the frame in view; nothing before the first.
  [[nodiscard]] std::optional<Timestamp> seen_at() const;
  /// The first hologram of that kind in the frame in view, or null.
  [[nodiscard]] const ShownHologram* find(HologramKind kind) const;
  /// The numbers on the holograms of that kind in the frame in view, in their order; returns how
  /// many, at most the size of `out`.
  std::size_t readings(HologramKind kind, std::span<double> out) const;
  /// The first place that the display shows as still to be touched, if any.
  [[nodiscard]] std::optional<Point<World>> find_place_to_touch() const;
  /// The entry point of that screw, or null.
  [[nodiscard]] const ShownHologram* find_entry(std::string_view level, Side side) const;
  /// Where a hologram's point appears in the room.
  [[nodiscard]] Point<Room> place(Point<World> in_world) const {
    return room_from_world_ * in_world;
  }
  /// The status line last seen; absent before the first.
  [[nodiscard]] const std::optional<ShownStatus>& status() const { return status_; }

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
  std::optional<ShownStatus> status_;
  bool seen_ = false;
};

}  // namespace orthonav::sim
