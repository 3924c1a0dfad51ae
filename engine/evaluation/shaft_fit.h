#pragma once

#include <optional>
#include <span>

#include "engine/evaluation/shaft.h"

namespace orthonav::engine {

/// Fits a shaft to a fraction of a voxel: position, direction, bow (for a thin one), radius, ends
/// and blur such that a cylinder of one density, blurred by the scanner and averaged over each
/// voxel, explains the voxels about its border (Levenberg-Marquardt). Model and scan are both
/// clipped below, where bone and streaks are, and above, where a 12-bit scan saturates, so only the
/// flank of the metal counts, which is symmetric about the axis. The density of saturated metal is
/// not visible: a shaft thinner than 3.6 mm is assumed to be steel, any other titanium; denser
/// metal appears 0.1 to 0.3 mm thicker than it is. Of a long wire the front 55 mm are fitted.
/// Voxels of `others` are left out. Nothing if the fit strays from the shaft that was found.
[[nodiscard]] std::optional<Shaft> fitted_shaft(const ScanField& scan, const Shaft& found_shaft,
                                                std::span<const Shaft> others);

}  // namespace orthonav::engine
