#pragma once

#include <string_view>
#include <vector>

#include "base/result.h"
#include "hal/sim/room/bone_surface.h"
#include "hal/sim/room/room.h"

namespace orthonav::sim {

/// Refuses a room with broken meshes, labels or tools, in one line each.
Status check_room(const RoomDescription& room);
/// Refuses a sound room in which a surgeon can't operate: no pointer; where screws are to be
/// placed, no guide, nothing to stroke.
Status check_surgery(const RoomDescription& room);

/// How the patient lies: prone, posterior up, the middle of the operated levels above the room's
/// origin. Keeps a view of the description, which must outlive it.
class RoomLayout {
 public:
  explicit RoomLayout(const RoomDescription& room);

  [[nodiscard]] const RoomDescription& room() const { return *room_; }
  [[nodiscard]] const Transform<Room, Spine>& room_from_spine() const { return room_from_spine_; }
  [[nodiscard]] const Transform<Room, Vertebra>& room_from_vertebra(std::size_t level) const {
    return room_from_vertebra_[level];
  }
  [[nodiscard]] const BoneSurface& bone(std::size_t level) const { return bones_[level]; }
  [[nodiscard]] std::size_t levels() const { return bones_.size(); }
  /// Index of a level by its label.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view label) const;
  /// How many levels of the room lie above this one, and which level has a given number above it.
  [[nodiscard]] int rank(std::size_t level) const { return ranks_[level]; }
  [[nodiscard]] std::optional<std::size_t> of_rank(int rank) const;
  /// Where a surgeon works on a level: the middle of its posterior half.
  [[nodiscard]] Point<Room> site(std::size_t level) const { return sites_[level]; }
  /// The middle of the whole operation; over the bare table if there is no level.
  [[nodiscard]] Point<Room> middle() const { return middle_; }
  /// Indices of the levels to be operated.
  [[nodiscard]] const std::vector<std::size_t>& operated() const { return operated_; }
  /// The first tool of a kind.
  [[nodiscard]] std::optional<std::size_t> tool(ToolKind kind) const;

 private:
  const RoomDescription* room_;
  Transform<Room, Spine> room_from_spine_;
  std::vector<Transform<Room, Vertebra>> room_from_vertebra_;
  std::vector<BoneSurface> bones_;
  std::vector<Point<Room>> sites_;
  std::vector<int> ranks_;
  std::vector<std::size_t> operated_;
  Point<Room> middle_;
};

}  // namespace orthonav::sim
