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

/// Units of a fit's points that are enough to tell what its heights say.
inline constexpr std::size_t kMostUnits = 160;

/// What the heights of a fit's points say when such a field is marginalised: about the pose, the
/// standoff, and the size of the model.
struct ResidualField {
  std::vector<FieldHypothesis> hypotheses;  ///< those more probable than 0.3 %
  FieldHypothesis likeliest;
  /// Of the field and the strokes' heights, root of their mean variance over the hypotheses.
  double field_sd_m = 0.0;
  /// The step (translation m, rotation vector rad) from the fit's pose to the likeliest one, and
  /// the covariance after it by rows, both about the points' centre in the model's frame.
  std::array<double, 6> step{};
  std::array<double, 36> covariance{};
  double standoff_m = 0.0;  ///< mean height of the tip above the bone; never negative
  double standoff_sd_m = 0.0;
  double effective_points = 0.0;  ///< independent ones that would tell the pose as well
  double log_evidence = 0.0;      ///< of the heights, up to a constant of the units' number
  /// Of the bone, that of the model being 1; and by how much (natural logarithm) the heights are
  /// more probable when it is an unknown.
  double size = 1.0;
  double size_sd = 0.0;
  double size_log_evidence = 0.0;
};

/// Generalised least squares over units of strokes, whose noise is correlated along each stroke and
/// whose field is correlated over the bone; the field's SD and length, and the SD of the strokes'
/// heights, are marginalised on a grid (restricted likelihood: Patterson & Thompson 1971; Rasmussen
/// & Williams 2006, section 2.7, for the basis functions). `among` limits the search to these
/// hypotheses; empty: all are tried. Nothing when a motion is undetermined or fewer than 12 units
/// are there.
[[nodiscard]] std::optional<ResidualField> residual_field(
    const SurfaceFit& fit, std::span<const FieldHypothesis> among = {});
/// The same over units of the fit's points that were made before.
[[nodiscard]] std::optional<ResidualField> residual_field(
    const SurfaceFit& fit, const ResidualUnits& units, std::span<const FieldHypothesis> among = {});

}  // namespace orthonav::nav
