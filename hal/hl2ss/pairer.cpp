#include "hal/hl2ss/pairer.h"

#include <algorithm>
#include <utility>

#include "hal/api/research_mode.h"

namespace orthonav::hl2ss {
namespace {

/// 1 ms in ticks of 1 ns; in practice the cameras of one rig differ by some 10 ns.
constexpr std::uint64_t kWithinTicks = 1'000'000;
/// Also keeps two moments apart for a server whose ticks are not nanoseconds.
constexpr Duration kStampsWithin = kGreyCameraInterval / 3;

std::uint64_t apart(std::uint64_t a, std::uint64_t b) { return a > b ? a - b : b - a; }

bool are_of_one_moment(const CameraImage& a, const CameraImage& b) {
  return apart(a.sensor_ticks, b.sensor_ticks) <= kWithinTicks &&
         a.time - b.time <= kStampsWithin && b.time - a.time <= kStampsWithin;
}

}  // namespace

Pairer::Slot& Pairer::free_slot(Slots& slots) {
  const auto free =
      std::find_if(slots.begin(), slots.end(), [](const Slot& s) { return !s.waits; });
  if (free != slots.end()) {
    return *free;
  }
  ++unpaired_;
  return *std::min_element(slots.begin(), slots.end(), [](const Slot& a, const Slot& b) {
    return a.image.sensor_ticks < b.image.sensor_ticks;
  });
}

std::optional<Pairer::Pair> Pairer::add(CameraSide side, CameraImage& image) {
  const auto mine = static_cast<std::size_t>(side);
  if (last_ticks_ && image.sensor_ticks <= *last_ticks_) {
    ++unpaired_;
    return std::nullopt;
  }
  Slot& slot = free_slot(waiting_[mine]);
  std::swap(slot.image, image);
  slot.waits = true;
  Slots& others = waiting_[1 - mine];
  const std::uint64_t ticks = slot.image.sensor_ticks;
  const auto nearest =
      std::min_element(others.begin(), others.end(), [ticks](const Slot& a, const Slot& b) {
        if (a.waits != b.waits) {
          return a.waits;
        }
        return apart(a.image.sensor_ticks, ticks) < apart(b.image.sensor_ticks, ticks);
      });
  if (!nearest->waits || !are_of_one_moment(nearest->image, slot.image)) {
    return std::nullopt;
  }
  const std::uint64_t newest = std::max(ticks, nearest->image.sensor_ticks);
  last_ticks_ = newest;
  slot.waits = nearest->waits = false;
  for (Slots& slots : waiting_) {
    for (Slot& older : slots) {
      if (older.waits && older.image.sensor_ticks <= newest) {
        older.waits = false;
        ++unpaired_;
      }
    }
  }
  CameraImage& left = side == CameraSide::kLeft ? slot.image : nearest->image;
  CameraImage& right = side == CameraSide::kLeft ? nearest->image : slot.image;
  return Pair{left, right};
}

void Pairer::forget() {
  for (Slots& slots : waiting_) {
    for (Slot& slot : slots) {
      unpaired_ += slot.waits ? 1 : 0;
      slot.waits = false;
    }
  }
  last_ticks_.reset();
}

}  // namespace orthonav::hl2ss
