#include "nav/tracking/photometric_tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nav/tracking/planar_pose.h"

namespace orthonav::nav {
namespace {

/// A prediction may be off by this many SDs plus this many pixels.
constexpr double kDoubtSd = 3.0;
constexpr double kFewestDoubtPx = 1.0;
/// After this many refused pairs in a row that agree with one another, the cameras were turned.
constexpr std::int64_t kBelievedPairs = 30;

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

PhotometricTracker::PhotometricTracker(const StereoCalibration& calibration,
                                       std::vector<ToolGeometry> tools,
                                       std::vector<ToolFollower> followers,
                                       const TrackerOptions& options,
                                       std::unique_ptr<PairDetector> near,
                                       std::unique_ptr<FullImageSearch> whole)
    : geometry_(calibration),
      solver_(calibration),
      tools_(std::move(tools)),
      options_(options),
      near_(std::move(near)),
      full_search_(std::move(whole)),
      calibration_(tools_.size()),
      other_calibration_(tools_.size()),
      fits_(tools_.size()) {
  equations_.reserve(tools_.size());
  waiting_.reserve(tools_.size());
  if (options.parallel && tools_.size() > 1) {
    beside_ = std::make_unique<Beside>(solver_);
  }
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    trails_.push_back({std::move(followers[i]), PoseFilter{}, {}, {}});
    states_.push_back({i, {}, {}, 0.0});
  }
}

std::span<const ToolState> PhotometricTracker::track(const StereoFrame& frame) {
  ++pairs_;
  full_search_->finish();
  seen_.add(full_search_->left());
  seen_.add(full_search_->right());
  if (std::exchange(map_epoch_, frame.map_epoch) != frame.map_epoch) {
    forget_map();
  }
  is_refused_ = is_accepted_ = false;
  if (follow_all(frame)) {
    find_lost(frame);
  }
  if (is_refused_) {
    ++agreement_.refused;
    ++agreement_.refused_in_a_row;
    last_refused_ = pairs_;
  } else if (is_accepted_ || pairs_ - last_refused_ > 2 * options_.full_search_interval) {
    // A tool that is out of sight says nothing any more.
    agreement_.refused_in_a_row = 0;
  }
  return states_;
}

bool PhotometricTracker::follow_all(const StereoFrame& frame) {
  equations_.clear();
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    states_[i] = {i, {}, {}, 0.0};
    states_[i].world_from_marker.time = frame.time;
  }
  fit_all(frame);
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    if (fits_[i] && fits_[i]->calibration) {
      equations_.push_back({i, *fits_[i]->calibration});
    }
  }
  // Together they show most.
  if (!calibration_.explains(equations_)) {
    refuse(equations_);
    for (std::size_t i = 0; i < tools_.size(); ++i) {
      predict(i, frame);
    }
    return false;
  }
  accept(equations_);
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    if (fits_[i]) {
      measure(i, frame, *fits_[i]);
    }
  }
  return true;
}

void PhotometricTracker::fit_all(const StereoFrame& frame) {
  waiting_.clear();
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    fits_[i].reset();
    if (frame.world_from_rig && trails_[i].filter.follows(frame.time, options_.coast)) {
      waiting_.push_back(i);
    }
  }
  taken_ = 0;
  frame_ = &frame;
  const bool shared = beside_ && waiting_.size() > 1;
  if (shared) {
    beside_->worker.start(&fit_beside, this);
  }
  fit_waiting(solver_, search_);
  if (shared) {
    beside_->worker.wait();
  }
}

void PhotometricTracker::fit_beside(void* self) {
  auto& tracker = *static_cast<PhotometricTracker*>(self);
  tracker.fit_waiting(tracker.beside_->solver, tracker.beside_->search);
}

void PhotometricTracker::fit_waiting(PhotometricSolver& solver, TagSearch& search) {
  for (std::size_t k = taken_++; k < waiting_.size(); k = taken_++) {
    fits_[waiting_[k]] = follow(waiting_[k], *frame_, solver, search);
  }
}

void PhotometricTracker::find_lost(const StereoFrame& frame) {
  calibrate();
  std::size_t tracked = 0;
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    tracked += is_measured(i) ? 1 : 0;
  }
  if (!frame.world_from_rig || tracked == tools_.size()) {
    return;
  }
  look_for_lost(frame, tracked > 0);
  bool missing = false;
  equations_.clear();
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    contradiction_.reset();
    if (is_measured(i) || find(i, frame)) {
      continue;
    }
    if (contradiction_) {
      equations_.push_back(*contradiction_);
    }
    missing = true;
    predict(i, frame);
  }
  if (!equations_.empty()) {
    refuse(equations_);
    // What was found in these pictures too hangs on them alone.
    for (std::size_t i = 0; i < tools_.size(); ++i) {
      if (is_measured(i) && !fits_[i]) {
        states_[i] = {i, {}, {}, 0.0};
        states_[i].world_from_marker.time = frame.time;
        trails_[i].filter.stop();
      }
    }
  }
  // While other tools are tracked, the whole image is searched in the background until the next
  // pair.
  if (missing && (tracked > 0 || any_recent(frame.time)) && is_turn()) {
    full_search_->start(frame);
  }
}

