#pragma once

#include <cstddef>

#include "hal/sim/cameras/room_renderer_solids.h"

namespace orthonav::sim {

/// Which tags a camera sees without an image: what stands between it and a tag's border hides the
/// tag. The bodies are those that the room's renderer draws: plates, rods, hand and sleeve.
class TagOcclusion {
 public:
  explicit TagOcclusion(const RoomDescription& room) : bodies_(room) {}

  /// The room at a moment. For the other camera, its transform is given as the left one's.
  void look(const RoomState& now, const Transform<LeftCamera, Room>& camera_from_room);
  /// Whether another tool or the hand covers a corner of its tag or the middle of an edge. Drops on
  /// the tag itself do not count.
  [[nodiscard]] bool hides(std::size_t tool) const;

 private:
  ToolBodies bodies_;
  Solids solids_;
};

}  // namespace orthonav::sim
