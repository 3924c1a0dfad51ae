#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "engine/session/shown_frame.h"
#include "hal/sim/room/room.h"

namespace orthonav::sim {

using engine::ChecksAsked;
using engine::HologramKind;
using engine::Notice;
using engine::ShownFrame;
using engine::ShownHologram;
using engine::ShownStatus;
using engine::Step;
using engine::StepOnDisplay;

/// What a wearer sees of the display.
class Eyes {
 public:
  /// A frame lights up; `room_from_world` is where its World appears in the room.
  void see(ShownFrame frame, const Transform<Room, World>& room_from_world);

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
  ShownFrame view_;
  Transform<Room, World> room_from_world_;
  std::optional<ShownStatus> status_;
  bool seen_ = false;
};

}  // namespace orthonav::sim
