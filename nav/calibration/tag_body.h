#pragma once

#include <span>
#include <string>
#include <vector>

#include "nav/calibration/body_sightings.h"
#include "nav/statistics/verdict.h"

namespace orthonav::nav {

struct TagBodyOptions {
  /// Of the triangulated edge from the size given, relative to it.
  double max_size_deviation = 0.05;
};

struct BodyTag {
  MarkerDefinition definition;
  Transform<Marker, Tag> marker_from_tag;
  std::size_t pairs = 0;  ///< seen together with another tag
  /// 3-D SDs: the larger of the one that the residuals predict and the one from a jackknife over
  /// tenths of the recording; 0 for the first tag.
  double sigma_m = 0.0;
  double sigma_rad = 0.0;
  double size_ratio = 0.0;  ///< median triangulated edge, relative to the size given
};

/// A rigid body of tags, the first of which is its marker.
struct TagBody {
  std::vector<BodyTag> tags;
  std::size_t pairs = 0;  ///< used: with two tags or more
  double rms_px = 0.0;    ///< of the corners, 2-D
  double outlier_fraction = 0.0;
  Judgement judgement;  ///< pass or note; what fails is refused
};

/// The tags' relative poses: averaged pair by pair (`first_layout`), then all corners of all pairs
/// adjusted at once (`adjust`). Pairs must be in the order of time. Refuses fewer than
/// two tags, tags not connected with the first one (by name), sizes that the images contradict, and
/// bodies that are not rigid, each with value and limit.
Result<TagBody> calibrate_tag_body(const StereoCalibration& calibration,
                                   std::span<const MarkerDefinition> tags,
                                   std::span<const PairSightings> pairs,
                                   const TagBodyOptions& options = {});

}  // namespace orthonav::nav
