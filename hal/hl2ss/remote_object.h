#pragma once

#include <cstdint>

#include "hal/hl2ss/scene_command.h"
#include "hal/net/socket.h"

namespace orthonav::hl2ss {

/// The headset's state of one object after it has processed everything sent so far.
struct RemoteObject {
  std::uint32_t id = 0;  ///< 0: not created, or not answered yet
  bool creating = false;
  bool active = false;
  bool placed = false;  ///< `told` holds its place
  bool looks = false;   ///< `told` holds its colour and text
  DisplayObject told;
  int refusals = 0;             ///< in a row
  HostTime ask_again{};         ///< after a refusal, it is not created again before this
  std::uint64_t wanted_in = 0;  ///< number of the last list that wanted it

  /// The object was refused or removed: nothing of it is left.
  void forget() {
    id = 0;
    creating = active = placed = looks = false;
  }
};

/// Whether the difference is visible: 0.05 mm, or a turn that moves a point 5 cm away by as much.
[[nodiscard]] bool is_moved(const DisplayObject& told, const DisplayObject& wanted);
[[nodiscard]] bool looks_different(const DisplayObject& told, const DisplayObject& wanted);

}  // namespace orthonav::hl2ss
