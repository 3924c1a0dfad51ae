#include <algorithm>
#include <cmath>
#include <utility>

#include "nav/tracking/full_image_search.h"
#include "nav/tracking/pair_detector.h"
#include "nav/tracking/planar_pose.h"
#include "nav/tracking/tag_matching.h"
#include "nav/tracking/tool_follower.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::nav {
namespace {

/// A lost tool is looked for around its last place for so long.
constexpr Duration kRemembered = std::chrono::seconds(3);
/// Room around a tag where it is looked for: by its extent, and in pixels.
constexpr BoxRoom kRoom{0.5, 30.0};
/// Corners that were just detected are right to a small part of a cell; their pose is less so.
constexpr double kDetectedDoubtPx = 1.0;
constexpr double kFewestDoubtPx = 1.0;
/// One camera's corners tell the depth badly, which is a shift in the other image.
constexpr double kOneCameraDoubtPx = 6.0;
constexpr double kDoubtSd = 3.0;
/// SD of a tag's size by its corners, which blur pushes outward.
constexpr double kCornersSizeSd = 0.03;

class BestTracker final : public ToolTracker {
 public:
  BestTracker(const StereoCalibration& calibration, std::vector<ToolGeometry> tools,
              std::vector<ToolFollower> followers, const TrackerOptions& options,
              std::unique_ptr<PairDetector> near, std::unique_ptr<FullImageSearch> whole)
      : geometry_(calibration),
        solver_(calibration),
        tools_(std::move(tools)),
        options_(options),
        near_(std::move(near)),
        full_search_(std::move(whole)) {
    for (std::size_t i = 0; i < tools_.size(); ++i) {
      trails_.push_back({std::move(followers[i]), PoseFilter{}, {}, {}, {}});
      states_.push_back({i, {}, {}, 0.0});
    }
  }

  std::span<const ToolState> track(const StereoFrame& frame) override {
    ++pairs_;
    full_search_->finish();
    if (std::exchange(map_epoch_, frame.map_epoch) != frame.map_epoch) {
      forget_map();
    }
    std::size_t tracked = 0;
    for (std::size_t i = 0; i < tools_.size(); ++i) {
      states_[i] = {i, {}, {}, 0.0};
      states_[i].world_from_marker.time = frame.time;
      if (frame.world_from_rig && follow(i, frame)) {
        ++tracked;
      }
    }
    align();
    if (!frame.world_from_rig || tracked == tools_.size()) {
      return states_;
    }
    look_for_lost(frame, tracked > 0);
    bool missing = false;
    for (std::size_t i = 0; i < tools_.size(); ++i) {
      if (is_measured(i) || find(i, frame)) {
        continue;
      }
      missing = true;
      predict(i, frame);
    }
    // Beside tools that are tracked, the whole image is searched while the next pair is awaited.
    if (missing && (tracked > 0 || any_recent(frame.time)) && is_turn()) {
      full_search_->start(frame);
    }
    return states_;
  }

  [[nodiscard]] std::span<const ToolGeometry> tools() const override { return tools_; }
  [[nodiscard]] std::optional<StereoAlignment> alignment() const override {
    return applied_ ? applied_ : aligning_.estimate();
  }
  [[nodiscard]] std::optional<TagSize> tag_size(std::size_t tool) const override {
    return trails_.at(tool).size.estimate();
  }

 private:
  struct Trail {
    ToolFollower follower;
    PoseFilter filter;
    Transform<World, Marker> last_seen;
    std::optional<Timestamp> last_time;
    TagSizeEstimator size;
  };

  /// Where the tools were in another map says nothing about where they are in this one.
  void forget_map() {
    for (Trail& trail : trails_) {
      trail.filter.stop();
      trail.last_time.reset();
    }
  }

  /// Poses follow the cameras as they are, once it is certain that they are not as reported.
  void align() {
    const auto found = aligning_.estimate();
    if (!found || !found->significant || !found->within_bounds || may_be_of_wrong_size()) {
      return;
    }
    solver_.turn_right_camera(found->rotation_rad);
    geometry_ = TagGeometry(solver_.calibration());
    const Vec3 before = applied_ ? applied_->rotation_rad : Vec3{};
    applied_ = *found;
    applied_->rotation_rad = before + found->rotation_rad;
    applied_->applied = true;
    aligning_.restart();
    for (Trail& trail : trails_) {
      trail.size.restart();
    }
  }

