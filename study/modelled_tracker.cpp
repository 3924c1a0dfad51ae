#include "study/modelled_tracker.h"

#include <algorithm>
#include <utility>

#include "nav/published/corner_tracker.h"
#include "nav/tracking/marker_detector.h"
#include "nav/tracking/pose_filter.h"
#include "study/modelled_sightings.h"

namespace orthonav::engine {
namespace {

/// A real detector reports how well it read a tag; drawn corners always count as well read.
constexpr double kReadWell = 100.0;
/// Like a real tracker, it finds a lost tool near its last place, and elsewhere only every few
/// pairs.
constexpr int kLookEvery = 5;

/// Finds tags where a search plan looks for them.
class ModelledFinder final : public nav::TagFinder {
 public:
  ModelledFinder(const sim::SimHeadset& room, const MeasurementModel& model)
      : room_(room), sightings_(room, model) {}

  [[nodiscard]] nav::SearchPlan& left_plan() override { return left_plan_; }
  [[nodiscard]] nav::SearchPlan& right_plan() override { return right_plan_; }
  [[nodiscard]] std::span<const nav::MarkerCorners> left() const override { return left_; }
  [[nodiscard]] std::span<const nav::MarkerCorners> right() const override { return right_; }

  void detect(const StereoFrame& frame) override {
    sightings_.look(frame);
    left_.clear();
    right_.clear();
    for (std::size_t i = 0; i < sightings_.seen().size(); ++i) {
      const StereoCorners& seen = sightings_.seen()[i];
      find(i, seen.left_px, left_plan_, left_);
      find(i, seen.right_px, right_plan_, right_);
    }
  }

 private:
  static bool is_in(const nav::TagCorners& corners, const nav::PixelBox& box) {
    return std::all_of(corners.begin(), corners.end(), [&](Vec2 corner) {
      return corner.x >= box.x_px && corner.x <= box.x_px + box.width_px && corner.y >= box.y_px &&
             corner.y <= box.y_px + box.height_px;
    });
  }

  void find(std::size_t tool, const std::optional<nav::TagCorners>& corners,
            const nav::SearchPlan& plan, std::vector<nav::MarkerCorners>& found) const {
    const sim::RoomTool& made = room_.room().tools[tool];
    const bool looked_for =
        corners &&
        (plan.everywhere ||
         std::any_of(plan.boxes.begin(), plan.boxes.end(), [&](const nav::SearchPlan::Box& box) {
           return box.family == made.family && box.id == made.id && is_in(*corners, box.box);
         }));
    if (looked_for) {
      found.push_back({made.family, made.id, *corners, kReadWell, 0});
    }
  }

  const sim::SimHeadset& room_;
  ModelledSightings sightings_;
  nav::SearchPlan left_plan_;
  nav::SearchPlan right_plan_;
  std::vector<nav::MarkerCorners> left_;
  std::vector<nav::MarkerCorners> right_;
};

/// Without size estimation, tags count as large as stated, and differences are attributed to other
/// parameters.
nav::CalibrationOptions calibration_options(bool correct_tag_sizes) {
  constexpr double kKnown = 1e-6;
  nav::CalibrationOptions out;
  out.size_sd = correct_tag_sizes ? out.size_sd : kKnown;
  return out;
}

/// The tracker of `best` with corners in place of pixels.
class ModelledTracker final : public nav::ToolTracker {
 public:
  ModelledTracker(const sim::SimHeadset& room, const StereoCalibration& calibration,
                  std::vector<nav::ToolGeometry> tools, const nav::TrackerOptions& options,
                  const MeasurementModel& model, bool correct_tag_sizes)
      : room_(room),
        calibration_(calibration),
        tools_(std::move(tools)),
        options_(options),
        model_(model),
        sightings_(room, model),
        filters_(tools_.size()),
        online_(tools_.size(), calibration_options(correct_tag_sizes)),
        correct_tag_sizes_(correct_tag_sizes) {
    for (std::size_t i = 0; i < tools_.size(); ++i) {
      states_.push_back({i, {}, {}, 0.0});
    }
  }

