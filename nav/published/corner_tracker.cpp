#include "nav/published/corner_tracker.h"

#include <cmath>
#include <utility>

#include "nav/published/corner_filter.h"
#include "nav/tracking/tag_pose.h"

namespace orthonav::nav::published {
namespace {

// A box around a prediction: margin for the quiet zone and for rotation, for the filter's
// uncertainty, and for the odd pixel.
constexpr double kBoxOfExtent = 0.35;
constexpr double kBoxOfSd = 4.0;
constexpr double kBoxPx = 6.0;

class PaperTracker final : public ToolTracker {
 public:
  PaperTracker(const StereoCalibration& calibration, std::vector<ToolGeometry> tools,
               const TrackerOptions& options, std::unique_ptr<TagFinder> detector)
      : geometry_(calibration),
        tools_(std::move(tools)),
        options_(options),
        detector_(std::move(detector)) {
    for (std::size_t i = 0; i < tools_.size(); ++i) {
      trails_.push_back({});
      states_.push_back({i, {}, {}, 0.0});
    }
  }

  std::span<const ToolState> track(const StereoFrame& frame) override {
    if (std::exchange(map_epoch_, frame.map_epoch) != frame.map_epoch) {
      forget_map();
    }
    plan(frame.time);
    detector_->detect(frame);
    seen_.add(detector_->left());
    seen_.add(detector_->right());
    ++pairs_;
    missing_ = false;
    for (std::size_t i = 0; i < tools_.size(); ++i) {
      states_[i] = {i, {}, {}, 0.0};
      if (!measure(i, frame)) {
        predict(i, frame);
      }
      missing_ = missing_ || states_[i].world_from_marker.status != PoseStatus::kMeasured;
    }
    return states_;
  }

  [[nodiscard]] std::span<const ToolGeometry> tools() const override { return tools_; }
  [[nodiscard]] const SeenTags* seen_tags() const override { return &seen_; }

 private:
  struct Trail {
    CornerFilter left;
    CornerFilter right;
    TrackedPose older;
    TrackedPose newer;
  };

  /// Poses in another map are useless for prediction; corners belong to the images and are kept.
  void forget_map() {
    for (Trail& trail : trails_) {
      trail.older = trail.newer = {};
    }
  }

  [[nodiscard]] bool is_recent(const CornerFilter& filter, Timestamp time) const {
    return filter.alive() && time > filter.time() && time - filter.time() <= options_.coast;
  }

  // After a gap in the stream, tools may have moved anywhere.
  [[nodiscard]] bool follows_a_gap(Timestamp time) const {
    for (std::size_t i = 0; i < tools_.size(); ++i) {
      if (states_[i].world_from_marker.status == PoseStatus::kMeasured &&
          !(is_recent(trails_[i].left, time) && is_recent(trails_[i].right, time))) {
        return true;
      }
    }
    return false;
  }

  void plan(Timestamp time) {
    const int every = options_.full_search_interval;
    const bool everywhere = every == 1 || (missing_ && pairs_ % every == 0) || follows_a_gap(time);
    SearchPlan& left = detector_->left_plan();
    SearchPlan& right = detector_->right_plan();
    left.everywhere = right.everywhere = everywhere;
    left.boxes.clear();
    right.boxes.clear();
    for (std::size_t i = 0; i < tools_.size() && !everywhere; ++i) {
      add_box(trails_[i].left, tools_[i], time, left);
      add_box(trails_[i].right, tools_[i], time, right);
    }
  }

  void add_box(const CornerFilter& filter, const ToolGeometry& tool, Timestamp time,
               SearchPlan& plan) const {
    if (!is_recent(filter, time)) {
      return;
    }
    const CornerFilter::Prediction ahead = filter.predicted(time);
    plan.add(ahead.corners_px, {kBoxOfExtent, kBoxOfSd * ahead.sd_px + kBoxPx}, tool.marker.family,
             tool.marker.id);
  }

  [[nodiscard]] std::optional<TagPair> expected(const Trail& trail, Timestamp time) const {
    if (!is_recent(trail.left, time) || !is_recent(trail.right, time)) {
      return std::nullopt;
    }
    return TagPair{trail.left.predicted(time).corners_px, trail.right.predicted(time).corners_px};
  }

