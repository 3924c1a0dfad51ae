#pragma once

#include <optional>
#include <span>

#include "engine/evaluation/shaft.h"

namespace orthonav::engine {

/// A shaft to a fraction of a voxel: place, direction, bow (of a thin one), radius, ends and blur
/// such that a cylinder of one density, blurred as by the scanner and averaged over each voxel,
/// explains the voxels about its border (Levenberg-Marquardt). Model and scan are both cut off
/// below, where bone and streaks are, and above, where a 12-bit scan clips: so only the flank of
/// the metal counts, which lies the same way on all sides of an axis. Clipped metal does not show
/// its density: a shaft thinner than 3.6 mm is taken for steel, any other for titanium; denser
/// metal looks 0.1 to 0.3 mm thicker than it is. Of a long wire the front 55 mm are fitted. Voxels
/// of `others` are left out. Nothing where the fit strays from the shaft that was found.
[[nodiscard]] std::optional<Shaft> fitted_shaft(const ScanField& scan, const Shaft& found_shaft,
                                                std::span<const Shaft> others);

}  // namespace orthonav::engine
