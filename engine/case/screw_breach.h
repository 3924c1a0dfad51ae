#pragma once

#include <optional>
#include <string>

#include "nav/guidance/screw.h"
#include "nav/registration/registration.h"

namespace orthonav::engine {

/// The problem of a planned screw that leaves the bone's cortex, as one line: "left screw breaks
/// through the cortex: clearance -1.3 mm, limit 0.0 mm (medial, 24 mm past the entry); ...". None
/// if it does not, if the plan states why it may (`ScrewPlan::accepted_breach`), or if it is
/// unknown because no radius is stated. The side from 6 mm past the entry on and the tip count
/// (nav/guidance/screw_clearance.h).
[[nodiscard]] std::optional<std::string> breach_problem(const nav::VertebraModel& bone,
                                                        const nav::ScrewPlan& screw);

/// A clearance in mm with one decimal, rounded down: never better than it is.
[[nodiscard]] std::string clearance_text(double clearance_m);

}  // namespace orthonav::engine
