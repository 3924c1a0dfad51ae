#include "study/surgeon/eyes.h"

#include <utility>

namespace orthonav::sim {

void Eyes::see(ShownFrame frame, const Transform<Room, World>& room_from_world) {
  view_ = std::move(frame);
  room_from_world_ = room_from_world;
  seen_ = true;
  if (view_.status) {
    // Without images the line asks for nothing; the reader remembers its last request.
    const bool silent = status_ && view_.status->notice == Notice::kNoImages;
    const ChecksAsked asked = silent ? status_->checks : view_.status->checks;
    status_ = view_.status;
    status_->checks = asked;
  }
}

std::optional<Timestamp> Eyes::seen_at() const {
  if (!seen_) {
    return std::nullopt;
  }
  return view_.display_time;
}

const ShownHologram* Eyes::find(HologramKind kind) const {
  for (const ShownHologram& hologram : view_.holograms) {
    if (hologram.kind == kind) {
      return &hologram;
    }
  }
  return nullptr;
}

std::size_t Eyes::readings(HologramKind kind, std::span<double> out) const {
  std::size_t count = 0;
  for (const ShownHologram& hologram : view_.holograms) {
    if (hologram.kind == kind && hologram.reading && count < out.size()) {
      out[count++] = *hologram.reading;
    }
  }
  return count;
}

std::optional<Point<World>> Eyes::find_place_to_touch() const {
  for (const ShownHologram& hologram : view_.holograms) {
    if (hologram.kind == HologramKind::kCheckPoint && !hologram.reading &&
        !hologram.points_in_world.empty()) {
      return hologram.points_in_world.front();
    }
  }
  return std::nullopt;
}

const ShownHologram* Eyes::find_entry(std::string_view level, Side side) const {
  for (const ShownHologram& hologram : view_.holograms) {
    if (hologram.kind == HologramKind::kEntry && hologram.level == level && hologram.side == side) {
      return &hologram;
    }
  }
  return nullptr;
}

}  // namespace orthonav::sim
