#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "nav/registration/residual_noise.h"
#include "nav/registration/residual_units.h"

namespace orthonav::nav {

/// The heights of units, linear in the unknowns: height = -derivative · unknowns + field + noise.
/// Refers to the fit and the units given.
class HeightModel {
 public:
  HeightModel(const SurfaceFit& fit, const ResidualUnits& units);
  ~HeightModel();
  HeightModel(const HeightModel&) = delete;
  HeightModel& operator=(const HeightModel&) = delete;

  /// The unknowns in the order of ResidualUnit::derivative, with the pose as a step from the fit's;
  /// the standoff is never negative. Covariance by rows.
  struct Answer {
    double log_evidence = 0.0;
    std::array<double, kHeightUnknowns> unknowns{};
    std::array<double, kHeightUnknowns * kHeightUnknowns> covariance{};
  };
  struct Answers {
    Answer fixed_size;
    Answer free_size;
  };
  /// The solution for a given field and the noise in addition to it. Empty if a motion is
  /// undetermined. Fastest if fields of the same length come one after the other.
  [[nodiscard]] std::optional<Answers> solve(const FieldHypothesis& field,
                                             const StrokeNoise& noise);
  /// The mean of each unit's height without noise: standoff, field, and the stroke's own height.
  /// Empty if a motion is undetermined.
  [[nodiscard]] std::vector<double> heights_without_noise(const FieldHypothesis& field,
                                                          const StrokeNoise& noise);

 private:
  class Matrices;
  std::unique_ptr<Matrices> matrices_;
};

}  // namespace orthonav::nav