void PhotometricTracker::accept(std::span<const ToolEquations> pair) {
  if (pair.empty()) {
    return;
  }
  is_accepted_ = true;
  other_since_ = pairs_;
  other_calibration_ = calibration_;
  other_calibration_.restart();
}

/// Cameras that were knocked agree with themselves from then on; pictures of different moments do
/// so only as long as nothing moves, and then they are right.
void PhotometricTracker::refuse(std::span<const ToolEquations> pair) {
  is_refused_ = true;
  if (!other_calibration_.explains(pair)) {
    other_since_ = pairs_;
    other_calibration_ = calibration_;
    other_calibration_.restart();
  }
  for (const auto& [tool, equations] : pair) {
    other_calibration_.add(tool, equations);
  }
  if (pairs_ - other_since_ >= kBelievedPairs) {
    calibration_ = other_calibration_;
  }
}

std::optional<StereoAlignment> PhotometricTracker::alignment() const {
  return calibration_.alignment();
}

void PhotometricTracker::forget_map() {
  for (Trail& trail : trails_) {
    trail.filter.stop();
    trail.last_time.reset();
  }
}

void PhotometricTracker::calibrate() {
  if (calibration_.may_be_of_wrong_size() || !calibration_.correct()) {
    return;
  }
  solver_.rotate_right_camera(calibration_.rotation_rad());
  if (beside_) {
    beside_->solver.rotate_right_camera(calibration_.rotation_rad());
  }
  geometry_ = TagGeometry(solver_.calibration());
  for (std::size_t i = 0; i < trails_.size(); ++i) {
    trails_[i].follower.set_size_factor(calibration_.size_factor(i));
  }
}

bool PhotometricTracker::is_measured(std::size_t i) const {
  return states_[i].world_from_marker.status == PoseStatus::kMeasured;
}

bool PhotometricTracker::any_recent(Timestamp time) const {
  return std::any_of(trails_.begin(), trails_.end(), [&](const Trail& trail) {
    return trail.last_time && time > *trail.last_time && time - *trail.last_time <= options_.coast;
  });
}

std::optional<ToolFit> PhotometricTracker::follow(std::size_t i, const StereoFrame& frame,
                                                  PhotometricSolver& solver, TagSearch& search) {
  Trail& trail = trails_[i];
  const TrackedPose ahead = trail.filter.predicted(frame.time);
  const Transform<Rig, Marker> expected = frame.world_from_rig->inverse() * ahead.value;
  const double variance =
      std::max({ahead.covariance[0], ahead.covariance[7], ahead.covariance[14]});
  return trail.follower.follow(frame, expected, kDoubtSd * std::sqrt(variance) + pixel_m(expected),
                               solver, search);
}

double PhotometricTracker::pixel_m(const Transform<Rig, Marker>& pose) const {
  return kFewestDoubtPx * pose.translation().norm() / solver_.focal_px(false);
}

bool PhotometricTracker::take(std::size_t i, const StereoFrame& frame,
                              const Transform<Rig, Marker>& expected, double doubt_m,
                              bool by_both) {
  const auto fit = trails_[i].follower.follow(frame, expected, doubt_m, solver_, search_);
  if (!fit || (by_both && !(fit->left && fit->right))) {
    return false;
  }
  if (fit->calibration) {
    const ToolEquations own{i, *fit->calibration};
    if (!calibration_.explains({&own, 1})) {
      contradiction_ = own;
      return false;
    }
    accept({&own, 1});
  }
  measure(i, frame, *fit);
  return true;
}

void PhotometricTracker::measure(std::size_t i, const StereoFrame& frame, const ToolFit& fit) {
  Trail& trail = trails_[i];
  if (fit.calibration && fit.left && fit.right) {
    calibration_.add(i, *fit.calibration);
  }
  TrackedPose measured{*frame.world_from_rig * fit.rig_from_marker, frame.time,
                       PoseStatus::kMeasured,
                       rotated(fit.covariance_in_rig, frame.world_from_rig->rotation())};
  trail.filter.update(measured, trail.follower.exposure_s());
  ToolState& state = states_[i];
  state.world_from_marker = trail.filter.state();
  state.rig_from_marker = frame.world_from_rig->inverse() * state.world_from_marker.value;
  add_head(state, frame);
  state.cameras = (fit.left ? 1 : 0) + (fit.right ? 1 : 0);
  state.pair = PairPose{fit.rig_from_marker, fit.covariance_in_rig, trail.follower.exposure_s()};
  trail.last_seen = state.world_from_marker.value;
  trail.last_time = frame.time;
}

void PhotometricTracker::predict(std::size_t i, const StereoFrame& frame) {
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
  add_head(state, frame);
}

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
  // The search of the whole image only finds where to look more closely.
  detection.decimate = std::max(detection.decimate, 2.0);
  Result<std::unique_ptr<FullImageSearch>> whole =
      FullImageSearch::create(detection, options.parallel);
  if (!whole) {
    return whole.error();
  }
  std::unique_ptr<ToolTracker> tracker = std::make_unique<PhotometricTracker>(
      calibration, std::move(tools), std::move(followers), options, std::move(near).value(),
      std::move(whole).value());
  return tracker;
}

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
    calibration_.add_size(i, *ratio - 1.0, kCornersSizeSd);
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
