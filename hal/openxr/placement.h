#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hal/api/devices.h"
#include "hal/openxr/xr_values.h"

namespace orthonav::openxr {

/// How the cameras' world relates to the display's space.
enum class Placement {
  /// The cameras are mounted on the headset: World is the runtime's space, and a pair's pose is the
  /// headset's.
  kMounted,
  /// The cameras are elsewhere, in a simulation or a recording: World is the cameras', and the
  /// runtime's space is placed in it so that the wearer begins at the cameras.
  kElsewhere
};

/// Where World is in the runtime's space, and which of its maps this is. A move is announced before
/// it takes effect; for times before it the old answer still holds. One thread at a time.
class WorldAnchor {
 public:
  explicit WorldAnchor(Placement placement);

  /// Empty until World has been placed.
  [[nodiscard]] std::optional<Transform<World, Space>> world_from_space(XrTime at) const;
  /// Number of moves.
  [[nodiscard]] std::int64_t epoch(XrTime at) const;
  /// Places World so that the viewer is at `world_from_viewer`, unless it has been placed already.
  void lay(XrTime at, const Transform<World, Viewer>& world_from_viewer,
           const Transform<Space, Viewer>& space_from_viewer);
  /// From then on the runtime's space is a new one. `old_from_new`: where it is in the old one, if
  /// that is known.
  void move(XrTime from, const std::optional<Transform<Space, Space>>& old_from_new);

 private:
  struct Stretch {
    XrTime from = 0;
    std::int64_t epoch = 0;
    std::optional<Transform<World, Space>> world_from_space;
  };
  [[nodiscard]] const Stretch& at(XrTime time) const;

  Placement placement_;
  std::vector<Stretch> stretches_;  ///< in order of time, the newest few
};

}  // namespace orthonav::openxr
