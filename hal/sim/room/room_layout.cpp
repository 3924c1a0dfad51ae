#include "hal/sim/room/room_layout.h"

#include <algorithm>
#include <limits>

namespace orthonav::sim {
namespace {

/// Height of the spine's lowest point above the table's top.
constexpr double kSpineOverTable_m = 0.02;
/// Where the eyes rest when there is no patient.
constexpr Vec3 kBareTable{0.0, 0.06, 0.0};

struct Box {
  Vec3 low{1e9, 1e9, 1e9};
  Vec3 high{-1e9, -1e9, -1e9};

  void add(Vec3 p) {
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
  [[nodiscard]] Vec3 middle() const { return 0.5 * (low + high); }
};

/// All of them if none is named.
std::vector<std::size_t> operated_levels(const RoomDescription& room) {
  std::vector<std::size_t> operated;
  for (std::size_t i = 0; i < room.levels.size(); ++i) {
    if (room.operated.empty() || std::find(room.operated.begin(), room.operated.end(),
                                           room.levels[i].label) != room.operated.end()) {
      operated.push_back(i);
    }
  }
  return operated;
}

/// Near the back of a level, in its middle otherwise.
Point<Vertebra> back_of(const RoomLevel& level) {
  Box box;
  for (const Vec3 vertex : level.vertices_m) {
    box.add(vertex);
  }
  return {{box.middle().x, 0.25 * box.low.y + 0.75 * box.high.y, box.middle().z}};
}

}  // namespace

RoomLayout::RoomLayout(const RoomDescription& room)
    : room_(&room), operated_(operated_levels(room)), middle_{kBareTable} {
  Box all;
  Box operated;
  for (std::size_t i = 0; i < room.levels.size(); ++i) {
    const RoomLevel& level = room.levels[i];
    bones_.emplace_back(level);
    const bool counts = std::find(operated_.begin(), operated_.end(), i) != operated_.end();
    for (const Vec3 vertex : level.vertices_m) {
      const Vec3 in_spine = (level.spine_from_vertebra * Point<Vertebra>{vertex}).v;
      all.add(in_spine);
      if (counts) {
        operated.add(in_spine);
      }
    }
  }
  if (room.levels.empty()) {
    return;
  }
  const Vec3 centre = operated.middle();
  // Spine (x left, y posterior, z superior) and Room (y up) share their axes: a prone patient's
  // back is up.
  room_from_spine_ = {Mat3::identity(), {-centre.x, kSpineOverTable_m - all.low.y, -centre.z}};
  for (const RoomLevel& level : room.levels) {
    room_from_vertebra_.push_back(room_from_spine_ * level.spine_from_vertebra);
    sites_.push_back(room_from_vertebra_.back() * back_of(level));
  }
  for (const Point<Room> site : sites_) {
    ranks_.push_back(static_cast<int>(std::count_if(
        sites_.begin(), sites_.end(), [site](Point<Room> o) { return o.v.z > site.v.z; })));
  }
  Vec3 sum;
  for (const std::size_t i : operated_) {
    sum += sites_[i].v;
  }
  middle_ = {sum / static_cast<double>(operated_.size())};
}

std::optional<std::size_t> RoomLayout::of_rank(int rank) const {
  const auto found = std::find(ranks_.begin(), ranks_.end(), rank);
  return found == ranks_.end() ? std::nullopt
                               : std::optional(static_cast<std::size_t>(found - ranks_.begin()));
}

std::optional<std::size_t> RoomLayout::find(std::string_view label) const {
  for (std::size_t i = 0; i < room_->levels.size(); ++i) {
    if (room_->levels[i].label == label) {
      return i;
    }
  }
  return std::nullopt;
}

std::optional<std::size_t> RoomLayout::tool(ToolKind kind) const {
  for (std::size_t i = 0; i < room_->tools.size(); ++i) {
    if (room_->tools[i].kind == kind) {
      return i;
    }
  }
  return std::nullopt;
}

}  // namespace orthonav::sim
