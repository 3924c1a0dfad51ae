#pragma once

#include <vector>

#include "base/random.h"
#include "nav/calibration/body_sightings.h"
#include "tests/support/tag_scene.h"

namespace orthonav::test {

/// A rigid body of tags, as the corners that a detector with this noise would report.
struct TagBodyScene {
  StereoCalibration seen_by = test_calibration();      ///< the true calibration
  StereoCalibration calibration = test_calibration();  ///< the calibration that the device reports
  std::vector<nav::MarkerDefinition> tags;
  std::vector<Transform<Marker, Tag>> marker_from_tag;
  double noise_px = 0.05;

  /// Sightings of the tags whose faces both cameras see under less than 75°, if whole.
  [[nodiscard]] nav::PairSightings seen(const Transform<Rig, Marker>& rig_from_marker,
                                        Random& random) const;
};

/// Tags of 40 mm with ids 3, 4, 5 on neighbouring faces of a prism.
TagBodyScene prism();
/// The prism turning before the cameras, so that each of its faces comes into sight.
std::vector<Transform<Rig, Marker>> turning(int pairs);

}  // namespace orthonav::test
