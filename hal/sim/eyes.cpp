#include "hal/sim/eyes.h"

#include <utility>

namespace orthonav::sim {
namespace {

constexpr std::string_view kBar = " | ";

std::string_view first_word(std::string_view text) { return text.substr(0, text.find(' ')); }

}  // namespace

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
  if (const ShownHologram* line = find("H11")) {
    status_ = line->text;
  }
}

std::optional<Timestamp> Eyes::seen_at() const {
  if (!seen_) {
    return std::nullopt;
  }
  return view_.display_time;
}

const ShownHologram* Eyes::find(std::string_view id, std::string_view label) const {
  for (const ShownHologram& hologram : view_.holograms) {
    if (first_word(hologram.name) == id &&
        (label.empty() || hologram.text == label || hologram.name.ends_with(label))) {
      return &hologram;
    }
  }
  return nullptr;
}

std::string_view Eyes::step() const {
  const std::string_view status = status_;
  return status.substr(0, status.find(kBar));
}

std::string_view Eyes::detail() const {
  const std::string_view status = status_;
  const std::size_t bar = status.find(kBar);
  return bar == std::string_view::npos ? std::string_view{} : status.substr(bar + kBar.size());
}

}  // namespace orthonav::sim
