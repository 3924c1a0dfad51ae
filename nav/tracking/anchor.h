#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/time.h"
#include "base/transform.h"

namespace orthonav::nav {

/// Where a patient reference lies in the anchored World.
struct ReferencePlace {
  std::size_t tool = 0;
  Transform<World, Marker> anchored_from_marker;
};

/// The state of the patient references to which an anchored tracker's poses are relative.
///
/// With a reference, a session's World is the *anchored* World: it coincides with the headset's map
/// at the moment when a reference was first seen, and moves with the reference from then on.
/// Anything clamped to the patient is at rest in it, regardless of motion of the patient, the map
/// or the head's noise.
struct Anchor {
  bool in_sight = false;               ///< at least one reference was measured in the newest pair
  std::optional<Timestamp> last_seen;  ///< mid-exposure of the newest pair that measured one
  /// From the anchored World to the headset's map, from the pair at `last_seen`.
  Transform<World, World> world_from_anchored;
  /// How often references were found to have moved relative to each other; each time, everything
  /// measured before becomes invalid.
  std::int64_t moves = 0;
  /// Where the references in use lie. A tracker created with them anchors to the same World.
  std::vector<ReferencePlace> places;
  std::int64_t places_changed = 0;  ///< how many times

  /// Whether no reference was seen within `stale_after` before `at`: then nothing may be shown on
  /// the patient.
  [[nodiscard]] bool stale(Timestamp at, Duration stale_after) const {
    return !last_seen || at - *last_seen > stale_after;
  }
};

}  // namespace orthonav::nav
