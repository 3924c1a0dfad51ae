#pragma once

#include <span>
#include <vector>

#include "nav/registration/registration.h"

namespace orthonav::nav {

/// Where the pose must be certain: the targets in the options, or, if there are none, where screws
/// usually go, or both ends of another bone along each of its principal axes.
[[nodiscard]] std::vector<Point<Vertebra>> targets_of(const VertebraModel& model,
                                                      const PoseSearchRegistrationOptions& options);

/// Fills in what a pose's uncertainty means at the targets: without common errors, the expected
/// errors, the motion behind them and where strokes would help most; and, with common errors, the
/// total uncertainty.
void put_errors(const VertebraModel& model, const PoseUncertainty& own, const CommonErrors& common,
                std::span<const Point<Vertebra>> targets, Registration& r);

}  // namespace orthonav::nav
