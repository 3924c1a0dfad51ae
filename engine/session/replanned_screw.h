#pragma once

#include <variant>

#include "engine/session/replan.h"
#include "engine/session/replan_limits.h"
#include "nav/guidance/screw.h"
#include "nav/registration/registration.h"

namespace orthonav::engine {

/// The screw as changed, or why the change is refused; the clearance to the cortex is not checked.
[[nodiscard]] std::variant<nav::ScrewPlan, ReplanRefusal> changed(
    const Replan& replan, const nav::ScrewPlan& now, const nav::ScrewPlan& preoperative,
    const nav::VertebraModel& bone, const ReplanLimits& limits);

}  // namespace orthonav::engine