  /// A wrong print looks like cameras that are turned towards each other.
  [[nodiscard]] bool may_be_of_wrong_size() const {
    return std::any_of(trails_.begin(), trails_.end(), [](const Trail& trail) {
      const auto size = trail.size.estimate();
      return size && size->notable;
    });
  }

  [[nodiscard]] bool is_measured(std::size_t i) const {
    return states_[i].world_from_marker.status == PoseStatus::kMeasured;
  }
  [[nodiscard]] bool is_turn() const { return pairs_ % options_.full_search_interval == 0; }

  [[nodiscard]] bool any_recent(Timestamp time) const {
    return std::any_of(trails_.begin(), trails_.end(), [&](const Trail& trail) {
      return trail.last_time && time > *trail.last_time &&
             time - *trail.last_time <= options_.coast;
    });
  }

  bool follow(std::size_t i, const StereoFrame& frame) {
    Trail& trail = trails_[i];
    if (!trail.filter.alive() || frame.time <= trail.filter.time() ||
        frame.time - trail.filter.time() > options_.coast) {
      return false;
    }
    const TrackedPose ahead = trail.filter.predicted(frame.time);
    const Transform<Rig, Marker> expected = frame.world_from_rig->inverse() * ahead.value;
    const double variance =
        std::max({ahead.covariance[0], ahead.covariance[7], ahead.covariance[14]});
    return take(i, frame, expected, kDoubtSd * std::sqrt(variance) + pixel_m(expected));
  }

  /// What the pixels of doubt cover at the tool's distance.
  [[nodiscard]] double pixel_m(const Transform<Rig, Marker>& pose) const {
    return kFewestDoubtPx * pose.translation().norm() / solver_.focal_px(false);
  }

  /// `by_both`: a tool is only believed when both cameras agree on it.
  bool take(std::size_t i, const StereoFrame& frame, const Transform<Rig, Marker>& expected,
            double doubt_m, bool by_both = false) {
    Trail& trail = trails_[i];
    const auto fit = trail.follower.follow(frame, expected, doubt_m, solver_, search_);
    if (!fit || (by_both && !(fit->left && fit->right))) {
      return false;
    }
    if (fit->alignment) {
      aligning_.add(*fit->alignment);
    }
    if (fit->left && fit->right && trail.size.is_due()) {
      if (const auto size = trail.follower.measured_size(frame, fit->rig_from_marker, solver_)) {
        trail.size.add(*size);
      }
    }
    TrackedPose measured{*frame.world_from_rig * fit->rig_from_marker, frame.time,
                         PoseStatus::kMeasured,
                         turned(fit->covariance_in_rig, frame.world_from_rig->rotation())};
    trail.filter.update(measured, trail.follower.exposure_s());
    ToolState& state = states_[i];
    state.world_from_marker = trail.filter.state();
    state.rig_from_marker = frame.world_from_rig->inverse() * state.world_from_marker.value;
    state.cameras = (fit->left ? 1 : 0) + (fit->right ? 1 : 0);
    trail.last_seen = state.world_from_marker.value;
    trail.last_time = frame.time;
    return true;
  }

  void look_for_lost(const StereoFrame& frame, bool others_tracked) {
    SearchPlan& left = near_->left_plan();
    SearchPlan& right = near_->right_plan();
    left.boxes.clear();
    right.boxes.clear();
    // With nothing to delay, and no idea where to look, at once.
    left.everywhere = right.everywhere = !others_tracked && !any_recent(frame.time) && is_turn();
    if (!left.everywhere) {
      for (std::size_t i = 0; i < tools_.size(); ++i) {
        if (!is_measured(i)) {
          add_boxes(i, frame);
        }
      }
    }
    near_->detect(frame);
  }

