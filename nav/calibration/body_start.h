#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "nav/calibration/body_adjustment.h"

namespace orthonav::nav {

/// The tags that were seen together with others: where each lies from the first one's frame.
struct TagLayout {
  std::vector<Transform<Marker, Tag>> marker_from_tag;
  /// Whether a chain of tags seen together reaches from the first one.
  std::vector<bool> reached;
};

/// A first layout: relative poses of tags that both cameras saw in the same pair, in at least so
/// many pairs, averaged (`median_pose`) and chained along the best seen ways from the first tag.
[[nodiscard]] TagLayout first_layout(std::span<const PairSightings> pairs, std::size_t tags,
                                     std::size_t min_pairs);

/// Where the body is in a pair, by the tag whose pose puts the others nearest to where they are
/// seen; nothing where no tag was seen by both cameras, or a corner would not project.
[[nodiscard]] std::optional<Transform<Rig, Marker>> first_pose(const BodyProblem& problem,
                                                               const BodyState& state,
                                                               const PairSightings& pair);

/// Takes the pairs that show two tags or more and have a first pose into problem and state, thinned
/// evenly to `most`.
void take_pairs(std::span<const PairSightings> pairs, std::size_t most, BodyProblem& problem,
                BodyState& state);

}  // namespace orthonav::nav
