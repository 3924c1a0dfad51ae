#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "nav/tracking/marker_detector.h"
#include "nav/tracking/tag_pose.h"

namespace orthonav::nav {

/// What two sightings must satisfy to be one tag seen by two cameras.
struct MatchLimits {
  /// Distance of the corners from the images of the triangulated ones: one unit's factory
  /// calibration was found to be off by 0.6 px across the epipolar lines; a chance match is off by
  /// tens.
  double gap_px = 2.0;
  /// Deviation of the triangulated size from the tool's, and of the four corners from a square,
  /// both relative to the size.
  double size_fraction = 0.15;
};

/// The sightings of one tag in the two images; null if there is none. Both are set only if they
/// agree with each other and with the tag's size.
struct TagMatch {
  const MarkerCorners* left = nullptr;
  const MarkerCorners* right = nullptr;
  [[nodiscard]] bool both() const { return left && right; }
};

/// The same id may be seen twice in an image (a copy, a misread): of the consistent pairs, the one
/// nearest to the expected position is taken, or, without one, the one decoded best. If only one
/// camera sees the id, that sighting is returned alone; if both do but no pair is consistent,
/// nothing is returned.
[[nodiscard]] TagMatch matched(std::span<const MarkerCorners> left,
                               std::span<const MarkerCorners> right, std::string_view family,
                               int id, double size_m, const TagGeometry& geometry,
                               const std::optional<TagPair>& expected,
                               const MatchLimits& limits = {});

/// The triangulated size of a tag that both cameras see, relative to the size given; nothing if
/// they do not see the same square.
[[nodiscard]] std::optional<double> size_ratio(std::span<const MarkerCorners> left,
                                               std::span<const MarkerCorners> right,
                                               std::string_view family, int id, double size_m,
                                               const TagGeometry& geometry,
                                               const MatchLimits& limits = {});

}  // namespace orthonav::nav