  std::span<const nav::ToolState> track(const StereoFrame& frame) override {
    sightings_.look(frame);
    ++pairs_;
    for (std::size_t i = 0; i < tools_.size(); ++i) {
      states_[i] = {i, {}, {}, 0.0};
      states_[i].world_from_marker.time = frame.time;
      if (frame.world_from_rig && !measure(i, frame)) {
        predict(i, frame);
      }
    }
    calibrate();
    return states_;
  }

  [[nodiscard]] std::span<const nav::ToolGeometry> tools() const override { return tools_; }
  [[nodiscard]] std::optional<nav::StereoAlignment> alignment() const override {
    return online_.alignment();
  }
  [[nodiscard]] double tag_size_difference_sd(std::size_t tool, std::size_t other) const override {
    return correct_tag_sizes_ ? online_.size_difference_sd(tool, other)
                              : ToolTracker::tag_size_difference_sd(tool, other);
  }

 private:
  [[nodiscard]] bool is_followed(std::size_t i, Timestamp time) const {
    return filters_[i].follows(time, options_.coast);
  }

  bool measure(std::size_t i, const StereoFrame& frame) {
    const StereoCorners& seen = sightings_.seen()[i];
    const auto near = sightings_.near(i);
    const bool found = is_followed(i, frame.time) || pairs_ % kLookEvery == 0;
    if (!near || !found) {
      return false;
    }
    const auto fit =
        corner_pose(seen, *near, calibration_, online_.size_factor(i) * tools_[i].marker.size_m,
                    model_.believed_px);
    if (!fit) {
      return false;
    }
    if (fit->calibration) {
      online_.add(i, *fit->calibration);
    }
    const nav::TrackedPose measured{
        *frame.world_from_rig * fit->rig_from_marker, frame.time, PoseStatus::kMeasured,
        nav::rotated(fit->covariance, frame.world_from_rig->rotation())};
    if (!is_followed(i, frame.time)) {
      filters_[i].stop();
    }
    filters_[i].update(measured, room_.options().error_model.exposure_s);
    nav::ToolState& state = states_[i];
    state.world_from_marker = filters_[i].state();
    state.rig_from_marker = frame.world_from_rig->inverse() * state.world_from_marker.value;
    nav::add_head(state, frame);
    state.cameras = (seen.left_px ? 1 : 0) + (seen.right_px ? 1 : 0);
    state.pair = nav::PairPose{fit->rig_from_marker, fit->covariance,
                               room_.options().error_model.exposure_s};
    return true;
  }

  void predict(std::size_t i, const StereoFrame& frame) {
    if (!is_followed(i, frame.time)) {
      return;
    }
    states_[i].world_from_marker = filters_[i].predicted(frame.time);
    states_[i].rig_from_marker =
        frame.world_from_rig->inverse() * states_[i].world_from_marker.value;
    nav::add_head(states_[i], frame);
  }

  void calibrate() {
    if (online_.correct()) {
      nav::rotate_right_camera(calibration_, online_.rotation_rad());
    }
  }

  const sim::SimHeadset& room_;
  StereoCalibration calibration_;
  std::vector<nav::ToolGeometry> tools_;
  nav::TrackerOptions options_;
  MeasurementModel model_;
  ModelledSightings sightings_;
  std::vector<nav::PoseFilter> filters_;
  std::vector<nav::ToolState> states_;
  nav::OnlineCalibration online_;
  bool correct_tag_sizes_;
  std::int64_t pairs_ = -1;
};

}  // namespace

Result<std::unique_ptr<nav::ToolTracker>> create_modelled_tracker(
    std::string_view method, const sim::SimHeadset& room, const StereoCalibration& calibration,
    std::vector<nav::ToolGeometry> tools, const nav::TrackerOptions& options,
    bool correct_tag_sizes) {
  const MeasurementModel model = MeasurementModel::of(method);
  if (method == "paper") {
    return nav::published::create_tracker_of_corners(calibration, std::move(tools), options,
                                                     std::make_unique<ModelledFinder>(room, model));
  }
  if (Status status = nav::check(calibration, tools, options); !status) {
    return status.error();
  }
  return std::unique_ptr<nav::ToolTracker>(std::make_unique<ModelledTracker>(
      room, calibration, std::move(tools), options, model, correct_tag_sizes));
}

}  // namespace orthonav::engine
