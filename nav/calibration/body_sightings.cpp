#include "nav/calibration/body_sightings.h"

#include "nav/tracking/tag_pose.h"

namespace orthonav::nav {
namespace {

constexpr MatchLimits kWide{.gap_px = 4.0, .size_fraction = 0.6};

}  // namespace

PairSightings sightings(std::span<const MarkerDefinition> tags, std::span<const MarkerCorners> left,
                        std::span<const MarkerCorners> right, const TagGeometry& geometry) {
  PairSightings seen;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const TagMatch match = matched(left, right, tags[i].family, tags[i].id, tags[i].size_m,
                                   geometry, std::nullopt, kWide);
    TagSighting sighting;
    sighting.tag = i;
    if (match.left) {
      sighting.left_px = match.left->corners_px;
    }
    if (match.right) {
      sighting.right_px = match.right->corners_px;
    }
    if (match.both()) {
      sighting.pose =
          geometry.pose({match.left->corners_px, match.right->corners_px}, tags[i].size_m);
    }
    if (match.left || match.right) {
      seen.push_back(sighting);
    }
  }
  return seen;
}

Result<SightingCollector> SightingCollector::create(const StereoCalibration& calibration,
                                                    std::vector<MarkerDefinition> tags) {
  DetectorOptions options;
  options.families = families_of(tags);
  options.refinement = Refinement::kEdges;
  options.touched = true;
  auto detector = MarkerDetector::create(options);
  if (!detector) {
    return detector.error();
  }
  return SightingCollector(calibration, std::move(tags), std::move(detector).value());
}

void SightingCollector::add(const StereoFrame& frame) {
  if (!detector_.detect(frame.left, left_)) {
    left_.clear();
  }
  if (!detector_.detect(frame.right, right_)) {
    right_.clear();
  }
  seen_.add(left_);
  seen_.add(right_);
  pairs_.push_back(sightings(tags_, left_, right_, geometry_));
}

}  // namespace orthonav::nav
