#pragma once

#include <span>
#include <vector>

#include "nav/registration/registration.h"

namespace orthonav::nav {

/// Where the pose must be sure: those of the options, or else where screws usually go.
[[nodiscard]] std::vector<Point<Vertebra>> targets_of(const VertebraModel& model,
                                                      const PoseSearchRegistrationOptions& options);

/// Notes what a pose's uncertainty, errors in common apart, means at the targets: the errors to
/// expect, the motion behind them, where strokes would tell most; and, with the errors in common,
/// the uncertainty of the whole.
void put_errors(const VertebraModel& model, const PoseUncertainty& own, const CommonErrors& common,
                std::span<const Point<Vertebra>> targets, Registration& r);

}  // namespace orthonav::nav
