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

/// What is known of the patient references that the poses of an anchored tracker hang on.
///
/// With a reference, a session's World is the *anchored* World: it lay in the headset's map where
/// that lay when a reference was first seen, and moves with the reference from then on. What is
/// clamped to the patient rests in it, however the patient, the map or the head's noise move.
struct Anchor {
  bool in_sight = false;               ///< at least one reference was measured in the newest pair
  std::optional<Timestamp> last_seen;  ///< mid-exposure of the newest pair that measured one
  /// From the anchored World to the headset's map, by the pair of `last_seen`.
  Transform<World, World> world_from_anchored;
  /// How often references were found to have moved against each other: from then on nothing that
  /// was measured before holds.
  std::int64_t moves = 0;
  /// Of the references in use. A tracker that is given them anchors to the same World.
  std::vector<ReferencePlace> places;
  std::int64_t places_changed = 0;  ///< how many times

  /// None was seen for longer than `stale_after` before `at`: nothing may be shown on the patient.
  [[nodiscard]] bool stale(Timestamp at, Duration stale_after) const {
    return !last_seen || at - *last_seen > stale_after;
  }
};

}  // namespace orthonav::nav