  void add_boxes(std::size_t i, const StereoFrame& frame) {
    add_boxes(i, tools_[i].marker, {}, frame);
    for (const AttachedMarker& more : tools_[i].more_markers) {
      add_boxes(i, more.definition, more.marker_from_tag, frame);
    }
  }

  void add_boxes(std::size_t i, const MarkerDefinition& marker,
                 const Transform<Marker, Tag>& marker_from_tag, const StereoFrame& frame) {
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
      if (const auto corners =
              corners_seen(camera, camera_from_rig * rig_from_tag, marker.size_m)) {
        plan.add(*corners, kRoom, marker.family, marker.id);
      }
    };
    const StereoCalibration& c = solver_.calibration();
    expect(c.left, c.left_from_rig, near_->left_plan());
    expect(c.right, c.right_from_rig, near_->right_plan());
  }

  bool find(std::size_t i, const StereoFrame& frame) {
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

  bool find(std::size_t i, const MarkerDefinition& marker,
            const Transform<Tag, Marker>& tag_from_marker, const StereoFrame& frame) {
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

  bool find_by_both(std::size_t i, const MarkerDefinition& marker,
                    const Transform<Tag, Marker>& tag_from_marker, const TagMatch& match,
                    const StereoFrame& frame) {
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
    // A lamp or the exposure may have changed since the light was learnt.
    trails_[i].follower.forget();
    return take(i, frame, start, doubt_m);
  }

  /// Its corners were found in one image only; the other one may still show enough of the tag to
  /// tell which of the two poses it has.
  bool find_by_one(std::size_t i, const MarkerDefinition& marker,
                   const Transform<Tag, Marker>& tag_from_marker, const TagMatch& match,
                   const StereoFrame& frame) {
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

  void predict(std::size_t i, const StereoFrame& frame) {
    Trail& trail = trails_[i];
    if (!trail.filter.alive() || frame.time <= trail.filter.time()) {
      return;
    }
    if (frame.time - trail.filter.time() > options_.coast) {
      return trail.filter.stop();
    }
    ToolState& state = states_[i];
    state.world_from_marker = trail.filter.predicted(frame.time);
    state.rig_from_marker = frame.world_from_rig->inverse() * state.world_from_marker.value;
  }

  TagGeometry geometry_;
  PhotometricSolver solver_;
  TagSearch search_;
  std::vector<ToolGeometry> tools_;
  TrackerOptions options_;
  std::unique_ptr<PairDetector> near_;
  std::unique_ptr<FullImageSearch> full_search_;
  std::vector<Trail> trails_;
  std::vector<ToolState> states_;
  AlignmentEstimator aligning_;
  std::optional<StereoAlignment> applied_;
  std::int64_t pairs_ = -1;
  std::int64_t map_epoch_ = 0;
};

}  // namespace

Result<std::unique_ptr<ToolTracker>> create_photometric_tracker(
    const StereoCalibration& calibration, std::vector<ToolGeometry> tools,
    const TrackerOptions& options) {
  if (Status status = check(calibration, tools, options); !status) {
    return status.error();
  }
  std::vector<ToolFollower> followers;
  DetectorOptions detection;
  detection.decimate = options.decimate;
  detection.families = families_of(tools);
  for (const ToolGeometry& tool : tools) {
    Result<ToolFollower> follower = ToolFollower::create(tool);
    if (!follower) {
      return follower.error();
    }
    followers.push_back(std::move(follower).value());
  }
  Result<std::unique_ptr<PairDetector>> near = PairDetector::create(detection, options.parallel);
  if (!near) {
    return near.error();
  }
  // The whole image only says where to look closer.
  detection.decimate = std::max(detection.decimate, 2.0);
  Result<std::unique_ptr<FullImageSearch>> whole =
      FullImageSearch::create(detection, options.parallel);
  if (!whole) {
    return whole.error();
  }
  std::unique_ptr<ToolTracker> tracker =
      std::make_unique<BestTracker>(calibration, std::move(tools), std::move(followers), options,
                                    std::move(near).value(), std::move(whole).value());
  return tracker;
}

}  // namespace orthonav::nav
