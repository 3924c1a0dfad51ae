#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/side.h"
#include "base/time.h"
#include "base/transform.h"
#include "hal/api/described_tools.h"

namespace orthonav::sim {

/// A bone lying in the room: its surface in its own frame (LPS axes, metres, closed).
struct RoomLevel {
  std::string label;
  std::vector<Vec3> vertices_m;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Transform<Spine, Vertebra> spine_from_vertebra;
  /// The most posterior, left, right and superior vertices of the model made from the bone; if
  /// there is none, those of the bone itself.
  std::optional<std::array<std::uint32_t, 4>> extremes = {};
};

/// A screw that stands in its bone from the start.
struct StandingScrew {
  std::string level;
  Side side = Side::kLeft;
  Point<Vertebra> entry;
  Vec3 direction;  ///< unit, into the bone

  /// The top of its head, where it is touched.
  [[nodiscard]] Point<Vertebra> head() const { return entry - kHeadOverEntry_m * direction; }
  static constexpr double kHeadOverEntry_m = 0.010;
};

/// Which vertices these are.
[[nodiscard]] std::array<std::uint32_t, 4> extremes_of(const RoomLevel& level);

using orthonav::ToolKind;

/// A tool as it was manufactured. Its description in the planning file may be slightly off.
using RoomTool = DescribedTool;

/// A drop of blood on a tag's face, at x and y of its Marker.
struct TagDrop {
  Vec2 place_m;
  double radius_m = 0.0;
};

/// Flaws of a tag's face, apart from its size.
struct TagFlaws {
  double bow_m = 0.0;    ///< height of its edges above its middle; negative: the middle protrudes
  double bow_rad = 0.0;  ///< across which direction it is bent, from x of Marker
  std::vector<TagDrop> drops;
};

/// How much of a bone is exposed, and stroked from behind.
enum class Exposure : std::uint8_t {
  kLaminae,              ///< spinous process, laminae and facets, out to the roots of the
                         ///< transverse processes
  kTransverseProcesses,  ///< also these to their ends, as for a posterolateral fusion
  /// Both transverse processes along their length to the tips, the crest and the lower end of the
  /// spinous process, and the laminae: the places whose extremes the published registration
  /// compares (nav/published/registration.h).
  kTrainedPattern
};

/// What the surgeon says, in the words that the application listens for: to begin, to save and to
/// drop points, ...
struct SurgeonPhrases {
  std::string begin, save, drop, accept, reject, next, finish_rod;
};

/// The content of the operating room; fixed for a session.
struct RoomDescription {
  std::vector<RoomLevel> levels;  ///< may be empty: a table and tools only
  std::vector<RoomTool> tools;
  std::vector<std::string> operated;  ///< labels to be operated, in order; empty: all
  /// Then the surgeon only touches their heads, and needs neither guide nor bone to stroke.
  std::vector<StandingScrew> screws = {};
  Exposure exposure = Exposure::kLaminae;
  std::vector<TagFlaws> tag_flaws = {};  ///< one for each tool; empty: none has any
  SurgeonPhrases phrases = {};           ///< all needed where a surgeon operates
};

/// Frame of the room itself: fixed, +y up, origin on the table's top under the spine; the patient
/// lies prone, posterior up. The headset's World is this plus drift.
struct Room;

/// Where everything is at one moment: the truth. Only hal/sim and the evaluation read it.
struct RoomState {
  Timestamp time{};
  Transform<Room, Rig> room_from_rig;
  Transform<Room, Spine> room_from_spine;  ///< as drawn: follows the first operated level
  /// Each level where it is, moved by breath and push; one for each of the description.
  std::vector<Transform<Room, Vertebra>> room_from_vertebra;
  std::vector<Transform<Room, Marker>> room_from_marker;  ///< one for each tool of the description
  std::vector<bool> tool_present;                         ///< false: out of the scene
  std::optional<Point<Room>> hand;  ///< centre of the hand holding the active tool
  Vec3 hand_axis{0, 1, 0};          ///< unit, along the forearm, away from the patient
};

/// Where a level of the room is at that moment; nothing if the room has no such label.
[[nodiscard]] inline std::optional<Transform<Room, Vertebra>> room_from_level(
    const RoomDescription& room, const RoomState& state, std::string_view label) {
  for (std::size_t i = 0; i < room.levels.size() && i < state.room_from_vertebra.size(); ++i) {
    if (room.levels[i].label == label) {
      return state.room_from_vertebra[i];
    }
  }
  return std::nullopt;
}

}  // namespace orthonav::sim
