#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "nav/calibration/body_adjustment.h"

namespace orthonav::nav {

/// The tags that were seen together with others: the pose of each in the first one's frame.
struct TagLayout {
  std::vector<Transform<Marker, Tag>> marker_from_tag;
  /// whether a chain of tags seen together connects it with the first one
  std::vector<bool> reached;
};

/// A first layout: relative poses of tags that both cameras saw together in at least this many
/// pairs, averaged (`median_pose`) and chained from the first tag along the connections seen most
/// often.
[[nodiscard]] TagLayout first_layout(std::span<const PairSightings> pairs, std::size_t tags,
                                     std::size_t min_pairs);

/// The body's pose in a pair, from the tag whose pose puts the others nearest to where they are
/// seen; empty if no tag was seen by both cameras or a corner would not project.
[[nodiscard]] std::optional<Transform<Rig, Marker>> first_pose(const BodyProblem& problem,
                                                               const BodyState& state,
                                                               const PairSightings& pair);

/// Adds to problem and state the pairs that show two tags or more and have a first pose, thinned
/// evenly to `most`.
void take_pairs(std::span<const PairSightings> pairs, std::size_t most, BodyProblem& problem,
                BodyState& state);

}  // namespace orthonav::nav
