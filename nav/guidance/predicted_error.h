#pragma once

#include <span>
#include <vector>

#include "nav/guidance/screw.h"
#include "nav/registration/registration.h"

namespace orthonav::nav {

/// Root mean square errors to expect at a screw from the registration, metres; infinite if the
/// points leave a motion of the bone undetermined.
struct PredictedScrewError {
  Side side = Side::kLeft;
  double entry_m = 0.0;
  double target_m = 0.0;
  [[nodiscard]] double worst_m() const { return entry_m > target_m ? entry_m : target_m; }
};

/// One for each screw, in their order.
[[nodiscard]] std::vector<PredictedScrewError> predicted_errors(const Registration& registration,
                                                                std::span<const ScrewPlan> screws);

/// The largest of them; 0 without any.
[[nodiscard]] double worst_m(std::span<const PredictedScrewError> errors);

/// Where screws need a certain pose: the entry and target of each.
[[nodiscard]] std::vector<Point<Vertebra>> entries_and_targets(std::span<const ScrewPlan> screws);

}  // namespace orthonav::nav
