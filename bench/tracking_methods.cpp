#include "bench/tracking_methods.h"

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "bench/aruco_methods.h"
#include "nav/published/corner_tracker.h"
#include "nav/tracking/tag_pose.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::bench {
namespace {

Track tracker(const Sequence& sequence, auto create) {
  nav::TrackerOptions options;
  options.parallel = false;
  auto made = create(sequence.calibration, sequence.tools, options);
  if (!made) {
    std::fprintf(stderr, "%s\n", made.error().message.c_str());
    std::exit(2);
  }
  const std::shared_ptr<nav::ToolTracker> tracker = std::move(*made);
  return [tracker](const StereoFrame& frame, Claims& claims) {
    for (const nav::ToolState& state : tracker->track(frame)) {
      if (state.world_from_marker.status != PoseStatus::kMeasured) {
        continue;
      }
      const auto rig_from_world = frame.world_from_rig->inverse();
      claims.tools[state.tool] = {
          true, rig_from_world * state.world_from_marker.value,
          nav::rotated(state.world_from_marker.covariance, rig_from_world.rotation()), true};
    }
  };
}

Track apriltag(const Sequence& sequence, double decimate) {
  nav::DetectorOptions options;
  options.decimate = decimate;
  const auto detector =
      std::make_shared<nav::MarkerDetector>(nav::MarkerDetector::create(options).value());
  return tracked_by_corners(sequence, [detector](const GreyImage& image, auto& found) {
    return detector->detect(image, found).ok();
  });
}

void note(std::span<const nav::MarkerCorners> found, bool right, std::vector<Sighting>& sightings) {
  for (const nav::MarkerCorners& tag : found) {
    Vec2 centre;
    for (const Vec2 corner : tag.corners_px) {
      centre = centre + 0.25 * corner;
    }
    sightings.push_back({right, tag.id, centre});
  }
}

}  // namespace

Track tracked_by_corners(const Sequence& sequence, Detect detect) {
  const auto geometry = std::make_shared<nav::TagGeometry>(sequence.calibration);
  return [=, tools = sequence.tools](const StereoFrame& frame, Claims& claims) {
    std::vector<nav::MarkerCorners> left;
    std::vector<nav::MarkerCorners> right;
    if (!detect(frame.left, left) || !detect(frame.right, right)) {
      return;
    }
    note(left, false, claims.sightings);
    note(right, true, claims.sightings);
    for (std::size_t i = 0; i < tools.size(); ++i) {
      const auto& marker = tools[i].marker;
      const nav::TagMatch match = nav::matched(left, right, marker.family, marker.id, marker.size_m,
                                               *geometry, std::nullopt);
      if (!match.both()) {
        continue;
      }
      const auto pose =
          geometry->pose({match.left->corners_px, match.right->corners_px}, marker.size_m);
      if (pose) {
        claims.tools[i] = {true, pose->rig_from_marker, {}, false};
      }
    }
  };
}

std::vector<Method> tracking_methods() {
  std::vector<Method> methods{
      {"`best`", [](const Sequence& s) { return tracker(s, nav::create_photometric_tracker); }},
      {"`paper`",
       [](const Sequence& s) { return tracker(s, nav::published::create_corner_tracker); }},
      {"AprilTag, decimate 1", [](const Sequence& s) { return apriltag(s, 1.0); }},
      {"AprilTag, decimate 2", [](const Sequence& s) { return apriltag(s, 2.0); }}};
  for (const NamedDetect& aruco : aruco_detectors("tag36h11")) {
    methods.push_back({aruco.name, [detect = aruco.detect](const Sequence& s) {
                         return tracked_by_corners(s, detect);
                       }});
  }
  return methods;
}

}  // namespace orthonav::bench