  static void follow(CornerFilter& filter, const MarkerCorners* seen, Timestamp time,
                     Duration coast) {
    if (filter.alive() && time - filter.time() > coast) {
      filter.stop();
    }
    if (seen) {
      filter.update(seen->corners_px, time);
    }
  }

  bool measure(std::size_t i, const StereoFrame& frame) {
    Trail& trail = trails_[i];
    const MarkerDefinition& marker = tools_[i].marker;
    const TagMatch match = matched(detector_->left(), detector_->right(), marker.family, marker.id,
                                   marker.size_m, geometry_, expected(trail, frame.time));
    follow(trail.left, match.left, frame.time, options_.coast);
    follow(trail.right, match.right, frame.time, options_.coast);
    if (!match.both() || !frame.world_from_rig) {
      return false;
    }

    const TagPair filtered{trail.left.corners_px(), trail.right.corners_px()};
    const TagPair seen{match.left->corners_px, match.right->corners_px};
    const std::optional<TagPose> pose = geometry_.pose(filtered, marker.size_m);
    if (!pose) {
      return false;
    }
    const auto residual_px = geometry_.residual_px(pose->rig_from_marker, seen, marker.size_m);
    const auto covariance =
        geometry_.covariance(pose->rig_from_marker, filtered, marker.size_m,
                             trail.left.variance_px2(), trail.right.variance_px2());
    if (!residual_px || !covariance) {
      return false;
    }
    states_[i].rig_from_marker = pose->rig_from_marker;
    states_[i].residual_px = *residual_px;
    states_[i].cameras = 2;
    states_[i].world_from_marker = {*frame.world_from_rig * pose->rig_from_marker, frame.time,
                                    PoseStatus::kMeasured,
                                    rotated(*covariance, frame.world_from_rig->rotation())};
    add_head(states_[i], frame);
    trail.older = trail.newer;
    trail.newer = states_[i].world_from_marker;
    return true;
  }

  void predict(std::size_t i, const StereoFrame& frame) {
    ToolState& state = states_[i];
    state.world_from_marker.time = frame.time;
    if (!frame.world_from_rig) {
      return;
    }
    // There is nothing to predict at the time of the newest measurement, which comes from another
    // pair.
    if (frame.time <= trails_[i].newer.time) {
      return;
    }
    state.world_from_marker =
        predicted(trails_[i].older, trails_[i].newer, frame.time, options_.coast);
    if (state.world_from_marker.status == PoseStatus::kLost) {
      return;
    }
    state.rig_from_marker = frame.world_from_rig->inverse() * state.world_from_marker.value;
  }

  TagGeometry geometry_;
  std::vector<ToolGeometry> tools_;
  TrackerOptions options_;
  std::unique_ptr<TagFinder> detector_;
  SeenTags seen_;
  std::vector<Trail> trails_;
  std::vector<ToolState> states_;
  std::int64_t pairs_ = 0;
  std::int64_t map_epoch_ = 0;
  bool missing_ = true;
};

}  // namespace

Result<std::unique_ptr<ToolTracker>> create_corner_tracker(const StereoCalibration& calibration,
                                                           std::vector<ToolGeometry> tools,
                                                           const TrackerOptions& options) {
  if (Status status = check(calibration, tools, options); !status) {
    return status.error();
  }
  DetectorOptions detection;
  detection.decimate = options.decimate;
  // Each tool by its first marker only, as published.
  std::vector<MarkerDefinition> markers;
  for (const ToolGeometry& tool : tools) {
    markers.push_back(tool.marker);
  }
  detection.families = families_of(markers);
  Result<std::unique_ptr<PairDetector>> detector =
      PairDetector::create(detection, options.parallel);
  if (!detector) {
    return detector.error();
  }
  return create_tracker_of_corners(calibration, std::move(tools), options, std::move(*detector));
}

Result<std::unique_ptr<ToolTracker>> create_tracker_of_corners(const StereoCalibration& calibration,
                                                               std::vector<ToolGeometry> tools,
                                                               const TrackerOptions& options,
                                                               std::unique_ptr<TagFinder> finder) {
  if (Status status = check(calibration, tools, options); !status) {
    return status.error();
  }
  std::unique_ptr<ToolTracker> tracker =
      std::make_unique<PaperTracker>(calibration, std::move(tools), options, std::move(finder));
  return tracker;
}

}  // namespace orthonav::nav::published
