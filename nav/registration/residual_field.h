#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "nav/registration/residual_noise.h"
#include "nav/registration/residual_units.h"
#include "nav/registration/surface_fit.h"

namespace orthonav::nav {

/// Number of units of a fit's points that is enough for its heights.
inline constexpr std::size_t kMaxUnits = 160;

/// The estimate of pose, standoff and model size from the heights of a fit's points, with such a
/// field marginalised.
struct ResidualField {
  std::vector<FieldHypothesis> hypotheses;  ///< those more probable than 0.3 %
  FieldHypothesis likeliest;
  /// SDs of the field and of the strokes' heights: root of the mean variance over the hypotheses.
  double field_sd_m = 0.0;
  /// The step (translation m, rotation vector rad) from the fit's pose to the likeliest one, and
  /// the covariance after the step by rows, both about the points' centre in the model's frame.
  std::array<double, 6> step{};
  std::array<double, 36> covariance{};
  double standoff_m = 0.0;  ///< mean height of the tip above the bone; never negative
  double standoff_sd_m = 0.0;
  double effective_points = 0.0;  ///< independent points that would do as well
  double log_evidence = 0.0;      ///< up to a constant for this number of units
  /// Size of the bone relative to the model; and by how much (natural logarithm) the heights are
  /// more probable if it is an unknown.
  double size = 1.0;
  double size_sd = 0.0;
  double size_log_evidence = 0.0;
};

/// Generalised least squares over `units` of the fit's points, whose noise is correlated along each
/// stroke and whose field is correlated over the bone; the field's SD and length, and the SD of the
/// strokes' heights, are marginalised on a grid (restricted likelihood: Patterson & Thompson 1971;
/// Rasmussen & Williams 2006, section 2.7, for the basis functions). If `least_sd_m` is not zero,
/// neither a bare bone nor a smaller field is tried. `among` limits the search to these hypotheses;
/// empty: all are tried. Returns nothing if a motion is undetermined or there are fewer than 12
/// units.
[[nodiscard]] std::optional<ResidualField> residual_field(
    const SurfaceFit& fit, const ResidualUnits& units, std::span<const FieldHypothesis> among = {},
    double least_sd_m = 0.0);

}  // namespace orthonav::nav
