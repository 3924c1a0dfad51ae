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
  HostTime arrived{};  ///< arrival of its last byte
  std::optional<Transform<World, Rig>> world_from_rig;
  GreyImage image;
  bool repeats = false;  ///< coded anew, but the picture before it
};

enum class CameraSide : std::uint8_t { kLeft, kRight };

/// Pairs left and right images of the same moment, by sensor ticks, in any order of arrival; their
/// times must also agree to a third of a frame. Holds the last few images of each side; an image
/// without a partner is dropped when its place is needed. Buffers are reused.
class Pairer {
 public:
  struct Pair {
    CameraImage& left;
    CameraImage& right;
  };
  /// Swaps `image` in, and returns the pair that it completes, valid until the next call. An image
  /// older than a delivered pair does not form one.
  std::optional<Pair> add(CameraSide side, CameraImage& image);
  /// Number of images without a partner so far.
  [[nodiscard]] std::int64_t unpaired() const { return unpaired_; }
  /// A connection is new: waiting images can't find a partner any more.
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
