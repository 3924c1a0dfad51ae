#include "nav/guidance/drill_watch.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

/// After a longer gap without a measurement, it is unknown whether the tip rested meanwhile.
constexpr Duration kUnbroken = std::chrono::milliseconds(100);

constexpr double kSetWithin_m = 0.002;    ///< a tip this near to the bone may be set on it,
constexpr double kSetNearAxis_m = 0.005;  ///< if also this near to the planned axis
constexpr Duration kSetAfter = std::chrono::milliseconds(500);  ///< and at rest for this long
constexpr double kSetSpread_m = 0.001;  ///< a tip that moves farther does not rest
constexpr double kAdvance_m = 0.002;    ///< this much deeper than where it was set: it is drilling
constexpr double kWithdrawn_m = 0.005;  ///< this far out from there: it is no longer drilling
/// The stop comes while the tip is short of the target by this many SDs of its depth, so that
/// with 95 % probability it has not reached it,
constexpr double kStopSds = 1.645;
/// but by at least this margin: a hand that stops a quarter of a second later has drilled 0.75 mm
/// deeper at 3 mm per second,
constexpr double kLeastStopMargin_m = 0.001;
/// and by this margin if the SD is unknown.
constexpr double kUnknownStopMargin_m = 0.005;
/// The stop ends when the tip is short of it by this much again.
constexpr double kStopReleased_m = 0.002;

}  // namespace

void DrillWatch::begin() {
  if (view_.phase != DrillPhase::kDrilling) {
    view_.phase = DrillPhase::kDrilling;
    rest_.reset();
  }
}

void DrillWatch::forget() {
  view_ = {};
  rest_.reset();
  set_depth_m_.reset();
}

double DrillWatch::stop_margin_m(double depth_sd_m) const {
  // Negated, so that NaN counts as unknown too.
  if (!(depth_sd_m >= 0.0) || std::isinf(depth_sd_m)) {
    return kUnknownStopMargin_m;
  }
  return std::max(kLeastStopMargin_m, kStopSds * depth_sd_m);
}

void DrillWatch::measured(const DrillReading& reading) {
  view_.watched = true;
  switch (view_.phase) {
    case DrillPhase::kAway:
      look_for_rest(reading);
      break;
    case DrillPhase::kSet:
      look_for_advance(reading);
      break;
    case DrillPhase::kDrilling:
      set_depth_m_ = set_depth_m_.value_or(std::max(reading.depth_m, 0.0));
      if (reading.depth_m < *set_depth_m_ - kWithdrawn_m) {
        forget();
        view_.watched = true;
      }
      break;
  }
  if (view_.phase == DrillPhase::kDrilling) {
    judge(reading);
  }
  look_at_stop(reading);
  newest_ = reading.time;
}

/// Assumes that the drill advances along the planned axis until it meets the stop.
void DrillWatch::look_at_stop(const DrillReading& reading) {
  view_.stop_past_target_m.reset();
  if (reading.stop_m) {
    const double length_m = reading.depth_m + reading.to_target_m;
    view_.stop_past_target_m = set_depth_m_.value_or(0.0) + *reading.stop_m - length_m;
  }
}

void DrillWatch::look_for_rest(const DrillReading& reading) {
  const bool at_entry = reading.from_bone_m <= kSetWithin_m && reading.off_axis_m <= kSetNearAxis_m;
  if (!at_entry) {
    rest_.reset();
    return;
  }
  const bool rests = rest_ && reading.time - newest_ <= kUnbroken &&
                     (reading.tip_m - rest_->tip_m).norm() <= kSetSpread_m;
  if (!rests) {
    rest_ = reading;
  } else if (reading.time - rest_->time >= kSetAfter) {
    view_.phase = DrillPhase::kSet;
    set_depth_m_ = reading.depth_m;
    rest_.reset();
  }
}

void DrillWatch::look_for_advance(const DrillReading& reading) {
  const bool left =
      reading.off_axis_m > kSetNearAxis_m || reading.depth_m < *set_depth_m_ - kWithdrawn_m;
  if (left) {
    forget();
    view_.watched = true;
  } else if (reading.depth_m > *set_depth_m_ + kAdvance_m) {
    view_.phase = DrillPhase::kDrilling;
  }
}

void DrillWatch::judge(const DrillReading& reading) {
  const double margin_m = stop_margin_m(reading.depth_sd_m);
  const bool stopped = view_.alarm == DrillAlarm::kStop;
  const double stop_from_m = stopped ? margin_m + kStopReleased_m : margin_m;
  // Negated, so that NaN raises the alarm.
  if (!(reading.to_target_m > stop_from_m)) {
    view_.alarm = DrillAlarm::kStop;
  } else if (!(reading.off_axis_m <= kRedOffset_m && reading.angle_rad <= kRedAngle_rad)) {
    view_.alarm = DrillAlarm::kRed;
  } else if (reading.off_axis_m > kAmberOffset_m || reading.angle_rad > kAmberAngle_rad) {
    view_.alarm = DrillAlarm::kAmber;
  } else {
    view_.alarm = DrillAlarm::kNone;
  }
}

}  // namespace orthonav::nav
