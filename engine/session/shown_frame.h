#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/side.h"
#include "base/time.h"
#include "base/transform.h"
#include "engine/session/shown_status.h"

namespace orthonav::engine {

/// The holograms by their numbers in docs/holograms.md: H1 to H13.
enum class HologramKind : std::uint8_t {
  kPath = 1,
  kVertebra,
  kEntry,
  kTrajectory,
  kTriangle,
  kAngle,
  kCross,
  kTwin,
  kDepth,
  kRod,
  kStatus,
  kCheckPoint,
  kNumbers,
};
/// Of each in the same order: its name, as the preview lists it, and its rank where a display takes
/// a limited number of objects: the last are left out.
struct HologramFacts {
  const char* name;
  int rank;
};
inline constexpr auto kHolograms = std::to_array<HologramFacts>({{"sampled path", 11},
                                                                 {"vertebra", 12},
                                                                 {"entry points", 8},
                                                                 {"planned trajectory", 7},
                                                                 {"deviation triangle", 1},
                                                                 {"angle readout", 2},
                                                                 {"target cross", 6},
                                                                 {"virtual twin", 13},
                                                                 {"depth", 3},
                                                                 {"rod template", 10},
                                                                 {"status line", 5},
                                                                 {"check points", 9},
                                                                 {"numbers", 4}});
static_assert(kHolograms.size() == static_cast<std::size_t>(HologramKind::kNumbers));

/// What a person wearing the display can read off one hologram: text and a few world positions.
struct ShownHologram {
  HologramKind kind = HologramKind::kPath;
  std::string level;         ///< of an entry point: the vertebra's label
  std::optional<Side> side;  ///< of an entry point, or of the screw that the numbers concern
  std::string text;          ///< what is written there, if anything
  /// The number shown: the angle (rad) or the tip's offset (m) as displayed, or the distance of a
  /// check point (m). Absent on a place still to be touched, and where dashes or a bound are shown.
  std::optional<double> reading;
  std::vector<Point<World>> points_in_world;
};

/// One displayed frame as its wearer perceives it.
struct ShownFrame {
  Timestamp display_time{};
  Timestamp pose_time{};              ///< mid-exposure of the images of the newest pose
  std::optional<ShownStatus> status;  ///< absent: no status line
  std::vector<ShownHologram> holograms;
};

}  // namespace orthonav::engine
