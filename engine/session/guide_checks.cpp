#include "engine/session/guide_checks.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include "engine/session/log/operation_json.h"
#include "engine/session/session_state.h"

namespace orthonav::engine {
namespace {

/// Lower limit of the SD of the tag size, as a fraction: lens errors vary across the image.
constexpr double kLeastSizeSd = 0.0003;
/// Smaller corrections of the tip are not offered.
constexpr double kTipWorth_m = 0.0002;
/// Tips farther apart were not at the same landmark.
constexpr double kMaxTipsApart_m = 0.010;

}  // namespace

double TipCheck::along_sight_m(double size_sd) const {
  return kTagDistance_m * std::max(size_sd, kLeastSizeSd);
}

double TipCheck::difference_sd_m(double size_sd, const Mat3& bone_from_guide) const {
  const double tags_m = along_sight_m(size_sd) / std::sqrt(3.0);
  const double prior_m = prior_sd_m_;
  if (!last_ || !(prior_m > 0.0)) {
    return std::hypot(prior_m, tags_m);
  }
  // The posterior of two normal distributions; without consent the tip stays off by the mean.
  const double left_m = prior_m * last_->sd_m / std::hypot(prior_m, last_->sd_m);
  const double off_m = last_->corrected ? 0.0 : last_->by_m.norm() / std::sqrt(3.0);
  // Half of the difference is the pointer's, on average, and does not turn with the guide: turned
  // by an angle a, that part (SD `prior_m` / sqrt(2)) is off by 2 sin(a/2) in two of three
  // directions.
  const double turned_rad = rotation_angle_rad(held_, bone_from_guide);
  const double turned_m = std::sqrt(4.0 / 3.0) * std::sin(0.5 * turned_rad) * prior_m;
  return std::hypot(std::hypot(left_m, off_m, tags_m), turned_m);
}

std::variant<TipDifference, TouchRefusal> TipCheck::take(
    const nav::PressedPlace& place, const Transform<World, Marker>& world_from_guide,
    const nav::PressedPlace& pointer_tip, bool anchored, double size_sd) {
  const double tags_m = along_sight_m(size_sd);
  const double each_m2 = landmark_variance_m2(anchored);
  TipDifference found;
  found.apart_m = world_from_guide.rotation().transposed() * (place.place - pointer_tip.place);
  // The pointer's place is the mean of all its touches; the guide's is a single touch.
  found.sd_m = std::sqrt(place.sd_m * place.sd_m + pointer_tip.sd_m * pointer_tip.sd_m + each_m2 +
                         each_m2 / landmark_touches(anchored) + tags_m * tags_m / 3.0);
  const double prior_m2 = prior_sd_m_ * prior_sd_m_;
  const double known = prior_m2 / (prior_m2 + found.sd_m * found.sd_m);
  found.by_m = known * found.apart_m;
  found.limit_m = kTipWorth_m / known;
  if (!(known > 0.0)) {
    found.limit_m = kMaxTipsApart_m;  // tips that are known exactly need no correction
  }
  if (!(found.apart_m.norm() <= kMaxTipsApart_m)) {
    return TouchRefusal{TouchRefusal::Kind::kTouchesApart, found.apart_m.norm(), kMaxTipsApart_m};
  }
  last_ = found;
  compared_ = true;
  return found;
}

Vec3 TipCheck::correct() {
  last_->corrected = true;
  return last_->by_m;
}

double sd_of_each_rad(const nav::SpinCalibration& measured) {
  return std::max(measured.axis_sigma_rad / std::sqrt(2.0), kLeastAxisSd_rad);
}

void AxisCheck::take(const nav::SpinCalibration& measured, Direction<Marker> in_use) {
  const double sd_rad = sd_of_each_rad(measured);
  const double known = sd_rad_ * sd_rad_ / (sd_rad_ * sd_rad_ + sd_rad * sd_rad);
  AxisDifference found;
  found.off_rad = angle_between_rad(in_use.v, measured.axis_in_marker.v);
  found.sd_rad = sd_rad;
  found.by_rad = known * found.off_rad;
  const Vec3 about = in_use.v.cross(measured.axis_in_marker.v);
  better_ =
      about.norm() > 0.0
          ? Direction<Marker>{rotation_from_vector(found.by_rad * about.normalized()) * in_use.v}
          : in_use;
  last_ = found;
}

Direction<Marker> AxisCheck::correct() {
  last_->corrected = true;
  sd_rad_ = sd_rad_ * last_->sd_rad / std::hypot(sd_rad_, last_->sd_rad);
  return better_;
}

namespace {

/// How the guide was last seen against the bone of the current level.
Mat3 bone_from_guide(const SessionState& work) {
  const LevelState& level = work.level();
  const nav::TrackedPose& seen = work.tools.watch(work.tools.guide()).last_measured_pose();
  return level.registration ? level.registration->world_from_vertebra.rotation().transposed() *
                                  seen.value.rotation()
                            : Mat3::identity();
}

}  // namespace

// Both tips are as uncertain as their calibration left them.
GuideChecks::GuideChecks(const SessionOptions& options)
    : tips_(std::numbers::sqrt2 * options.placed.tip_sd_m, options.steps.tips),
      axis_(options.placed.axis_sd_rad) {}

void GuideChecks::compare_tips(SessionState& work, const nav::PressedPlace& place,
                               const nav::PressedPlace& pointer_tip, Timestamp time) {
  const WatchedTools& tools = work.tools;
  const auto taken = tips_.take(place, tools.watch(tools.guide()).last_measured_pose().value,
                                pointer_tip, work.anchored(), tools.tag_size_difference_sd());
  if (const auto* refusal = std::get_if<TouchRefusal>(&taken)) {
    work.messages.say(TouchNotRecorded{TouchNotRecorded::What::kGuideTip, *refusal}, time);
  } else {
    tips_.held(bone_from_guide(work));
    work.observer->tips_compared(time, std::get<TipDifference>(taken));
  }
}

void GuideChecks::compare_axis(SessionState& work, const nav::SpinCalibration& spin,
                               Timestamp time) {
  axis_.take(spin, work.tools.geometry(work.tools.guide()).axis_in_marker);
  work.observer->axis_compared(time, *axis_.last());
}

void GuideChecks::correct_guide(SessionState& work, Timestamp time) {
  WatchedTools& tools = work.tools;
  if (tips_.offers()) {
    const Vec3 by_m = tips_.correct();
    tools.correct_guide_tip(tools.geometry(tools.guide()).tip_in_marker - by_m);
    work.messages.say(TipCorrected{by_m.norm()}, time);
    work.observer->tips_compared(time, *tips_.last());
  } else if (axis_.offers()) {
    tools.correct_guide_axis(axis_.correct());
    work.messages.say(AxisCorrected{axis_.last()->by_rad}, time);
    work.observer->axis_compared(time, *axis_.last());
  }
}

/// Camera errors shift everything seen in one place alike. The guide's tag is seen some 0.1 m from
/// where the pointer's was, at 0.45 m, and the head has turned since, so this part of the error is
/// assumed not to be shared. Estimate.
ToolErrors GuideChecks::errors(const SessionState& work, Timestamp now) const {
  constexpr double kElsewhere = 0.3;
  const LevelState& level = work.level();
  const double cameras_m = level.registration ? level.registration->common.cameras_m : 0.0;
  return {
      level.drift_sd_m(now),
      std::hypot(tips_.difference_sd_m(work.tools.tag_size_difference_sd(), bone_from_guide(work)),
                 kElsewhere * cameras_m),
      axis_.sd_rad()};
}

// Its records.

void log_tips(LogJson& json, const TipDifference& difference) {
  json["apart_m"] = json_of(difference.apart_m);
  json["by_m"] = json_of(difference.by_m);
  json["corrected"] = difference.corrected;
  put_bounded(json, "sd_m", difference.sd_m);
  put_bounded(json, "limit_m", difference.limit_m);
}

TipDifference tips_from(const JsonNode& node) {
  return {node.vec3("apart_m"), bounded(node, "sd_m"), node.vec3("by_m"), bounded(node, "limit_m"),
          node.flag_or("corrected", false)};
}

void log_axis(LogJson& json, const AxisDifference& difference) {
  json["off_rad"] = difference.off_rad;
  json["sd_rad"] = difference.sd_rad;
  json["by_rad"] = difference.by_rad;
  json["corrected"] = difference.corrected;
}

AxisDifference axis_from(const JsonNode& node) {
  return {node.number("off_rad"), node.number("sd_rad"), node.number("by_rad"),
          node.flag_or("corrected", false)};
}

}  // namespace orthonav::engine
