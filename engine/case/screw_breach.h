#pragma once

#include <optional>
#include <string>

#include "nav/guidance/screw.h"
#include "nav/registration/registration.h"

namespace orthonav::engine {

/// A planned screw that leaves the bone's cortex, in a line such as "left screw breaks through the
/// cortex: clearance -1.3 mm, limit 0.0 mm (medial, 24 mm past the entry); ...". None where it does
/// not, where the plan says why it may (`ScrewPlan::accepted_breach`), and where nobody knows: no
/// radius is stated. What counts is the side from 6 mm past the entry on, and the tip
/// (nav/guidance/screw_clearance.h).
[[nodiscard]] std::optional<std::string> breach_problem(const nav::VertebraModel& bone,
                                                        const nav::ScrewPlan& screw);

}  // namespace orthonav::engine
