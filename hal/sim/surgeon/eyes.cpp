#include "hal/sim/surgeon/eyes.h"

#include <utility>

namespace orthonav::sim {

void Eyes::show(const ShownFrame& frame, const Transform<World, Rig>& believed) {
  if (count_ == kMaxWaiting) {
    first_ = (first_ + 1) % kMaxWaiting;
    --count_;
  }
  Waiting& slot = waiting_[(first_ + count_) % kMaxWaiting];
  slot.frame = frame;
  slot.believed = believed;
  ++count_;
}

std::optional<Timestamp> Eyes::next_due() const {
  if (count_ == 0) {
    return std::nullopt;
  }
  return waiting_[first_].frame.display_time;
}

void Eyes::light_up(const Transform<Room, Rig>& true_room_from_rig) {
  Waiting& next = waiting_[first_];
  std::swap(view_, next.frame);
  room_from_world_ = true_room_from_rig * next.believed.inverse();
  first_ = (first_ + 1) % kMaxWaiting;
  --count_;
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
