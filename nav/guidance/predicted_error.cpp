#include "nav/guidance/predicted_error.h"

#include <algorithm>
#include <limits>

namespace orthonav::nav {

std::vector<PredictedScrewError> predicted_errors(const Registration& registration,
                                                  std::span<const ScrewPlan> screws) {
  const auto at = [&](Point<Vertebra> target) {
    return registration.uncertainty ? registration.uncertainty->predicted_tre_m(target)
                                    : std::numeric_limits<double>::infinity();
  };
  std::vector<PredictedScrewError> errors;
  errors.reserve(screws.size());
  for (const ScrewPlan& screw : screws) {
    errors.push_back({screw.side, at(screw.entry), at(screw.target)});
  }
  return errors;
}

double worst_m(std::span<const PredictedScrewError> errors) {
  double worst = 0.0;
  for (const PredictedScrewError& error : errors) {
    worst = std::max(worst, error.worst_m());
  }
  return worst;
}

std::vector<Point<Vertebra>> entries_and_targets(std::span<const ScrewPlan> screws) {
  std::vector<Point<Vertebra>> places;
  for (const ScrewPlan& screw : screws) {
    places.insert(places.end(), {screw.entry, screw.target});
  }
  return places;
}

}  // namespace orthonav::nav
