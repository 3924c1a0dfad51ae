#include <algorithm>

#include "nav/tracking/photometric_tracker.h"
#include "nav/tracking/planar_pose.h"

// Where to look for a lost tool, and its pose once its tags are found again.
namespace orthonav::nav {
namespace {

/// How long a lost tool is looked for around its last place.
constexpr Duration kRemembered = std::chrono::seconds(3);
/// Margin around a tag within which it is looked for: a fraction of its extent, and pixels.
constexpr BoxRoom kRoom{0.5, 30.0};
/// Detected corners are accurate to a small fraction of a cell; a pose from them is less accurate.
constexpr double kDetectedDoubtPx = 1.0;
/// One camera's corners determine depth badly, and an error in depth moves the tag in the other
/// image.
constexpr double kOneCameraDoubtPx = 6.0;
/// Relative SD of a tag's size from its corners, which blur pushes outward.
constexpr double kCornersSizeSd = 0.03;

}  // namespace

void PhotometricTracker::look_for_lost(const StereoFrame& frame, bool others_tracked) {
  SearchPlan& left = near_->left_plan();
  SearchPlan& right = near_->right_plan();
  left.boxes.clear();
  right.boxes.clear();
  // While a tool is tracked, a search of the whole image would delay it; with none tracked and no
  // place to look, it is done at once.
  left.everywhere = right.everywhere = !others_tracked && !any_recent(frame.time) && is_turn();
  if (!left.everywhere) {
    for (std::size_t i = 0; i < tools_.size(); ++i) {
      if (!is_measured(i)) {
        add_boxes(i, frame);
      }
    }
  }
  near_->detect(frame);
  seen_.add(near_->left());
  seen_.add(near_->right());
}

void PhotometricTracker::add_boxes(std::size_t i, const StereoFrame& frame) {
  add_boxes(i, tools_[i].marker, {}, frame);
  for (const AttachedMarker& more : tools_[i].more_markers) {
    add_boxes(i, more.definition, more.marker_from_tag, frame);
  }
}

void PhotometricTracker::add_boxes(std::size_t i, const MarkerDefinition& marker,
                                   const Transform<Marker, Tag>& marker_from_tag,
                                   const StereoFrame& frame) {
  const auto from_whole = [&](std::span<const MarkerCorners> found, SearchPlan& plan) {
    for (const MarkerCorners& seen : found) {
      if (seen.family == marker.family && seen.id == marker.id) {
        plan.add(seen.corners_px, kRoom, marker.family, marker.id);
      }
    }
  };
  from_whole(full_search_->left(), near_->left_plan());
  from_whole(full_search_->right(), near_->right_plan());
  const Trail& trail = trails_[i];
  if (!trail.last_time || frame.time - *trail.last_time > kRemembered) {
    return;
  }
  const auto rig_from_tag = frame.world_from_rig->inverse() * trail.last_seen * marker_from_tag;
  const auto expect = [&](const CameraModel& camera, const auto& camera_from_rig,
                          SearchPlan& plan) {
    if (const auto corners = corners_seen(camera, camera_from_rig * rig_from_tag, marker.size_m)) {
      plan.add(*corners, kRoom, marker.family, marker.id);
    }
  };
  const StereoCalibration& c = solver_.calibration();
  expect(c.left, c.left_from_rig, near_->left_plan());
  expect(c.right, c.right_from_rig, near_->right_plan());
}

bool PhotometricTracker::find(std::size_t i, const StereoFrame& frame) {
  if (find(i, tools_[i].marker, {}, frame)) {
    return true;
  }
  for (const AttachedMarker& more : tools_[i].more_markers) {
    if (find(i, more.definition, more.marker_from_tag.inverse(), frame)) {
      return true;
    }
  }
  return false;
}

bool PhotometricTracker::find(std::size_t i, const MarkerDefinition& marker,
                              const Transform<Tag, Marker>& tag_from_marker,
                              const StereoFrame& frame) {
  const TagMatch match = matched(near_->left(), near_->right(), marker.family, marker.id,
                                 marker.size_m, geometry_, std::nullopt);
  if (!match.both() && find_by_one(i, marker, tag_from_marker, match, frame)) {
    return true;
  }
  if (match.both() && find_by_both(i, marker, tag_from_marker, match, frame)) {
    return true;
  }
  if (const auto ratio = size_ratio(near_->left(), near_->right(), marker.family, marker.id,
                                    marker.size_m, geometry_)) {
    trails_[i].size.add({*ratio - 1.0, kCornersSizeSd});
  }
  return false;
}

bool PhotometricTracker::find_by_both(std::size_t i, const MarkerDefinition& marker,
                                      const Transform<Tag, Marker>& tag_from_marker,
                                      const TagMatch& match, const StereoFrame& frame) {
  const auto pose =
      geometry_.pose({match.left->corners_px, match.right->corners_px}, marker.size_m);
  if (!pose) {
    return false;
  }
  // The geometry calls every tag's frame Marker.
  const Transform<Rig, Tag> rig_from_tag(pose->rig_from_marker.rotation(),
                                         pose->rig_from_marker.translation());
  const Transform<Rig, Marker> start = rig_from_tag * tag_from_marker;
  const double doubt_m = kDetectedDoubtPx * pixel_m(pose->rig_from_marker);
  if (take(i, frame, start, doubt_m)) {
    return true;
  }
  // A lamp or the exposure may have changed since the light on this tool was estimated.
  trails_[i].follower.forget();
  return take(i, frame, start, doubt_m);
}

bool PhotometricTracker::find_by_one(std::size_t i, const MarkerDefinition& marker,
                                     const Transform<Tag, Marker>& tag_from_marker,
                                     const TagMatch& match, const StereoFrame& frame) {
  if (!match.left && !match.right) {
    return false;
  }
  const auto poses = poses_by_one(solver_.calibration(), match.left ? *match.left : *match.right,
                                  match.left == nullptr, marker.size_m);
  if (!poses) {
    return false;
  }
  for (const Transform<Rig, Tag>& rig_from_tag : *poses) {
    const Transform<Rig, Marker> start = rig_from_tag * tag_from_marker;
    if (take(i, frame, start, kOneCameraDoubtPx * pixel_m(start), true)) {
      return true;
    }
  }
  return false;
}

}  // namespace orthonav::nav
