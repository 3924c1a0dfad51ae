#pragma once

#include <optional>
#include <span>
#include <vector>

#include "nav/tracking/marker_detector.h"
#include "nav/tracking/tag_pose.h"
#include "nav/tracking/tool.h"

namespace orthonav::nav {

/// One of the tags of a rigid body in one pair of images.
struct TagSighting {
  std::size_t tag = 0;  ///< which of the tags
  std::optional<TagCorners> left_px;
  std::optional<TagCorners> right_px;
  /// From both images, with the calibration as the device reports it.
  std::optional<TagPose> pose;
};

/// The tags seen in one pair, in the order of the tags.
using PairSightings = std::vector<TagSighting>;

/// Which of these tags a pair shows. A sighting in which the two cameras contradict each other is
/// left out, but the limits are wide enough for a wrong tag size to be noticed afterwards.
[[nodiscard]] PairSightings sightings(std::span<const MarkerDefinition> tags,
                                      std::span<const MarkerCorners> left,
                                      std::span<const MarkerCorners> right,
                                      const TagGeometry& geometry);

/// Detects in both images and keeps `sightings` of pair after pair. One thread at a time.
class SightingCollector {
 public:
  /// Fails for input that the detector refuses.
  static Result<SightingCollector> create(const StereoCalibration& calibration,
                                          std::vector<MarkerDefinition> tags);
  /// An image that the detector refuses shows no tags.
  void add(const StereoFrame& frame);
  [[nodiscard]] const std::vector<MarkerDefinition>& tags() const { return tags_; }
  [[nodiscard]] const std::vector<PairSightings>& pairs() const { return pairs_; }
  /// Those of other bodies too.
  [[nodiscard]] const SeenTags& seen_tags() const { return seen_; }

 private:
  SightingCollector(const StereoCalibration& calibration, std::vector<MarkerDefinition> tags,
                    MarkerDetector detector)
      : tags_(std::move(tags)), geometry_(calibration), detector_(std::move(detector)) {}

  std::vector<MarkerDefinition> tags_;
  TagGeometry geometry_;
  MarkerDetector detector_;
  SeenTags seen_;
  std::vector<MarkerCorners> left_;
  std::vector<MarkerCorners> right_;
  std::vector<PairSightings> pairs_;
};

}  // namespace orthonav::nav
