#include "nav/tracking/tool_tracker.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "base/check.h"
#include "base/joined.h"
#include "nav/tracking/marker_detector.h"
#include "nav/tracking/pose_filter.h"
#include "nav/tracking/tag_pose.h"
#include "nav/tracking/tool_follower.h"
#include "nav/tracking/worker.h"

namespace orthonav::nav {

Status check(const StereoCalibration& calibration, const std::vector<ToolGeometry>& tools,
             const TrackerOptions& options) {
  if (const auto problems = problems_of(tools); !problems.empty()) {
    return Error{"tools: " + joined(problems)};
  }
  for (const ToolGeometry& tool : tools) {
    if (!tool.has_tag()) {
      return Error{"tools: tool '" + tool.name +
                   "' has no tag, and cameras find a tool by its tag alone"};
    }
  }
  if (calibration.left.width_px() <= 0 || calibration.right.width_px() <= 0) {
    return Error{"tracker: the stereo calibration has no camera model"};
  }
  if (options.full_search_interval < 1) {
    return Error{"tracker: full_search_interval " + std::to_string(options.full_search_interval) +
                 ", must be at least 1"};
  }
  if (options.coast < Duration::zero()) {
    return Error{"tracker: coast is negative"};
  }
  return {};
}

std::span<const ToolState> ToolTracker::take(const ToolPoses& /*poses*/) {
  ORTHONAV_CHECK(false);  // it tracks through pairs
  return {};
}

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

/// Calls `visit` with each tag of a tool and its pose on it, until it returns true: whether it did.
template <class Visit>
bool any_tag(const ToolGeometry& tool, Visit visit) {
  return visit(tool.marker, Transform<Marker, Tag>{}) ||
         std::any_of(tool.more_markers.begin(), tool.more_markers.end(),
                     [&](const AttachedMarker& more) {
                       return visit(more.definition, more.marker_from_tag);
                     });
}

/// Searches a whole pair of images for tags while the next pair is awaited. It starts at the end of
/// one pair's tracking and delivers its results at the beginning of the next, so the results do not
/// depend on the number of threads.
class FullImageSearch {
 public:
  FullImageSearch(std::unique_ptr<PairDetector> detector, bool parallel)
      : detector_(std::move(detector)) {
    detector_->left_plan().everywhere = detector_->right_plan().everywhere = true;
    if (parallel) {
      worker_.emplace();
    }
  }

  /// Copies the images and starts; with one thread, searches at once.
  void start(const StereoFrame& frame) {
    frame_.left = frame.left;
    frame_.right = frame.right;
    begun_ = true;
    if (worker_) {
      worker_->start(&run, this);
    } else {
      run(this);
    }
  }
  /// Waits for the search, if one was started; its results stay until the next call. Without a
  /// search they are empty.
  void finish() {
    if (begun_ && worker_) {
      worker_->wait();
    }
    found_ = begun_;
    begun_ = false;
  }
  [[nodiscard]] std::span<const MarkerCorners> left() const {
    return found_ ? detector_->left() : std::span<const MarkerCorners>{};
  }
  [[nodiscard]] std::span<const MarkerCorners> right() const {
    return found_ ? detector_->right() : std::span<const MarkerCorners>{};
  }

 private:
  static void run(void* self) {
    auto& search = *static_cast<FullImageSearch*>(self);
    search.detector_->detect(search.frame_);
  }

  std::unique_ptr<PairDetector> detector_;
  StereoFrame frame_;
  bool begun_ = false;
  bool found_ = false;
  std::optional<Worker> worker_;
};

/// What `create_photometric_tracker` makes. A recently seen tool is followed in the pixels of both
/// images. A lost one is searched for where it was last seen, and in the whole image while the next
/// pair is awaited.
class PhotometricTracker final : public ToolTracker {
 public:
  PhotometricTracker(const StereoCalibration& calibration, std::vector<ToolGeometry> tools,
                     std::vector<ToolFollower> followers, const TrackerOptions& options,
                     std::unique_ptr<PairDetector> near, std::unique_ptr<PairDetector> whole)
      : geometry_(calibration),
        solver_(calibration),
        tools_(std::move(tools)),
        options_(options),
        near_(std::move(near)),
        full_search_(std::move(whole), options.parallel),
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

