#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "hal/api/devices.h"
#include "hal/net/socket.h"

namespace orthonav::hl2ss {

/// One picture of one front camera.
struct CameraImage {
  std::uint64_t sensor_ticks = 0;
  Timestamp time{};
  HostTime arrived{};  ///< its last byte
  std::optional<Transform<World, Rig>> world_from_rig;
  GreyImage image;
};

enum class CameraSide : std::uint8_t { kLeft, kRight };

/// Brings left and right images of one moment together, by sensor ticks, in whatever order the two
/// streams bring them; their times must agree too, to a third of a frame. Holds the last few images
/// of each side; who finds no partner among those of the other side is given up when its place is
/// needed. Buffers go round.
class Pairer {
 public:
  struct Pair {
    CameraImage& left;
    CameraImage& right;
  };
  /// Swaps `image` in, and answers with the pair that it completes, valid until the next call.
  /// What is older than a pair delivered before makes none.
  std::optional<Pair> add(CameraSide side, CameraImage& image);
  /// Images that found no partner so far.
  [[nodiscard]] std::int64_t unpaired() const { return unpaired_; }
  /// A connection is new: what waits finds no partner any more.
  void forget();

 private:
  struct Slot {
    bool waits = false;
    CameraImage image;
  };
  using Slots = std::array<Slot, 4>;
  Slot& free_slot(Slots& slots);

  std::array<Slots, 2> waiting_;
  std::optional<std::uint64_t> last_ticks_;  ///< of the newest pair
  std::int64_t unpaired_ = 0;
};

}  // namespace orthonav::hl2ss
