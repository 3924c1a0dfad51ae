#include "engine/session/guide_checks.h"

#include <cmath>
#include <numbers>

namespace orthonav::engine {
namespace {

/// The rules with both tips as uncertain as their calibration left them.
TipCheckRules tips_known_to(const SessionOptions& options) {
  TipCheckRules rules = options.tips;
  rules.prior_sd_m = std::numbers::sqrt2 * options.placed.tip_sd_m;
  return rules;
}

/// How the guide was last seen against the bone of the current level.
Mat3 bone_from_guide(const OperationInWork& work) {
  const LevelState& level = work.level();
  const nav::TrackedPose& seen = work.tools.watch(work.tools.guide()).last_measured_pose();
  return level.registration ? level.registration->world_from_vertebra.rotation().transposed() *
                                  seen.value.rotation()
                            : Mat3::identity();
}

}  // namespace

GuideChecks::GuideChecks(const SessionOptions& options)
    : tips_(tips_known_to(options), options.landmark, options.steps.tips),
      axis_({options.placed.axis_sd_rad}) {}

void GuideChecks::compare_tips(OperationInWork& work, const nav::PressedPlace& place,
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

void GuideChecks::compare_axis(OperationInWork& work, const nav::SpinCalibration& spin,
                               Timestamp time) {
  axis_.take(spin, work.tools.geometry(work.tools.guide()).axis_in_marker);
  work.observer->axis_compared(time, *axis_.last());
}

bool GuideChecks::correct_guide(OperationInWork& work, Timestamp time) {
  WatchedTools& tools = work.tools;
  if (tips_.offers()) {
    const Vec3 by_m = tips_.correct();
    tools.correct_guide_tip(tools.geometry(tools.guide()).tip_in_marker - by_m);
    work.messages.say(TipCorrected{by_m.norm()}, time);
    work.observer->tips_compared(time, *tips_.last());
    return true;
  }
  if (axis_.offers()) {
    tools.correct_guide_axis(axis_.correct());
    work.messages.say(AxisCorrected{axis_.last()->by_rad}, time);
    work.observer->axis_compared(time, *axis_.last());
    return true;
  }
  return false;
}

/// Camera errors shift everything seen in one place alike. The guide's tag is seen some 0.1 m from
/// where the pointer's was, at 0.45 m, and the head has turned since, so this part of the error is
/// assumed not to be shared. Estimate.
ToolErrors GuideChecks::errors(const OperationInWork& work, Timestamp now) const {
  constexpr double kElsewhere = 0.3;
  const LevelState& level = work.level();
  const double cameras_m = level.registration ? level.registration->common.cameras_m : 0.0;
  return {
      level.walked_sd_m(now),
      std::hypot(tips_.difference_sd_m(work.tools.tag_size_difference_sd(), bone_from_guide(work)),
                 kElsewhere * cameras_m),
      axis_.sd_rad()};
}

}  // namespace orthonav::engine