  std::span<const ToolState> track(const StereoFrame& frame) override {
    ++pairs_;
    full_search_.finish();
    seen_.add(full_search_.left());
    seen_.add(full_search_.right());
    if (std::exchange(map_epoch_, frame.map_epoch) != frame.map_epoch) {
      // Positions in another map mean nothing in this one.
      for (Trail& trail : trails_) {
        trail.filter.stop();
        trail.last_time.reset();
      }
    }
    is_refused_ = is_accepted_ = false;
    if (follow_all(frame)) {
      correct_calibration();
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

  [[nodiscard]] std::span<const ToolGeometry> tools() const override { return tools_; }
  [[nodiscard]] const SeenTags* seen_tags() const override { return &seen_; }
  [[nodiscard]] std::optional<StereoAlignment> alignment() const override {
    return calibration_.alignment();
  }
  [[nodiscard]] std::optional<TagSize> tag_size(std::size_t tool) const override {
    return calibration_.tag_size(tool);
  }
  [[nodiscard]] PictureAgreement picture_agreement() const override { return agreement_; }
  [[nodiscard]] double tag_size_difference_sd(std::size_t tool, std::size_t other) const override {
    return calibration_.size_difference_sd(tool, other);
  }

 private:
  struct Trail {
    ToolFollower follower;
    PoseFilter filter;
    Transform<World, Marker> last_seen;
    std::optional<Timestamp> last_time;
  };
  /// A second thread, and what it fits with. A fit depends on its tool alone, so that the poses are
  /// the same with it and without.
  struct Beside {
    explicit Beside(const PhotometricSolver& like) : solver(like) {}
    PhotometricSolver solver;
    TagSearch search;
    Worker worker;
  };

  /// Measures the tools that were seen recently. False: the pair was refused.
  bool follow_all(const StereoFrame& frame) {
    waiting_.clear();
    for (std::size_t i = 0; i < tools_.size(); ++i) {
      lose(i, frame);
      fits_[i].reset();
      if (frame.world_from_rig && trails_[i].filter.follows(frame.time, options_.coast)) {
        waiting_.push_back(i);
      }
    }
    // On two threads, if there are two such tools.
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
    equations_.clear();
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

  static void fit_beside(void* self) {
    auto& tracker = *static_cast<PhotometricTracker*>(self);
    tracker.fit_waiting(tracker.beside_->solver, tracker.beside_->search);
  }

  void fit_waiting(PhotometricSolver& solver, TagSearch& search) {
    for (std::size_t k = taken_++; k < waiting_.size(); k = taken_++) {
      const std::size_t i = waiting_[k];
      const TrackedPose ahead = trails_[i].filter.predicted(frame_->time);
      const Transform<Rig, Marker> expected = frame_->world_from_rig->inverse() * ahead.value;
      const double variance =
          std::max({ahead.covariance[0], ahead.covariance[7], ahead.covariance[14]});
      fits_[i] = trails_[i].follower.follow(
          *frame_, expected, kDoubtSd * std::sqrt(variance) + pixel_m(expected), solver, search);
    }
  }

  /// For fits by both cameras that can be of one moment.
  void accept(std::span<const ToolEquations> pair) {
    if (pair.empty()) {
      return;
    }
    is_accepted_ = true;
    other_since_ = pairs_;
    other_calibration_ = calibration_;
    other_calibration_.restart();
  }

  /// For those that can't. Cameras that were knocked agree with themselves from then on; pictures
  /// of different moments do so only as long as nothing moves, and then they are right.
  void refuse(std::span<const ToolEquations> pair) {
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

  /// Applies an estimated correction of camera alignment or tag sizes to the poses once it is
  /// certain.
  void correct_calibration() {
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

  void find_lost(const StereoFrame& frame) {
    std::size_t tracked = 0;
    for (std::size_t i = 0; i < tools_.size(); ++i) {
      tracked += is_measured(i) ? 1 : 0;
    }
    if (!frame.world_from_rig || tracked == tools_.size()) {
      return;
    }
    SearchPlan& left = near_->left_plan();
    SearchPlan& right = near_->right_plan();
    left.boxes.clear();
    right.boxes.clear();
    // While a tool is tracked, a search of the whole image would delay it; with none tracked and no
    // place to look, it is done at once.
    const bool is_turn = pairs_ % options_.full_search_interval == 0;
    const auto any_recent = [&] {
      return std::any_of(trails_.begin(), trails_.end(), [&](const Trail& trail) {
        return trail.last_time && frame.time > *trail.last_time &&
               frame.time - *trail.last_time <= options_.coast;
      });
    };
    left.everywhere = right.everywhere = tracked == 0 && !any_recent() && is_turn;
    for (std::size_t i = 0; i < tools_.size() && !left.everywhere; ++i) {
      if (!is_measured(i)) {
        add_boxes(i, frame);
      }
    }
    near_->detect(frame);
    seen_.add(near_->left());
    seen_.add(near_->right());
    bool missing = false;
    equations_.clear();
    for (std::size_t i = 0; i < tools_.size(); ++i) {
      contradiction_.reset();
      if (is_measured(i) ||
          any_tag(tools_[i], [&](const MarkerDefinition& tag, const auto& marker_from_tag) {
            return find(i, tag, marker_from_tag.inverse(), frame);
          })) {
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
          lose(i, frame);
          trails_[i].filter.stop();
        }
      }
    }
    // While other tools are tracked, the whole image is searched in the background until the next
    // pair.
    if (missing && (tracked > 0 || any_recent()) && is_turn) {
      full_search_.start(frame);
    }
  }

  /// Where a lost tool is looked for: where a search of the whole image found its tags, and where
  /// they were last seen.
  void add_boxes(std::size_t i, const StereoFrame& frame) {
    const Trail& trail = trails_[i];
    any_tag(tools_[i], [&](const MarkerDefinition& tag, const auto& marker_from_tag) {
      const auto from_whole = [&](std::span<const MarkerCorners> found, SearchPlan& plan) {
        for (const MarkerCorners& seen : found) {
          if (seen.family == tag.family && seen.id == tag.id) {
            plan.add(seen.corners_px, kRoom, tag.family, tag.id);
          }
        }
      };
      from_whole(full_search_.left(), near_->left_plan());
      from_whole(full_search_.right(), near_->right_plan());
      if (!trail.last_time || frame.time - *trail.last_time > kRemembered) {
        return false;
      }
      const auto rig_from_tag = frame.world_from_rig->inverse() * trail.last_seen * marker_from_tag;
      const auto expect = [&](const CameraModel& camera, const auto& camera_from_rig,
                              SearchPlan& plan) {
        if (const auto corners = corners_seen(camera, camera_from_rig * rig_from_tag, tag.size_m)) {
          plan.add(*corners, kRoom, tag.family, tag.id);
        }
      };
      const StereoCalibration& c = solver_.calibration();
      expect(c.left, c.left_from_rig, near_->left_plan());
      expect(c.right, c.right_from_rig, near_->right_plan());
      return false;
    });
  }

  /// Finds a tool by one of its tags, whose corners were detected, and measures it.
  bool find(std::size_t i, const MarkerDefinition& tag,
            const Transform<Tag, Marker>& tag_from_marker, const StereoFrame& frame) {
    const TagMatch match = matched(near_->left(), near_->right(), tag.family, tag.id, tag.size_m,
                                   geometry_, std::nullopt);
    if (match.both()) {
      const auto pose =
          geometry_.pose({match.left->corners_px, match.right->corners_px}, tag.size_m);
      if (pose) {
        // The geometry calls every tag's frame Marker.
        const Transform<Rig, Tag> rig_from_tag(pose->rig_from_marker.rotation(),
                                               pose->rig_from_marker.translation());
        const Transform<Rig, Marker> start = rig_from_tag * tag_from_marker;
        const double doubt_m = kDetectedDoubtPx * pixel_m(pose->rig_from_marker);
        if (fit_from(i, frame, start, doubt_m)) {
          return true;
        }
        // A lamp or the exposure may have changed since the light on this tool was estimated.
        trails_[i].follower.forget();
        if (fit_from(i, frame, start, doubt_m)) {
          return true;
        }
      }
    } else if (match.left || match.right) {
      // The other image may still show enough of the tag to decide which of the two possible poses
      // is right.
      const auto poses =
          poses_by_one(solver_.calibration(), match.left ? *match.left : *match.right,
                       match.left == nullptr, tag.size_m);
      for (std::size_t k = 0; poses && k < poses->size(); ++k) {
        const Transform<Rig, Marker> start = (*poses)[k] * tag_from_marker;
        if (fit_from(i, frame, start, kOneCameraDoubtPx * pixel_m(start), true)) {
          return true;
        }
      }
    }
    if (const auto ratio =
            size_ratio(near_->left(), near_->right(), tag.family, tag.id, tag.size_m, geometry_)) {
      calibration_.add_size(i, *ratio - 1.0, kCornersSizeSd);
    }
    return false;
  }

  /// Fits the pose of a tool, starting from `expected`, and measures it if the pictures agree.
  /// `by_both`: it counts only if both cameras saw it.
  bool fit_from(std::size_t i, const StereoFrame& frame, const Transform<Rig, Marker>& expected,
                double doubt_m, bool by_both = false) {
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

  void measure(std::size_t i, const StereoFrame& frame, const ToolFit& fit) {
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
    add_head(state, frame);
  }

  void lose(std::size_t i, const StereoFrame& frame) {
    states_[i] = {i, {}, {}, 0.0};
    states_[i].world_from_marker.time = frame.time;
  }

  [[nodiscard]] bool is_measured(std::size_t i) const {
    return states_[i].world_from_marker.status == PoseStatus::kMeasured;
  }

  /// The length that `kFewestDoubtPx` covers at the tool's distance.
  [[nodiscard]] double pixel_m(const Transform<Rig, Marker>& pose) const {
    return kFewestDoubtPx * pose.translation().norm() / solver_.focal_px(false);
  }

  TagGeometry geometry_;
  PhotometricSolver solver_;
  TagSearch search_;
  std::vector<ToolGeometry> tools_;
  TrackerOptions options_;
  std::unique_ptr<PairDetector> near_;
  FullImageSearch full_search_;
  SeenTags seen_;
  std::vector<Trail> trails_;
  std::vector<ToolState> states_;
  OnlineCalibration calibration_;
  /// Of refused pairs that agree with one another, from this one on.
  OnlineCalibration other_calibration_;
  std::int64_t other_since_ = 0;
  PictureAgreement agreement_;
  std::int64_t last_refused_ = 0;  ///< pair
  // Of the newest pair.
  bool is_refused_ = false;
  bool is_accepted_ = false;
  std::optional<ToolEquations> contradiction_;  ///< of the tool that is being looked for
  std::vector<std::optional<ToolFit>> fits_;
  std::vector<std::size_t> waiting_;    ///< tools to be fitted
  std::atomic<std::size_t> taken_ = 0;  ///< of these, by either thread
  const StereoFrame* frame_ = nullptr;
  std::vector<ToolEquations> equations_;
  std::int64_t pairs_ = -1;
  std::int64_t map_epoch_ = 0;
  std::unique_ptr<Beside> beside_;
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
  // The search of the whole image only finds where to look more closely. One thread, since it runs
  // in the background and has time until the next pair.
  detection.decimate = std::max(detection.decimate, 2.0);
  Result<std::unique_ptr<PairDetector>> whole = PairDetector::create(detection, false);
  if (!whole) {
    return whole.error();
  }
  std::unique_ptr<ToolTracker> tracker = std::make_unique<PhotometricTracker>(
      calibration, std::move(tools), std::move(followers), options, std::move(near).value(),
      std::move(whole).value());
  return tracker;
}

void add_head(ToolState& state, const StereoFrame& frame) {
  TrackedPose& pose = state.world_from_marker;
  if (!frame.world_from_rig || !frame.head_covariance || pose.status == PoseStatus::kLost) {
    return;
  }
  const Vec3 lever_arm_m = pose.value.translation() - frame.world_from_rig->translation();
  pose.covariance = plus_carried(pose.covariance, *frame.head_covariance, lever_arm_m);
}

namespace {

// A hand's motion between two pairs as white acceleration: about 1 m/s² and 10 rad/s² held for 0.1
// s (density = acceleration² · duration).
constexpr double kAccelerationSpectrum_m2_per_s3 = 0.1;
constexpr double kAccelerationSpectrum_rad2_per_s3 = 10.0;
// Without a usable older pose the velocity is unknown: the SDs allow for a fast reach and a fast
// turn of the wrist.
constexpr double kUnknownSpeedM = 0.3;    // m/s
constexpr double kUnknownSpeedRad = 1.5;  // rad/s
// Older pairs say nothing about the velocity now.
constexpr double kLongestBaselineS = 0.2;

void add_motion(PoseCovariance& covariance, double translation, double rotation) {
  for (std::size_t i = 0; i < 3; ++i) {
    covariance[7 * i] += translation;
  }
  for (std::size_t i = 3; i < 6; ++i) {
    covariance[7 * i] += rotation;
  }
}

}  // namespace

TrackedPose predicted(const TrackedPose& older, const TrackedPose& newer, Timestamp time,
                      Duration coast) {
  TrackedPose pose;
  pose.time = time;
  if (newer.status != PoseStatus::kMeasured || time - newer.time > coast) {
    return pose;
  }
  if (time == newer.time) {
    return newer;
  }
  const double baseline_s = seconds(newer.time - older.time);
  const bool moving =
      older.status == PoseStatus::kMeasured && baseline_s > 0.0 && baseline_s <= kLongestBaselineS;
  const double ahead_s = seconds(time - newer.time);
  if (ahead_s < 0.0 && (!moving || time < older.time)) {
    return pose;
  }

  pose.status = PoseStatus::kPredicted;
  const double dt = std::abs(ahead_s);
  const double grown = dt * dt * dt / 3.0;
  if (!moving) {
    pose.value = newer.value;
    pose.covariance = newer.covariance;
    add_motion(
        pose.covariance,
        kUnknownSpeedM * kUnknownSpeedM * dt * dt + kAccelerationSpectrum_m2_per_s3 * grown,
        kUnknownSpeedRad * kUnknownSpeedRad * dt * dt + kAccelerationSpectrum_rad2_per_s3 * grown);
    return pose;
  }
  const double a = ahead_s / baseline_s;
  pose.value = interpolated(older.value, newer.value, 1.0 + a);
  // value = (1 + a) newer - a older, to first order in the rotation as well.
  for (std::size_t i = 0; i < pose.covariance.size(); ++i) {
    pose.covariance[i] = (1.0 + a) * (1.0 + a) * newer.covariance[i] + a * a * older.covariance[i];
  }
  add_motion(pose.covariance, kAccelerationSpectrum_m2_per_s3 * grown,
             kAccelerationSpectrum_rad2_per_s3 * grown);
  return pose;
}

}  // namespace orthonav::nav
