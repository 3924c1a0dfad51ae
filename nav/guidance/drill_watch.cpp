#include "nav/guidance/drill_watch.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

/// After a longer gap without a measurement, it is unknown whether the tip rested meanwhile.
constexpr Duration kUnbroken = std::chrono::milliseconds(100);

}  // namespace

std::vector<std::string> DrillLimits::check() const {
  std::vector<std::string> problems;
  const auto ordered = [&](double low, double high, double most, const char* names) {
    if (!(low > 0.0 && low < high && high <= most)) {
      problems.push_back(std::string(names) + " must be positive and increase, within their range");
    }
  };
  const auto within = [&](double value, double most, const char* name) {
    if (!(value > 0.0 && value <= most)) {
      problems.push_back(std::string(name) + " must lie in (0, " + std::to_string(most) + "]");
    }
  };
  ordered(amber_offset_m, red_offset_m, 0.01, "amber_offset_m and red_offset_m (up to 0.01)");
  ordered(amber_angle_rad, red_angle_rad, 0.35, "amber_angle_rad and red_angle_rad (up to 0.35)");
  within(set_within_m, 0.01, "set_within_m");
  within(set_near_axis_m, 0.02, "set_near_axis_m");
  within(set_spread_m, 0.01, "set_spread_m");
  within(advance_m, 0.02, "advance_m");
  within(withdrawn_m, 0.05, "withdrawn_m");
  within(stop_sds, 5.0, "stop_sds");
  within(least_stop_margin_m, 0.01, "least_stop_margin_m");
  within(stop_released_m, 0.01, "stop_released_m");
  if (!(unknown_stop_margin_m >= least_stop_margin_m && unknown_stop_margin_m <= 0.03)) {
    problems.push_back("unknown_stop_margin_m must lie in [least_stop_margin_m, 0.03]");
  }
  if (set_after <= Duration::zero() || set_after > std::chrono::seconds(10)) {
    problems.push_back("set_after must lie in (0, 10] s");
  }
  return problems;
}

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
    return limits_.unknown_stop_margin_m;
  }
  return std::max(limits_.least_stop_margin_m, limits_.stop_sds * depth_sd_m);
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
      if (reading.depth_m < *set_depth_m_ - limits_.withdrawn_m) {
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
  const bool at_entry =
      reading.from_bone_m <= limits_.set_within_m && reading.off_axis_m <= limits_.set_near_axis_m;
  if (!at_entry) {
    rest_.reset();
    return;
  }
  const bool rests = rest_ && reading.time - newest_ <= kUnbroken &&
                     (reading.tip_m - rest_->tip_m).norm() <= limits_.set_spread_m;
  if (!rests) {
    rest_ = reading;
  } else if (reading.time - rest_->time >= limits_.set_after) {
    view_.phase = DrillPhase::kSet;
    set_depth_m_ = reading.depth_m;
    rest_.reset();
  }
}

void DrillWatch::look_for_advance(const DrillReading& reading) {
  const bool left = reading.off_axis_m > limits_.set_near_axis_m ||
                    reading.depth_m < *set_depth_m_ - limits_.withdrawn_m;
  if (left) {
    forget();
    view_.watched = true;
  } else if (reading.depth_m > *set_depth_m_ + limits_.advance_m) {
    view_.phase = DrillPhase::kDrilling;
  }
}

void DrillWatch::judge(const DrillReading& reading) {
  const double margin_m = stop_margin_m(reading.depth_sd_m);
  const bool stopped = view_.alarm == DrillAlarm::kStop;
  const double stop_from_m = stopped ? margin_m + limits_.stop_released_m : margin_m;
  // Negated, so that NaN raises the alarm.
  if (!(reading.to_target_m > stop_from_m)) {
    view_.alarm = DrillAlarm::kStop;
  } else if (!(reading.off_axis_m <= limits_.red_offset_m &&
               reading.angle_rad <= limits_.red_angle_rad)) {
    view_.alarm = DrillAlarm::kRed;
  } else if (reading.off_axis_m > limits_.amber_offset_m ||
             reading.angle_rad > limits_.amber_angle_rad) {
    view_.alarm = DrillAlarm::kAmber;
  } else {
    view_.alarm = DrillAlarm::kNone;
  }
}

}  // namespace orthonav::nav
