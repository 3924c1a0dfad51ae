#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/aruco_methods.h"
#include "bench/tag_sequences.h"
#include "nav/tracking/marker_detector.h"

namespace orthonav::bench {

struct Seen {
  bool seen = false;
  Transform<Rig, Marker> rig_from_marker;
  PoseCovariance covariance_in_rig{};
  bool has_covariance = false;
};

/// A tag claimed in one image.
struct Sighting {
  bool right = false;  ///< camera
  int id = 0;
  Vec2 centre_px;
};

/// A method's results for a pair: one entry per tool and, if it reports them, the sightings in each
/// image.
struct Claims {
  std::vector<Seen> tools;
  std::vector<Sighting> sightings;
};

/// Tracks a pair on one thread. `claims` comes with an empty entry for each tool.
using Track = std::function<void(const StereoFrame&, Claims&)>;

struct Method {
  std::string name;
  std::function<Track(const Sequence&)> start;
};

/// A detector's corners, triangulated; absolute orientation; no filter.
[[nodiscard]] Track tracked_by_corners(const Sequence& sequence, Detect detect);

/// best, paper, AprilTag alone, and OpenCV's ArUco where the build found it.
[[nodiscard]] std::vector<Method> tracking_methods();

}  // namespace orthonav::bench
